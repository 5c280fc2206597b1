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
        "revolutions": 1.0 if start_angle_deg == 0.0 else 0.75,
        "start_angle_deg": start_angle_deg,
        "solver": {"step": 1e-4},
    }
    result = simulate(Scene.from_dict(scene))
    assert result.completed, result.info["reason"]
    return result


@pytest.mark.parametrize(
    ("mechanism", "start"),
    [("press", 0.0), ("press", 123.0), ("slider_crank", -70.0)],
)
def test_bodies_and_output_follow(mechanism, start):
    """Velocities to 1e-5 of the peak: the integrator's own error at this step, 0.1 ms.

    Generalized-alpha on position constraints needs some steps to forget its start. Where the run
    does not begin at a dead centre, accelerations and constraint forces carry a transient of first
    order in the step: h times the jerk (0.02 .. 0.05 m/s^2 at 0.1 ms), gone to 1 % of itself within
    40 steps.
    """
    result = run(mechanism, start)
    scene = result.scene
    angle = scene.start_angle + scene.angular_speed * result.time
    assert np.abs(result["crank_angle"] - angle).max() < 1e-12
    motion = mechanism_of(scene).motion(result["crank_angle"], scene.angular_speed)
    for index, name in enumerate(result.bodies):
        error = result["body_position"][:, index] - motion[name].position
        assert np.abs(error).max() < 1e-8, name
    position, velocity, acceleration = mechanism_of(scene).ideal_slider(angle, scene.angular_speed)
    assert np.abs(result["slider_position"] - position).max() < 1e-9
    assert np.abs(result["slider_velocity"] - velocity).max() < 1e-5 * np.abs(velocity).max()
    error = np.abs(result["slider_acceleration"] - acceleration) / np.abs(acceleration).max()
    assert error[0] < 1e-6
    assert error[:40].max() < 4e-3
    assert error[40:].max() < 5e-5


def test_both_balls_carry_the_same_force_and_together_the_slider():
    """Newton's law of the slider: the balls carry m (a + g), each one half of it."""
    result = run("press")
    left, right = result["ball_left_force"], result["ball_right_force"]
    scale = np.abs(left).max()
    assert np.abs(left - right).max() < 2e-6 * scale  # Newton's tolerance
    lifted = 1347.0 * (result["slider_acceleration"] + 9.81)
    # The force on the ball is the opposite of the one on the slider.
    assert np.abs((left + right)[1:, 1] + lifted[1:]).max() < 1e-6 * scale
    assert np.abs(left[:, (0, 2)]).max() < 1e-14 * scale


@pytest.mark.validation(
    "table",
    "the paper's press with ideal joints, 240 rpm",
    "the paper (CITATION.cff), section 5",
    "published numbers",
    "Its numbers with clearance, of flexible parts, are compared in [the paper, number by number]"
    "(paper.md).",
)
def test_summary_shows_the_published_numbers(compare):
    quantity = run("press").quantity
    for name, theirs, within, unit, show in (
        ("stroke", 26.19e-3, 0.02e-3, "mm", 1e3),
        ("peak_acceleration.resolved", 17.84, 0.05, "m/s^2", 1.0),
        ("peak_velocity", 0.441, 1e-3, "m/s", 1.0),
    ):
        ours = quantity(name).value
        compare(name, theirs, ours, error=1e-4 * ours, abs=within, unit=unit, show=show)
    assert quantity("bottom_dead_centre").value == pytest.approx(0.47, abs=1e-7)
