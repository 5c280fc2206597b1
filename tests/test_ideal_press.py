"""Exudyn with ideal joints follows the closed form.

The closed form is what the model starts on; nothing but the constraints keeps it there.
"""

import functools

import numpy as np
import pytest

from exu_press import Result, Scene, simulate
from exu_press.scene import mechanism_of


@functools.cache
def run(mechanism: str, start_angle_deg: float = 0.0) -> Result:
    scene = {
        "mechanism": mechanism,
        "joints": {},
        "revolutions": 1.0,
        "start_angle_deg": start_angle_deg,
        "solver": {"step": 1e-4},
    }
    result = simulate(Scene.from_dict(scene))
    assert result.completed, result.info["reason"]
    return result


def closed_form(result):
    scene = result.scene
    angle = scene.start_angle + scene.angular_speed * result.time
    return mechanism_of(scene).ideal_slider(angle, scene.angular_speed)


CASES = pytest.mark.parametrize(
    ("mechanism", "start"),
    [("press", 0.0), ("press", 123.0), ("slider_crank", 0.0), ("slider_crank", -70.0)],
)


@CASES
def test_slider_position(mechanism, start):
    result = run(mechanism, start)
    assert np.abs(result["slider_position"] - closed_form(result)[0]).max() < 1e-9


@CASES
def test_slider_velocity(mechanism, start):
    """To 1e-5 of the peak: the integrator's own error at this step, 0.1 ms."""
    result = run(mechanism, start)
    expected = closed_form(result)[1]
    assert np.abs(result["slider_velocity"] - expected).max() < 1e-5 * np.abs(expected).max()


@CASES
def test_slider_acceleration(mechanism, start):
    """Generalized-alpha on position constraints needs some steps to forget its start.

    Where the run does not begin at a dead centre, accelerations and constraint forces carry a
    transient of first order in the step: h times the jerk (0.02 .. 0.05 m/s^2 at 0.1 ms), gone to
    1 % of itself within 40 steps.
    """
    result = run(mechanism, start)
    expected = closed_form(result)[2]
    error = np.abs(result["slider_acceleration"] - expected) / np.abs(expected).max()
    assert error[0] < 1e-6
    assert error[:40].max() < 4e-3
    assert error[40:].max() < 5e-5


@CASES
def test_crank_angle(mechanism, start):
    result = run(mechanism, start)
    expected = result.scene.start_angle + result.scene.angular_speed * result.time
    assert np.abs(result["crank_angle"] - expected).max() < 1e-12


@CASES
def test_every_body_follows(mechanism, start):
    result = run(mechanism, start)
    motion = mechanism_of(result.scene).motion(result["crank_angle"], result.scene.angular_speed)
    for index, name in enumerate(result.bodies):
        error = result["body_position"][:, index] - motion[name].position
        assert np.abs(error).max() < 1e-8, name


def test_both_balls_carry_the_same_force_and_together_the_slider():
    """Newton's law of the slider: the balls carry m (a + g), each one half of it."""
    result = run("press")
    left, right = result["ball_left_force"], result["ball_right_force"]
    scale = np.abs(left).max()
    assert np.abs(left - right).max() < 1e-6 * scale  # Newton's tolerance
    lifted = 1347.0 * (result["slider_acceleration"] + 9.81)
    # The force on the ball is the opposite of the one on the slider.
    assert np.abs((left + right)[1:, 1] + lifted[1:]).max() < 1e-6 * scale
    assert np.abs(left[:, (0, 2)]).max() < 1e-14 * scale


def test_summary_shows_the_published_numbers():
    """Stroke 26.19 mm, 17.84 m/s^2 and 0.441 m/s at 240 rpm, bottom dead centre at 0.47 m."""
    summary = run("press").summary()
    assert summary["quantities"]["stroke"]["value"] == pytest.approx(26.19e-3, abs=0.02e-3)
    assert summary["quantities"]["peak_acceleration.resolved"]["value"] == pytest.approx(
        17.84, abs=0.05
    )
    assert summary["quantities"]["peak_velocity"]["value"] == pytest.approx(0.441, abs=1e-3)
    assert summary["quantities"]["bottom_dead_centre"]["value"] == pytest.approx(0.47, abs=1e-7)
