import pytest

from fe_models import CRANK_STEEL, LINKAGE_IRON, Material
from fe_models.errors import InputError


def test_the_papers_materials():
    assert (CRANK_STEEL.youngs_modulus, CRANK_STEEL.density) == (2.1e11, 7850.0)
    assert (LINKAGE_IRON.youngs_modulus, LINKAGE_IRON.poissons_ratio) == (1.69e11, 0.286)


@pytest.mark.parametrize("values", [(0.0, 0.3, 1.0), (1.0, 0.5, 1.0), (1.0, 0.3, float("nan"))])
def test_bad_values(values):
    with pytest.raises(InputError, match=r"material\."):
        Material(*values)
