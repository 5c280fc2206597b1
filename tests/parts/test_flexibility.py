"""Modes by what they do: the share of the interfaces' static flexibility that they carry."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from exu_press.errors import InputError
from fe_models import Reduction
from fe_models.flexibility import inertia_relief
from fe_models.reduction import interface_rows, reduce_model
from fe_models.saddle import SaddleSolver

PLANE = ("x", "y", "rz")


def work_by_modes(reduced, force):
    """Return what a force on the bores, pulled apart along x, moves them: by modes, m/N."""
    big, small = (reduced.interface(face).translation for face in ("big bore", "small bore"))
    return float((((small - big).T @ force / (2 * np.pi * reduced.frequencies)) ** 2).sum())


@pytest.fixture(scope="module")
def pulled_apart(linkage_model):
    """What the bores part under a unit force, by SciPy on all finite elements, six motions held."""
    bores = [linkage_model.faces[face].rows for face in ("big bore", "small bore")]
    held = sp.csr_matrix(1e9 * bores[0])
    matrix = sp.bmat([[linkage_model.stiffness, held.T], [held, None]]).tocsc()
    load = (bores[1] - bores[0])[0].toarray().ravel()
    return load @ splu(matrix).solve(np.concatenate([load, np.zeros(6)]))[: len(load)]


@pytest.mark.parametrize("wanted", [0.2, 1e-2, 1e-6])
def test_the_error_is_kept_in_every_load_of_the_plane(linkage, linkage_model, pulled_apart, wanted):
    reduction = Reduction(flexibility_error=wanted, loads=PLANE)
    reduced = reduce_model(linkage, linkage_model, reduction)
    assert reduced.meta["flexibility_error"] <= wanted
    left = 1.0 - work_by_modes(reduced, (1.0, 0.0, 0.0)) / pulled_apart
    assert -1e-6 < left <= wanted + 1e-6


def test_modes_that_carry_no_load_are_spared(crank, crank_model):
    """Those out of the plane, of the thirteen that the statics have."""
    statics = reduce_model(crank, crank_model, Reduction(modes=13))
    assert statics.meta["flexibility_error"] < 1e-6
    plane = reduce_model(crank, crank_model, Reduction(flexibility_error=1e-2, loads=PLANE))
    space = reduce_model(crank, crank_model, Reduction(flexibility_error=1e-2))
    assert plane.mode_count < space.mode_count <= 13
    assert set(np.round(plane.frequencies, 3)) < set(np.round(statics.frequencies, 3))


def test_shares_under_inertia(linkage, linkage_model, reduced_linkage):
    """Every mode of twenty has its share; a load's own acceleration leaves some to higher ones."""
    shares = reduced_linkage.participation()
    assert shares.shape == (12, 20) and shares.min() >= 0.0
    left = 1.0 - shares.sum(axis=1)
    assert 0.0 < left.max() < 0.15
    rows = interface_rows(linkage, linkage_model)
    cholesky = SaddleSolver(linkage_model, rows).cholesky
    assert inertia_relief(linkage_model, rows, cholesky) == pytest.approx(
        reduced_linkage.flexibility, rel=1e-9
    )


def test_what_no_modes_reach_is_refused(linkage, linkage_model, monkeypatch):
    monkeypatch.setattr("fe_models.reduction.MOST_MODES", 8)
    wanted = Reduction(flexibility_error=1e-4, method="free")
    with pytest.raises(InputError, match=r"flexibility_error = 0\.0001: 8 modes leave 0\.\d+"):
        reduce_model(linkage, linkage_model, wanted)


@pytest.mark.parametrize("keys", [{"modes": 3, "flexibility_error": 0.1}, {"flexibility_error": 2}])
def test_one_of_the_two_and_a_share(keys):
    with pytest.raises(InputError, match="flexibility_error"):
        Reduction(**keys)
