import pytest

from fe_models import CRANK_STEEL, LINKAGE_IRON, Interface, Material, shipped_part
from fe_models.errors import InputError


def test_bearings_are_the_faces_held_in_all_motions():
    assert shipped_part("crank").bearings == ("journal A", "pin", "journal B")


def test_unknown_part_motion_and_mesh_size():
    with pytest.raises(InputError, match="shipped are crank"):
        shipped_part("slide")
    with pytest.raises(InputError, match="motions"):
        Interface("pin", ("x", "x"))
    with pytest.raises(InputError, match="mesh_size"):
        shipped_part("crank", mesh_size=0.0)
    with pytest.raises(InputError, match="at most once"):
        part = shipped_part("crank")
        part.replace(interfaces=(Interface("pin"), Interface("pin")))


def test_the_papers_materials():
    assert (CRANK_STEEL.youngs_modulus, CRANK_STEEL.density) == (2.1e11, 7850.0)
    assert (LINKAGE_IRON.youngs_modulus, LINKAGE_IRON.poissons_ratio) == (1.69e11, 0.286)


@pytest.mark.parametrize("values", [(0.0, 0.3, 1.0), (1.0, 0.5, 1.0), (1.0, 0.3, float("nan"))])
def test_bad_values(values):
    with pytest.raises(InputError, match=r"material\."):
        Material(*values)
