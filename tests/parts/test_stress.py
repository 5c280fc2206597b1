import numpy as np
import pytest

from fe_models.stress import nodal_stress


def test_constant_strain_gives_hookes_stress(linkage, linkage_model):
    """u = (a x, b y, c y): stresses by hand, at every node of a curved mesh."""
    a, b, c = 1e-3, -2e-4, 5e-4
    x, y, _ = linkage_model.nodes.T
    field = np.stack([a * x, b * y, c * y], axis=1)[:, :, None]
    e, nu = linkage.material.youngs_modulus, linkage.material.poissons_ratio
    g = e / (2 * (1 + nu))
    lame = e * nu / ((1 + nu) * (1 - 2 * nu))
    trace = a + b
    six = [lame * trace + 2 * g * a, lame * trace + 2 * g * b, lame * trace, g * c, 0.0, 0.0]
    found = nodal_stress(linkage_model, linkage.material, field)[:, :, 0]
    assert found == pytest.approx(np.tile(six, (len(found), 1)), rel=1e-6, abs=1.0)
