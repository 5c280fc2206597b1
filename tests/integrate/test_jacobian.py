"""Newton's matrix of flexible systems changes only what a run costs."""

from importlib.util import find_spec

import numpy as np
import pytest
from patched import PATCHED

from exu_press import Scene, simulate
from exu_press.integrate import predictor
from exu_press.scene import flexible_press

NGSOLVE = pytest.mark.skipif(find_spec("ngsolve") is None, reason="flexible parts need NGSolve")


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
def test_it_changes_the_cost_and_not_the_result(flexible, monkeypatch):
    kept = simulate(flexible)
    monkeypatch.setattr(predictor, "FlexibleJacobian", lambda task: None)
    stock = simulate(flexible)
    assert kept.completed and stock.completed
    peaks = [np.abs(run["slider_acceleration"]).max() for run in (kept, stock)]
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    iterations = [run.info["newton_iterations"] / run.info["steps"] for run in (kept, stock)]
    assert iterations[0] < 1.4 * iterations[1]


@NGSOLVE
@pytest.mark.long
def test_no_alternation_grows_from_what_newtons_method_leaves_in_the_constraints():
    """One iteration a step ends with the counterweight at +-11 m/s^2 about -10, and worse."""
    result = simulate(Scene(bodies=flexible_press(), joints={}, revolutions=0.55))
    assert result.completed, result.summary()["reason"]
    force = result["counterweight_pin_force"][:, 1]
    assert np.abs(np.diff(force, 2)).max() < 0.05 * np.abs(force).max()
