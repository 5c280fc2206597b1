"""A flexible body's stiffness is differentiated once; Newton's matrix must stay right."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.integrate.flexible_jacobian import FlexibleJacobian

pytest.importorskip("ngsolve")


@pytest.fixture
def scene():
    return Scene(
        bodies="flexible",
        crank_pin="lubricated",
        balls="dry",
        revolutions=0.1,
        flexible={"modes": 4},
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
        inertia = (1.0 - solver.alphaM) / (1.0 - solver.alphaF) * solver.GetSystemMassMatrix()
        solver.ComputeJacobianODE2RHS(mbs, -by_q, -by_q_t)
        exudyn = matrix.copy()
        exudyn[:size, :size] = inertia + np.array(solver.GetSystemJacobian())[:size, :size]
        solver.SetSystemJacobian(matrix)
        errors = np.linalg.eigvals(np.linalg.solve(matrix, matrix - exudyn))
        left.append(np.abs(errors).max())
        return mine

    monkeypatch.setattr(FlexibleJacobian, "_compute", compare)
    assert simulate(scene).completed
    assert len(left) > 50
    assert max(left) < 0.02
    assert np.median(left) < 1e-4


def test_it_changes_the_cost_and_not_the_result(scene, monkeypatch):
    kept = simulate(scene)
    monkeypatch.setattr(FlexibleJacobian, "__init__", lambda *_: None)
    stock = simulate(scene)
    assert kept.completed and stock.completed
    peaks = [np.abs(run["slider_acceleration"]).max() for run in (kept, stock)]
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    assert kept.info["newton_iterations"] < 1.1 * stock.info["newton_iterations"]


def test_a_kept_jacobian_leaves_no_ring_in_the_constraints(monkeypatch):
    """The counter-pin carries 36 kN; iterations with an old Jacobian left per cents of it."""
    from exu_press.integrate import run

    scene = Scene(
        bodies="flexible",
        crank_pin="ideal",
        balls="ideal",
        flexible={"modes": 4, "mesh_size": 0.05},
        revolutions=0.02,
        solver={"step": 1e-5},
    )
    result = simulate(scene)
    usual = run.settings_for

    def finer(scene):
        settings = usual(scene)
        settings.timeIntegration.newton.absoluteTolerance *= 1e-3
        return settings

    monkeypatch.setattr(run, "settings_for", finer)
    expected = simulate(scene)["counter_pin_force"]
    assert result.info["newton_iterations"] < 2.0 * result.info["steps"]
    error = np.abs(result["counter_pin_force"] - expected)[50:]
    assert error.max() < 1e-4 * np.abs(expected).max()
