"""Modes by what they do: the share of the interfaces' flexibility that they carry."""

import numpy as np
import pytest
import scipy.sparse as sp
from independent.solid import displaced

from fe_models import Reduction
from fe_models.elasticity import rigid_motions
from fe_models.errors import InputError
from fe_models.reduction import reduce_model

PLANE = ("x", "y", "rz")
LOADS = {  # on the interfaces by number: the row of the motion, and its size
    "pulled apart": {0: (0, 1.0), 1: (0, -1.0)},
    "pulled along by one end": {0: (0, 1.0)},
    "pulled across by one end": {1: (1, 1.0)},
    "bent": {0: (5, 1.0), 1: (5, -1.0)},
}


@pytest.fixture(scope="module")
def exact(bar_model):
    """What loads on its ends do on their own motion, by SciPy on all finite elements."""
    model = bar_model
    rigid = rigid_motions(model.nodes, model.nodes.mean(axis=0))
    inertia = model.mass @ rigid
    loads = np.column_stack(
        [
            sum(size * list(model.faces.values())[face].rows[row].toarray().ravel()
                for face, (row, size) in parts.items())
            for parts in LOADS.values()
        ]
    )  # fmt: skip
    balanced = loads - inertia @ np.linalg.solve(rigid.T @ inertia, rigid.T @ loads)
    held = sp.csr_matrix(inertia.T / np.abs(inertia).max())
    work = (loads * displaced(model.stiffness, held, balanced)).sum(axis=0)
    return dict(zip(LOADS, work, strict=True))


def by_modes(reduced, parts):
    """Return the same by modes."""
    forces = np.zeros(reduced.mode_count)
    for face, (row, size) in parts.items():
        interface = reduced.interfaces[face]
        forces += size * np.vstack([interface.translation, interface.rotation])[row]
    return float(((forces / (2.0 * np.pi * reduced.frequencies)) ** 2).sum())


@pytest.mark.parametrize(
    "wanted",
    [pytest.param(0.2, marks=pytest.mark.long), 1e-2, pytest.param(1e-6, marks=pytest.mark.long)],
)
def test_the_error_is_kept_under_every_load_in_the_plane(bar, bar_model, exact, wanted):
    reduction = Reduction(flexibility_error=wanted, loads=PLANE)
    reduced = reduce_model(bar, bar_model, reduction)
    assert reduced.meta["flexibility_error"] <= wanted
    assert reduced.mode_count <= (6 if wanted > 1e-3 else 9)  # the mesh is not symmetric
    for name, parts in LOADS.items():
        left = 1.0 - by_modes(reduced, parts) / exact[name]
        assert -1e-6 < left <= wanted + 1e-6, name


@pytest.mark.long
def test_modes_that_stay_at_rest_in_the_plane_are_left_out(linkage, linkage_model, reduced_linkage):
    """The linkage is symmetric to the plane: some of its modes bend out of it, or twist."""
    planar = reduce_model(linkage, linkage_model, Reduction(loads=PLANE))
    assert planar.mode_count == 13
    assert reduced_linkage.mode_count == 20
    for parts in LOADS.values():
        assert by_modes(planar, parts) == pytest.approx(by_modes(reduced_linkage, parts), rel=3e-5)
    kept = np.isin(reduced_linkage.frequencies.round(3), planar.frequencies.round(3))
    assert kept.sum() == planar.mode_count
    for interface in reduced_linkage.interfaces:
        still = np.abs(interface.translation[:2, ~kept]).max()
        assert still < 1e-2 * np.abs(interface.translation[:2, kept]).max()


def test_shares_sum_up_to_what_there_is(bar, bar_model, reduced_bar):
    """Twenty modes leave some of the body's own acceleration to higher ones."""
    shares = reduced_bar.participation()
    assert shares.shape == (12, 20) and shares.min() >= 0.0
    assert 0.0 < (1.0 - shares.sum(axis=1)).max() < 0.15
    all_of_it = reduce_model(bar, bar_model, Reduction(flexibility_error=1e-9))
    assert all_of_it.participation().sum(axis=1) == pytest.approx(np.ones(12), abs=1e-8)


def test_what_no_modes_reach_is_refused(bar, bar_model, monkeypatch):
    monkeypatch.setattr("fe_models.reduction.MOST_MODES", 8)
    wanted = Reduction(flexibility_error=1e-4, method="free")
    with pytest.raises(InputError, match=r"flexibility_error = 0\.0001: 8 modes leave"):
        reduce_model(bar, bar_model, wanted)
