"""A flexible body's stiffness is differentiated once; Newton's matrix must stay right."""

import numpy as np
import pytest

from exu_press import Scene, Tuning, simulate
from exu_press.integrate import solve
from exu_press.integrate.flexible_jacobian import FlexibleJacobian
from exu_press.result import record
from exu_press.scene import flexible_press

pytest.importorskip("ngsolve")


@pytest.fixture
def scene():
    return Scene(
        bodies=flexible_press(modes=4),
        joints={"crank_pin": "lubricated", "balls": "dry"},
        revolutions=0.1,
        solver={"tolerance": 0.01},
    )


def test_what_is_kept_differs_little_from_what_exudyn_differentiates(scene, monkeypatch):
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
    assert simulate(scene).completed
    assert len(left) > 50
    assert max(left) < 0.02
    assert np.median(left) < 1e-4


def test_it_changes_the_cost_and_not_the_result(scene, monkeypatch):
    kept = simulate(scene)
    monkeypatch.setattr(solve, "FlexibleJacobian", lambda *_: None)
    stock = simulate(scene)
    assert kept.completed and stock.completed
    peaks = [np.abs(run["slider_acceleration"]).max() for run in (kept, stock)]
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    assert kept.info["newton_iterations"] < 1.2 * stock.info["newton_iterations"]


def test_no_alternation_grows_from_what_newtons_method_leaves_in_the_constraints():
    """One iteration a step ends with the counterweight at +-11 m/s^2 about -10, and worse."""
    scene = Scene(bodies=flexible_press(), joints={}, revolutions=0.55)
    result = simulate(scene)
    assert result.completed, result.summary()["reason"]
    force = result["counterweight_pin_force"][:, 1]
    assert np.abs(np.diff(force, 2)).max() < 0.05 * np.abs(force).max()


def test_one_serves_several_steps_and_changes_no_answer(monkeypatch):
    made, own = [], FlexibleJacobian._compute

    def counted(*arguments):
        made[-1] += 1
        return own(*arguments)

    monkeypatch.setattr(FlexibleJacobian, "_compute", counted)
    runs = []
    for most in (0, 10):
        model = Scene(bodies=flexible_press(modes=4), revolutions=0.15).build()
        made.append(0)
        runs.append(record(model, model.solve(tuning=Tuning(jacobian_steps=most))))
    fresh, kept = runs
    assert made[0] >= fresh.info["steps"]
    assert made[1] < 0.6 * kept.info["steps"]
    assert kept.info["newton_iterations"] < 1.25 * fresh.info["newton_iterations"]
    forces = [np.abs(run.joints["crank_pin"].force).max() for run in runs]
    assert forces[1] == pytest.approx(forces[0], rel=2e-3)
