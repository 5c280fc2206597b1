"""A change of step must not show in the accelerations."""

import itertools

import numpy as np
import pytest
from patched import PATCHED

from exu_press import Scene, simulate
from exu_press.integrate.step_change import StepChange
from exu_press.integrate.stepping import FixedSteps, StepControl

STEPS = [4e-4] * 8 + [5e-5] * 8 + [1e-4] * 3 + [2e-4] * 3
"""s, in turn: shortened at once, lengthened by doubling, as the step control does."""


def alternate(control, time):
    """Take some long and some short steps in turn, exactly to the end."""
    newton = control._newton
    if time > 0.0:
        newton.stepped(time, newton.data.GetODE2Coordinates_tt().tolist())
    control.count = getattr(control, "count", 0) + 1
    step = STEPS[control.count % len(STEPS)]
    left = control._end - time
    control._iteration.currentStepSize = min(step, left) if left > 1e-12 else step
    return newton.now


@pytest.fixture
def alternating_steps(monkeypatch):
    monkeypatch.setattr(StepControl, "after_step", alternate)
    monkeypatch.setattr(StepControl, "after_newton", lambda control, time: [0.0, -1.0])


def ringing(scene):
    """Largest error of the slider's acceleration once the start is over, m/s^2."""
    result = simulate(scene)
    assert result.completed
    motion = result.scene.build().mechanism.ideal_slider(result["crank_angle"], scene.angular_speed)
    later = result.time > 0.01
    return np.abs(result["slider_acceleration"] - motion[2])[later].max()


@PATCHED
def test_shorter_steps_do_not_ring(alternating_steps, monkeypatch):
    scene = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.5)
    fitted = ringing(scene)
    monkeypatch.setattr(StepChange, "before_try", lambda change, time: None)
    assert fitted < 0.2 * ringing(scene)
    assert fitted < 0.02 * 17.8


@PATCHED
def test_a_repeated_step_starts_as_its_first_try_did(monkeypatch):
    """Exudyn keeps the algorithmic acceleration of the failed try; here every step fails once."""
    scene = Scene(
        joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.1, solver={"step": 2e-4}
    )
    failing = iter([])

    def fail_every_other(control, time):
        return [2.0, -1.0] if next(failing) else [0.0, -1.0]

    monkeypatch.setattr(FixedSteps, "after_newton", fail_every_other)

    def error():
        nonlocal failing
        failing = itertools.cycle([True, False])
        result = simulate(scene)
        assert result.info["rejected_steps"] >= result.info["steps"]
        motion = scene.build().mechanism.ideal_slider(result["crank_angle"], scene.angular_speed)
        return np.abs(result["slider_acceleration"] - motion[2])[20:].max()

    fitted = error()
    monkeypatch.setattr(StepChange, "before_try", lambda change, time: None)
    assert fitted < 0.1 * error()


def test_fixed_steps_return_to_their_grid_after_a_halved_one(monkeypatch):
    scene = Scene(
        joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.1, solver={"step": 2e-4}
    )
    failed = []

    def fail_one(control, time):
        if time > 5e-3 and not failed:
            failed.append(time)
            return [2.0, -1.0]
        return [0.0, -1.0]

    monkeypatch.setattr(FixedSteps, "after_newton", fail_one)
    time = simulate(scene).time
    on_grid = np.abs(time / 2e-4 - np.round(time / 2e-4)) < 1e-6
    assert failed and 1 <= (~on_grid).sum() <= 2
    assert on_grid[-50:].all()


def test_films_take_up_their_load_in_short_steps():
    """At rest the film carries nothing; a long first step would make the accelerations ring."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"}, revolutions=0.05)
    peaks = [
        np.abs(simulate(scene.replace(f"solver.{key}", value))["slider_acceleration"]).max()
        for key, value in (("step", 1e-3), ("step", 1e-5), ("tolerance", 1e-2), ("tolerance", 1e-4))
    ]
    assert peaks == pytest.approx([peaks[1]] * 4, rel=5e-3)
