"""Local error of a step, from its criteria, and that criteria can be exchanged."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED
from stand_in_system import pendulum, settings

from exu_press import Scene, simulate
from exu_press.integrate import solve_dynamic
from exu_press.integrate.error import StepError, default_criteria
from exu_press.scene import flexible_press


def criterion(error, **attributes):
    """A criterion of one error in every step."""
    return SimpleNamespace(
        error=lambda step: error, accept_step=lambda: None, restart=lambda: None, **attributes
    )


def estimate(*criteria):
    step_error = StepError(SimpleNamespace(scales=None), lambda task: criteria)
    step_error.begin()
    return step_error


@PATCHED
def test_the_largest_error_counts_and_what_is_no_number():
    assert estimate(criterion(0.3), criterion(2.0), criterion(0.0))(0.1) == 2.0
    assert math.isnan(estimate(criterion(2.0), criterion(math.nan), criterion(3.0))(0.1))


@PATCHED
def test_the_joint_that_limits_most_steps_is_known():
    """Joints together have to limit half of the steps: two pins share them."""
    step_error = estimate(criterion(0.5), criterion(0.6, joint="one"), criterion(0.1, joint="two"))
    step_error(0.1)
    assert step_error.limiting_joint() == "one"
    assert estimate(criterion(0.5)).limiting_joint() is None
    of_body = estimate(criterion(0.5), criterion(0.4, joint="one"))
    of_body(0.1)
    assert of_body.limiting_joint() is None


class PositionError:
    """Another criterion: no step longer than a hundredth of the run."""

    def __init__(self, task):
        self.longest = 0.01 * (task.end - task.start)
        self.accepted = self.restarted = 0

    def restart(self):
        self.restarted += 1

    def error(self, step):
        return (step / self.longest) ** 3

    def accept_step(self):
        self.accepted += 1


def test_a_criterion_is_exchanged():
    made = []

    def criteria(task):
        made.append(PositionError(task))
        return [*default_criteria(task), made[0]]

    usual = solve_dynamic(pendulum("dry"), settings(0.2, steps=10))
    outcome = solve_dynamic(pendulum("dry"), settings(0.2, steps=10), criteria=criteria).check()
    assert made[0].accepted == outcome.steps >= 100
    assert made[0].restarted == 1
    assert usual.steps < outcome.steps


@pytest.mark.parametrize("mechanism", ["slider_crank", "press"])
def test_velocities_of_an_ideal_mechanism_follow_the_tolerance(mechanism):
    for tolerance in (1e-4, 1e-5):
        scene = Scene(
            mechanism=mechanism, joints={}, revolutions=0.25, solver={"tolerance": tolerance}
        )
        run = simulate(scene)
        assert run.completed
        motion = scene.build().mechanism.ideal_slider(run["crank_angle"], scene.angular_speed)
        error = np.abs(run["slider_velocity"] - motion[1]).max() / scene.pin_speed
        assert 0.02 * tolerance < error < 2.0 * tolerance


def test_lasting_contacts_follow_the_tolerance():
    """Steps of a lasting contact went with tolerance^(-1/15) while rounding was overrated."""
    steps = []
    for tolerance in (1e-3, 1e-4):
        scene = Scene(
            joints={"crank_pin": "dry", "balls": "dry"},
            revolutions=0.025,
            solver={"tolerance": tolerance},
        )
        info = simulate(scene).info
        assert info["newton_iterations"] < 1.3 * info["steps"]
        steps.append(info["steps"])
    assert 2.0 < steps[1] / steps[0] < 5.0


def test_thin_films_follow_the_tolerance():
    """An error of 0.1 at 1e-2 while each step had its part of the clearance."""
    thin = {"crank_pin": {"kind": "lubricated", "clearance": 1e-5}}
    scene = Scene(mechanism="slider_crank", joints=thin, revolutions=0.12)
    ratios = {}
    for tolerance in (1e-2, 1e-3):
        run = simulate(scene.replace({"solver.tolerance": tolerance}))
        ratios[tolerance] = np.linalg.norm(run["crank_pin_eccentricity"], axis=1).max() / 1e-5
    assert abs(ratios[1e-2] - ratios[1e-3]) < 2.0 * 1e-2


@pytest.mark.long
def test_vibrating_bodies_follow_the_tolerance():
    """The impact at 44 ms follows from how the bodies vibrate after the one at 34 ms."""
    scene = Scene(revolutions=0.2, bodies=flexible_press(modes=4))
    peaks = {}
    for tolerance in (1e-1, 1e-3):
        run = simulate(scene.replace({"solver.tolerance": tolerance}))
        late = run.time > 0.04
        peaks[tolerance] = np.abs(run["slider_acceleration"][late]).max()
    assert peaks[1e-1] == pytest.approx(peaks[1e-3], rel=0.3)  # 51 % too high
