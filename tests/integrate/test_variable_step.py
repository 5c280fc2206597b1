"""A change of step must not show in the accelerations."""

import itertools

import numpy as np
import pytest
from patched import PATCHED
from stand_in_system import pendulum, settings

from exu_press import Scene, simulate
from exu_press.integrate import SolverStatus, solve_dynamic
from exu_press.integrate.constraints import Constraints
from exu_press.integrate.stepping import FixedSteps, StepControl
from exu_press.integrate.variable_step import VariableStepCorrection

STEPS = [4e-4] * 8 + [5e-5] * 8 + [1e-4] * 3 + [2e-4] * 3
"""s, in turn: shortened at once, lengthened by doubling, as the step control does."""


def alternate(control, time):
    """Take some long and some short steps in turn, exactly to the end."""
    control.count = getattr(control, "count", 0) + 1
    step = STEPS[control.count % len(STEPS)]
    left = control._end - time
    return min(step, left) if left > 1e-12 else step


@pytest.fixture
def alternating_steps(monkeypatch):
    monkeypatch.setattr(StepControl, "next_step", alternate)
    monkeypatch.setattr(StepControl, "shorter", lambda control, step: 0.0)
    monkeypatch.setattr(StepControl, "accept_step", lambda control, step, at_event=False: None)


def ringing(scene):
    """Largest error of the slider's acceleration once the start is over, m/s^2."""
    result = simulate(scene)
    assert result.completed
    motion = result.scene.build().mechanism.ideal_slider(result["crank_angle"], scene.angular_speed)
    later = result.time > 0.01
    return np.abs(result["slider_acceleration"] - motion[2])[later].max()


@PATCHED
def test_shorter_steps_do_not_ring(alternating_steps, monkeypatch):
    scene = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.25)
    fitted = ringing(scene)
    monkeypatch.setattr(VariableStepCorrection, "before_try", lambda change, start, step: None)
    assert fitted < 0.2 * ringing(scene)
    assert fitted < 0.02 * 17.8


@PATCHED
def test_a_repeated_step_starts_as_its_first_try_did(monkeypatch):
    """Exudyn keeps the algorithmic acceleration of the failed try; here every step fails once."""
    scene = Scene(
        joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=0.1, solver={"step": 2e-4}
    )
    failing = iter([])

    def fail_every_other(control, step):
        return 0.5 * step if next(failing) else 0.0

    monkeypatch.setattr(FixedSteps, "shorter", fail_every_other)

    def error():
        nonlocal failing
        failing = itertools.cycle([True, False])
        result = simulate(scene)
        assert result.info["rejected_steps"] >= result.info["steps"]
        motion = scene.build().mechanism.ideal_slider(result["crank_angle"], scene.angular_speed)
        return np.abs(result["slider_acceleration"] - motion[2])[20:].max()

    fitted = error()
    monkeypatch.setattr(VariableStepCorrection, "before_try", lambda change, start, step: None)
    assert fitted < 0.1 * error()


def test_films_take_up_their_load_in_short_steps():
    """At rest the film carries nothing; a long first step would make the accelerations ring."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"}, revolutions=0.05)
    peaks = [
        np.abs(simulate(scene.replace({f"solver.{key}": value}))["slider_acceleration"]).max()
        for key, value in (("step", 1e-3), ("step", 1e-5), ("tolerance", 1e-2), ("tolerance", 1e-4))
    ]
    assert peaks == pytest.approx([peaks[1]] * 4, rel=5e-3)


def test_a_change_of_step_leaves_journals_where_they_are_in_their_films():
    """Moved by 1e-5 m/s, in the norm of masses, this one answered with kilonewtons."""
    pin = {"kind": "lubricated", "clearance": 5e-5, "radius": 0.035}
    scene = Scene(
        mechanism="six_bar",
        speed_rpm=60.0,
        revolutions=0.5,
        joints={"wrist_pin": pin},
        film={"viscosity": 0.4, "length": 0.1},
    )
    loose, tight = (simulate(scene.replace({"solver.tolerance": part})) for part in (1e-2, 1e-4))
    forces = [run.quantity("joints.wrist_pin.peak_force").value for run in (loose, tight)]
    assert forces[1] == pytest.approx(forces[0], rel=4e-3)  # 16 % too large


def test_a_contact_that_lets_go_is_no_place_for_a_change():
    """It gives way: the change that it resists least was 6 m/s, and the peak 39 620 m/s^2."""
    scene = Scene(
        joints={"crank_pin": {"kind": "dry", "clearance": 1.75e-4}},
        load={"blanking": {"kind": "blanking", "force": 1e4}},
        solver={"tolerance": 4e-3, "max_steps": 2000},
    )
    run = simulate(scene)
    assert run.time[-1] > 0.0506
    assert np.abs(run["slider_acceleration"]).max() < 600.0


@PATCHED
def test_changes_that_lead_away_from_the_constraints_are_not_made(monkeypatch):
    """As where three angles pass 90 degrees in a step: 6e11 m/s instead of 1 m/s, and a stop."""
    right = Constraints.projection

    def away(constraints, norm, directions):
        changes = right(constraints, norm, directions)
        return lambda violations: -5.0 * changes(violations)

    monkeypatch.setattr(Constraints, "projection", away)
    outcome = solve_dynamic(pendulum(None, speed=4.0), settings(1.0))
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert outcome.steps + outcome.rejected_steps < 500
