"""A step's first guess and Newton's matrix change only what a run costs."""

import math
from importlib.util import find_spec

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from patched import PATCHED

from exu_press import Scene, SolverStatus, SolverTuning, simulate, solve_dynamic
from exu_press.integrate import scheme, settings
from exu_press.integrate.scheme import FlexibleJacobian, Newton
from exu_press.result import record
from exu_press.scene import flexible_press
from exudyn_examples import EXAMPLES
from exudyn_examples.spatial import rods_on_a_spring, spring

NGSOLVE = pytest.mark.skipif(find_spec("ngsolve") is None, reason="flexible parts need NGSolve")


def tuned(scene, **numbers):
    model = scene.build()
    return record(model, model.solve(tuning=SolverTuning(**numbers)))


@PATCHED
@pytest.mark.parametrize("pin", ["lubricated", "dry"])
def test_expected_accelerations_save_iterations(pin, monkeypatch):
    scene = Scene(
        joints={"crank_pin": pin, "balls": "dry"}, revolutions=0.05, solver={"step": 5e-5}
    )
    guided = simulate(scene)
    monkeypatch.setattr(Newton, "_advance", lambda guide, step: None)
    plain = simulate(scene)
    assert guided.info["newton_iterations"] < 0.7 * plain.info["newton_iterations"]
    apart = guided["slider_acceleration"] - plain["slider_acceleration"]
    assert np.abs(apart).max() < 1e-3 * np.abs(plain["slider_acceleration"]).max()


def test_what_rounding_leaves_is_not_iterated_on():
    """A film of 30 nm makes more of the last digit of a speed than the tolerance allows."""
    thin = Scene(
        film={"law": "pinkus"},
        joints={
            "crank_pin": {"kind": "lubricated", "clearance": 3e-8},
            "balls": {"kind": "dry", "clearance": 1e-4},
        },
        revolutions=0.02,
    )
    forgiving = simulate(thin)
    strict = tuned(thin, rounding=0.0)
    assert forgiving.completed
    assert not strict.completed


@PATCHED
@NGSOLVE
def test_euler_parameters_are_expected_on_their_unit_sphere(monkeypatch):
    """Else one iteration leaves something in the constraints, whose forces alternate.

    At the balance of rigid bodies: a finer one asks for iterations that mend it.
    """
    monkeypatch.setattr(scheme, "BALANCE_NEARLY", scheme.BALANCE)
    run = simulate(
        Scene(
            bodies=flexible_press(modes=4),
            joints={"crank_pin": "ideal", "balls": "ideal"},
            revolutions=0.2,
        )
    )
    assert run.completed
    assert run.info["newton_iterations"] < 1.1 * run.info["steps"]
    force = np.linalg.norm(run.joints["counterweight_pin"].force, axis=1)
    assert np.abs(np.diff(force, 2)).max() < 0.02 * force.max()


@NGSOLVE
def test_a_flexible_body_on_a_rigid_marker_leaves_nothing_in_its_constraints():
    """An iteration leaves a part there, which alternated, and asked for twice the steps."""
    mbs = exu.SystemContainer().AddSystem()
    EXAMPLES["FFRF pendulum"].build(mbs)
    mbs.Assemble()
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime = EXAMPLES["FFRF pendulum"].end
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.95
    chosen.solution.file.write = False
    outcome = solve_dynamic(mbs, chosen, tolerance=1e-4)
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.steps < 2000 and outcome.rejected_steps < 100


@pytest.fixture
def flexible():
    return Scene(
        bodies=flexible_press(modes=4),
        joints={"crank_pin": "lubricated", "balls": "dry"},
        revolutions=0.1,
        solver={"tolerance": 0.01},
    )


@NGSOLVE
@PATCHED
def test_what_is_kept_differs_little_from_what_exudyn_differentiates(flexible, monkeypatch):
    """By what matters to Newton's method: the part of an error that its matrix would leave."""
    own, left = FlexibleJacobian._compute, []

    def compare(jacobian, solver, mbs, settings):
        size = solver.GetODE2size()
        mine = own(jacobian, solver, mbs, settings)
        matrix = np.array(solver.GetSystemJacobian())
        step = solver.it.currentStepSize
        by_q, by_q_t = solver.newmarkBeta * step**2, solver.newmarkGamma * step
        stiffness, damping = jacobian._bodies.reshape(2, size, size)
        with jacobian._joints.left_out():
            solver.ComputeJacobianODE2RHS(mbs, -by_q, -by_q_t)
        missing = np.zeros_like(matrix)
        missing[:size, :size] = by_q * stiffness + by_q_t * damping
        missing[:size, :size] -= np.array(solver.GetSystemJacobian())[:size, :size]
        solver.SetSystemJacobian(matrix)
        errors = np.linalg.eigvals(np.linalg.solve(matrix, missing))
        left.append(np.abs(errors).max())
        return mine

    monkeypatch.setattr(FlexibleJacobian, "_compute", compare)
    assert simulate(flexible).completed
    assert len(left) > 50
    assert max(left) < 0.02
    assert np.median(left) < 1e-4


@NGSOLVE
@PATCHED
def test_it_changes_the_cost_and_not_the_result(flexible, monkeypatch):
    kept = simulate(flexible)
    monkeypatch.setattr(scheme, "FlexibleJacobian", lambda task: None)
    stock = simulate(flexible)
    assert kept.completed and stock.completed
    peaks = [np.abs(run["slider_acceleration"]).max() for run in (kept, stock)]
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    iterations = [run.info["newton_iterations"] / run.info["steps"] for run in (kept, stock)]
    assert iterations[0] < 1.4 * iterations[1]


@NGSOLVE
def test_no_alternation_grows_from_what_newtons_method_leaves_in_the_constraints():
    """One iteration a step ends with the counterweight at +-11 m/s^2 about -10, and worse."""
    result = simulate(Scene(bodies=flexible_press(), joints={}, revolutions=0.55))
    assert result.completed, result.summary()["reason"]
    force = result["counterweight_pin_force"][:, 1]
    assert np.abs(np.diff(force, 2)).max() < 0.05 * np.abs(force).max()


@NGSOLVE
@PATCHED
def test_one_serves_several_steps_and_changes_no_answer(monkeypatch):
    made, own = [], FlexibleJacobian._compute

    def counted(*arguments):
        made[-1] += 1
        return own(*arguments)

    monkeypatch.setattr(FlexibleJacobian, "_compute", counted)
    runs = []
    for same in (-1.0, scheme.SAME):
        monkeypatch.setattr(scheme, "SAME", same)
        scene = Scene(bodies=flexible_press(modes=4), revolutions=0.03, solver={"tolerance": 3e-4})
        model = scene.build()
        made.append(0)
        runs.append(record(model, model.solve()))
    fresh, kept = runs
    assert made[0] >= fresh.info["steps"]
    assert made[1] < 0.6 * kept.info["steps"]
    assert kept.info["newton_iterations"] < 1.25 * fresh.info["newton_iterations"]
    forces = [np.abs(run.joints["crank_pin"].force).max() for run in runs]
    assert forces[1] == pytest.approx(forces[0], rel=2e-3)


@pytest.mark.parametrize(("count", "most"), [(100, 60), (10, 8)])
def test_a_jacobian_that_asks_a_function_is_kept(count, most):
    """A string of masses, whose force is a function: one Jacobian asks it twice for each."""
    mbs, asked = exu.SystemContainer().AddSystem(), []

    def force(mbs, time, item, q, q_t):
        asked.append(time)
        q = np.concatenate([[0.0], q, [0.0]])
        return 1e4 * (q[:-2] - 2.0 * q[1:-1] + q[2:])

    shape = np.sin(np.pi * np.arange(1, count + 1) / (count + 1))
    node = mbs.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=np.zeros(count),
            initialCoordinates=shape,
            initialCoordinates_t=np.zeros(count),
            numberOfODE2Coordinates=count,
        )
    )
    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node], massMatrix=np.eye(count), forceUserFunction=force
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.solution.file.write = 1.0, False
    outcome = solve_dynamic(mbs, settings, tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    omega = 200.0 * math.sin(math.pi / (2.0 * (count + 1)))
    assert mbs.systemData.GetODE2Coordinates() == pytest.approx(shape * math.cos(omega), abs=2e-3)
    assert len(asked) < most * outcome.steps


RODS = 3


def tries_and_speeds(forces=0):
    mbs = exu.SystemContainer().AddSystem()
    rods_on_a_spring(mbs, RODS, forces)
    mbs.Assemble()
    asked = exu.SimulationSettings()
    asked.timeIntegration.endTime, asked.solution.file.write = 0.3, False
    outcome = solve_dynamic(mbs, asked, tolerance=1e-2, max_steps=5000).check()
    return outcome.steps + outcome.rejected_steps, mbs.systemData.GetODE2Coordinates_t()


@pytest.mark.parametrize("in_python", [True, False])
def test_a_kept_jacobian_leaves_constraints_met(in_python, monkeypatch):
    """It is kept where a force is a function in Python, and in large systems."""
    coordinates = 7 * RODS
    monkeypatch.setattr(settings, "LARGE", coordinates + in_python)
    kept, with_kept = tries_and_speeds(spring if in_python else 0)
    monkeypatch.setattr(settings, "LARGE", coordinates + 1)
    fresh, with_fresh = tries_and_speeds()
    assert kept < 1.5 * fresh
    assert np.linalg.norm(with_kept - with_fresh) < 0.1 * np.linalg.norm(with_fresh)
