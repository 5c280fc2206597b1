"""The reduction against the full model."""

import itertools

import numpy as np
import pytest

from fe_models import Interface, Reduction
from fe_models.elasticity import rigid_motions
from fe_models.errors import InputError
from fe_models.reduction import reduce_model, reduce_part
from fe_models.saddle import SaddleSolver
from fe_models.stress import nodal_stress


def momentum_rows(model):
    """Rows that hold a free body to zero mean motion."""
    return (model.mass @ rigid_motions(model.nodes, model.nodes.mean(axis=0))).T


def errors(part, model, load, method, counts):
    """What modes miss of the work of a load in equilibrium on the displacement it causes."""
    full_work = load @ SaddleSolver(model, momentum_rows(model)).solve(load, None)
    found = []
    for count in counts:
        frequencies, modes = full_modes(part, model, method, count)
        work = ((load @ modes / (2.0 * np.pi * frequencies)) ** 2).sum()
        found.append(1.0 - work / full_work)
    return found


def full_modes(part, model, method, modes):
    """Frequencies and modes over all nodes (a reduced part keeps the surface alone)."""
    from fe_models.reduction import _craig_bampton_basis, _free_basis, _orthogonalise

    if method == "free":
        basis = _free_basis(model, modes)[0]
    else:
        basis = _craig_bampton_basis(part, model, modes)[0]
    return _orthogonalise(model, basis, modes)


def bending_load(model):
    """The crank pin pulled in y by 1 N, held by half of it at each journal."""
    faces = model.faces
    spread = {name: np.asarray(faces[name].rows.todense())[1] for name in faces}
    load = spread["pin"] - 0.5 * (spread["journal A"] + spread["journal B"])
    return in_equilibrium(model, load)


def middle_load(model):
    """A pull in y at the webs, where no interface is, balanced at the journals."""
    z = np.abs(model.nodes[:, 2])
    webs = np.flatnonzero((z > 0.18) & (z < 0.22))
    load = np.zeros((len(model.nodes), 3))
    load[webs, 1] = 1.0 / len(webs)
    return in_equilibrium(model, load.ravel())


def in_equilibrium(model, load):
    rigid = rigid_motions(model.nodes, model.nodes.mean(axis=0))
    inertia = model.mass @ rigid
    return load - inertia @ np.linalg.solve(rigid.T @ inertia, rigid.T @ load)


def test_static_bending_under_an_interface_load_is_exact(bar, bar_model):
    left, right = (bar_model.faces[name].rows[[5]].toarray()[0] for name in ("left", "right"))
    (error,) = errors(
        bar, bar_model, in_equilibrium(bar_model, left - right), "craig_bampton", [20]
    )
    assert abs(error) < 2e-5  # not 0: the balancing inertia load is spread over the body


@pytest.mark.long
def test_static_error_falls_with_the_number_of_modes(crank, crank_model):
    load = middle_load(crank_model)
    found = errors(crank, crank_model, load, "craig_bampton", (13, 40))
    assert 0.0 <= found[1] < 0.01 < found[0], found


@pytest.mark.long
def test_free_modes_are_the_slower_way(crank, crank_model):
    load = bending_load(crank_model)
    found = errors(crank, crank_model, load, "free", (2, 8, 40))
    assert all(a > b > 0.0 for a, b in itertools.pairwise(found)), found
    assert found[-1] > 0.002, "static modes would not be worth having"


def test_modes_are_mass_normal_and_free_of_rigid_motion(bar, bar_model, reduced_bar):
    _, modes = full_modes(bar, bar_model, "craig_bampton", 20)
    mass, stiffness = bar_model.mass, bar_model.stiffness
    assert modes.T @ (mass @ modes) == pytest.approx(np.eye(20), abs=1e-10)
    squares = np.diag((2 * np.pi * reduced_bar.frequencies) ** 2)
    assert modes.T @ (stiffness @ modes) == pytest.approx(squares, abs=1e-8 * squares.max())
    rigid = rigid_motions(bar_model.nodes, np.zeros(3))
    assert modes.T @ (mass @ rigid) == pytest.approx(np.zeros((20, 6)), abs=1e-10)


@pytest.mark.long
def test_frequencies_fall_towards_those_of_the_free_body(crank, crank_model):
    free = reduce_model(crank, crank_model, Reduction(10, "free", stress=False)).frequencies[:3]
    found = [
        reduce_model(crank, crank_model, Reduction(modes, stress=False)).frequencies[:3]
        for modes in (13, 20, 40)
    ]
    for coarse, fine in itertools.pairwise(found):
        assert np.all(coarse >= fine * (1 - 1e-9))
    assert found[-1] == pytest.approx(free, rel=1e-3)
    assert np.all(found[-1] >= free * (1 - 1e-9))


def test_bit_for_bit_reproducible(bar, bar_model):
    """The second one has a mesh and matrices of its own."""
    first = reduce_model(bar, bar_model, Reduction(8))
    second = reduce_part(bar, Reduction(8))
    for key in ("frequencies", "modes", "stress", "inertia"):
        assert np.array_equal(getattr(first, key), getattr(second, key)), key


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
