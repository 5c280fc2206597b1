"""The reduction against the full model, and the share of flexibility that modes carry."""

import numpy as np
import pytest
import scipy.sparse as sp
from independent.solid import displaced

from fe_models import Interface, Reduction
from fe_models.elasticity import rigid_motions
from fe_models.errors import InputError
from fe_models.reduction import (
    _craig_bampton_basis,
    _orthogonalise,
    reduce_model,
)
from fe_models.saddle import SaddleSolver
from fe_models.stress import nodal_stress


@pytest.fixture(scope="module")
def modes(bar, bar_model):
    """Modes over all nodes (a reduced part keeps the surface alone)."""
    return _orthogonalise(bar_model, _craig_bampton_basis(bar, bar_model, 20)[0], 20)[1]


def test_static_bending_under_an_interface_load_is_exact(bar_model, modes, reduced_bar):
    """What modes miss of the work of a load in equilibrium on the displacement it causes."""
    left, right = (bar_model.faces[name].rows[[5]].toarray()[0] for name in ("left", "right"))
    rigid = rigid_motions(bar_model.nodes, bar_model.nodes.mean(axis=0))
    inertia = bar_model.mass @ rigid
    load = left - right
    load -= inertia @ np.linalg.solve(rigid.T @ inertia, rigid.T @ load)
    full_work = load @ SaddleSolver(bar_model, inertia.T).solve(load, None)
    work = ((load @ modes / (2.0 * np.pi * reduced_bar.frequencies)) ** 2).sum()
    assert abs(1.0 - work / full_work) < 2e-5  # the balancing inertia load is over the body


def test_modes_are_mass_normal_and_free_of_rigid_motion(bar_model, modes, reduced_bar):
    mass, stiffness = bar_model.mass, bar_model.stiffness
    assert modes.T @ (mass @ modes) == pytest.approx(np.eye(20), abs=1e-10)
    squares = np.diag((2 * np.pi * reduced_bar.frequencies) ** 2)
    assert modes.T @ (stiffness @ modes) == pytest.approx(squares, abs=1e-8 * squares.max())
    rigid = rigid_motions(bar_model.nodes, np.zeros(3))
    assert modes.T @ (mass @ rigid) == pytest.approx(np.zeros((20, 6)), abs=1e-10)


def test_what_is_no_reduction_is_refused(bar, bar_model, reduced_bar):
    loose = bar.replace(interfaces=(Interface("left", ("rz",)),))
    for make, message in (
        (lambda: Reduction(modes=-1), r"modes.*0 or more"),
        (lambda: Reduction(modes=2.5), r"modes.*0 or more"),
        (lambda: Reduction(modes=True), r"modes.*0 or more"),
        (lambda: Reduction(method="guyan"), "craig_bampton, free"),
        (lambda: Reduction(modes=3, flexibility_error=0.1), "flexibility_error"),
        (lambda: Reduction(flexibility_error=2), "flexibility_error"),
        (lambda: reduce_model(bar, bar_model, Reduction(bar_model.unknowns)), r"at most \d+"),
        (lambda: reduce_model(loose, bar_model, Reduction()), "all six motions"),
        (lambda: reduced_bar.interface("web"), r"no interface 'web'.*'left'"),
        (lambda: reduced_bar.damping_matrix(1.5), "damping_ratio"),
    ):
        with pytest.raises(InputError, match=message):
            make()


def test_von_mises_of_a_stretched_state(reduced_bar):
    stress = reduced_bar.von_mises(np.ones(20))
    assert stress.shape == (len(reduced_bar.nodes),)
    assert np.all(stress >= 0.0)
    assert reduced_bar.von_mises(2.0 * np.ones(20)) == pytest.approx(2.0 * stress)


def test_constant_strain_gives_hookes_stress(crank, crank_model):
    """u = (a x, b y, c y): stresses by hand, at every node of a curved mesh."""
    a, b, c = 1e-3, -2e-4, 5e-4
    x, y, _ = crank_model.nodes.T
    field = np.stack([a * x, b * y, c * y], axis=1)[:, :, None]
    e, nu = crank.material.youngs_modulus, crank.material.poissons_ratio
    g = e / (2 * (1 + nu))
    lame = e * nu / ((1 + nu) * (1 - 2 * nu))
    trace = a + b
    six = [lame * trace + 2 * g * a, lame * trace + 2 * g * b, lame * trace, g * c, 0.0, 0.0]
    found = nodal_stress(crank_model, crank.material, field)[:, :, 0]
    assert found == pytest.approx(np.tile(six, (len(found), 1)), rel=1e-6, abs=1.0)


PLANE = ("x", "y", "rz")
LOADS = {  # on the interfaces by number: the row of the motion, and its size
    "pulled apart": {0: (0, 1.0), 1: (0, -1.0)},
    "pulled along by one end": {0: (0, 1.0)},
    "pulled across by one end": {1: (1, 1.0)},
    "bent": {0: (5, 1.0), 1: (5, -1.0)},
}


@pytest.fixture(scope="module")
def exact_work(bar_model):
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
def test_the_error_is_kept_under_every_load_in_the_plane(bar, bar_model, exact_work, wanted):
    reduction = Reduction(flexibility_error=wanted, loads=PLANE)
    reduced = reduce_model(bar, bar_model, reduction)
    assert reduced.meta["flexibility_error"] <= wanted
    assert reduced.mode_count <= (6 if wanted > 1e-3 else 12)  # the mesh is not symmetric
    for name, parts in LOADS.items():
        left = 1.0 - by_modes(reduced, parts) / exact_work[name]
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
