"""The reduction against the full model."""

import itertools

import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg

from fe_models import Interface, Reduction
from fe_models.elasticity import rigid_motions
from fe_models.errors import InputError
from fe_models.reduction import interface_rows, reduce_model, reduce_part
from fe_models.saddle import SaddleSolver, lowest_modes
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


def test_static_bending_under_an_interface_load_is_exact(crank, crank_model):
    (error,) = errors(crank, crank_model, bending_load(crank_model), "craig_bampton", [20])
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


def test_fixed_interface_modes_hold_the_mean_motion(bar, bar_model):
    from fe_models.reduction import _craig_bampton_basis, interface_rows

    basis, frequencies, _ = _craig_bampton_basis(bar, bar_model, 12)
    assert len(frequencies) == 6
    motion = interface_rows(bar, bar_model) @ basis[:, 6:]
    assert np.abs(motion).max() < 1e-9 * np.abs(basis[:, 6:]).max()


@pytest.mark.parametrize("method", ["craig_bampton", "free"])
def test_bit_for_bit_reproducible(bar, bar_model, method):
    """The second one has a mesh and matrices of its own."""
    first = reduce_model(bar, bar_model, Reduction(8, method))
    second = reduce_part(bar, Reduction(8, method))
    for key in ("frequencies", "modes", "stress", "inertia"):
        assert np.array_equal(getattr(first, key), getattr(second, key)), key


def test_no_modes(crank, crank_model):
    rigid = reduce_model(crank, crank_model, Reduction(modes=0))
    assert rigid.mode_count == 0
    assert rigid.mass == pytest.approx(217.6, abs=1e-3)
    assert rigid.interface("pin").translation.shape == (3, 0)


@pytest.mark.parametrize("modes", [-1, 2.5, True])
def test_a_mode_count_that_is_none(modes):
    with pytest.raises(InputError, match=r"modes.*0 or more"):
        Reduction(modes=modes)


def test_more_modes_than_the_mesh_has(crank, crank_model):
    with pytest.raises(InputError, match=r"at most \d+"):
        reduce_model(crank, crank_model, Reduction(modes=crank_model.unknowns))


def test_unknown_method_and_too_few_interfaces(crank, crank_model):
    with pytest.raises(InputError, match="craig_bampton, free"):
        Reduction(method="guyan")
    loose = crank.replace(interfaces=(Interface("flange", ("rz",)),))
    with pytest.raises(InputError, match="all six motions"):
        reduce_model(loose, crank_model, Reduction())


def test_solver_satisfies_the_saddle_point_system(bar, bar_model):
    rows = interface_rows(bar, bar_model)
    generator = np.random.default_rng(0)
    load, motion = generator.standard_normal(bar_model.unknowns), generator.standard_normal(12)
    solver = SaddleSolver(bar_model, rows)
    found = solver.solve(load, motion)
    scale = bar_model.stiffness.diagonal().mean()
    system = sp.bmat([[bar_model.stiffness, scale * rows.T], [scale * rows, None]]).tocsc()
    exact = scipy.sparse.linalg.spsolve(system, np.concatenate([load, scale * motion]))[:-12]
    assert np.abs(found - exact).max() < 1e-9 * np.abs(exact).max()
    assert np.abs(rows @ found - motion).max() < 1e-9


def test_eigenpairs_have_small_residuals(bar, bar_model):
    rows = interface_rows(bar, bar_model)
    solver = SaddleSolver(bar_model, rows)
    squares, modes = lowest_modes(bar_model, lambda load: solver.solve(load, None), 5)
    for square, mode in zip(squares, modes.T, strict=True):
        again = square * solver.solve(bar_model.mass @ mode, None)
        assert np.abs(again - mode).max() < 1e-8 * np.abs(mode).max()


def test_virtual_nodes_move_with_the_interface(reduced_crank):
    pin = reduced_crank.interface("pin")
    points, modes = pin.virtual_nodes()
    q = np.random.default_rng(1).standard_normal(20)
    moved = (modes @ q).reshape(3, 3)
    theta = pin.rotation @ q
    expected = pin.translation @ q + np.cross(theta, points - pin.centre)
    assert moved == pytest.approx(expected)
    assert moved.mean(axis=0) == pytest.approx(pin.translation @ q)


def test_unknown_interface_and_damping(reduced_crank):
    with pytest.raises(InputError, match=r"no interface 'web'.*'pin'"):
        reduced_crank.interface("web")
    with pytest.raises(InputError, match="damping_ratio"):
        reduced_crank.damping_matrix(1.5)


def test_von_mises_of_a_stretched_state(reduced_linkage):
    stress = reduced_linkage.von_mises(np.ones(20))
    assert stress.shape == (len(reduced_linkage.nodes),)
    assert np.all(stress >= 0.0)
    assert reduced_linkage.von_mises(2.0 * np.ones(20)) == pytest.approx(2.0 * stress)


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
