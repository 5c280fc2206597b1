"""What is read off a run, on motions that are known."""

import math

import numpy as np
import pytest

from exu_press import Scene, simulate
from paper.readings import permanent_contact, readings


@pytest.fixture(scope="module")
def ideal():
    scene = Scene(joints={"crank_pin": "ideal", "balls": "ideal"}, revolutions=2.0)
    return simulate(scene.replace({"solver.step": 5e-4}))


def with_motion(result, time, position, velocity, acceleration):
    """Return a result with another slider motion."""
    values = {
        "time": time,
        "crank_angle": result.scene.angular_speed * time,
        "slider_position": position,
        "slider_velocity": velocity,
        "slider_acceleration": acceleration,
    }
    at = np.clip(np.searchsorted(result.time, time), 0, len(result.time) - 1)
    return result.with_values({name: values.get(name, result[name][at]) for name in result})


def test_an_impact_is_spread_over_the_millisecond(ideal):
    """A velocity change of 0.05 m/s within 75 us is 667 m/s^2 resolved, 50 over 1 ms."""
    time = np.linspace(0.0, 0.5, 200001)
    velocity = 0.05 * np.clip((time - 0.4) / 75e-6, 0.0, 1.0)
    position = np.concatenate([[0.0], np.cumsum(0.5 * (velocity[1:] + velocity[:-1]) * 2.5e-6)])
    acceleration = np.gradient(velocity, time)
    read = readings(with_motion(ideal, time, position, velocity, acceleration))
    assert read["peak_acceleration.resolved"] == pytest.approx(0.05 / 75e-6, rel=1e-3)
    assert read["peak_acceleration.mean_1ms"] == pytest.approx(50.0, rel=1e-3)
    assert read["peak_acceleration.differentiated_1khz"] <= 50.01


def test_a_centred_journal_costs_petroffs_power():
    scene = Scene(joints={"crank_pin": "lubricated"}, film={"law": "pinkus"}, revolutions=0.05)
    run = simulate(scene)
    read = readings(run)
    petroff = 2.0 * math.pi * 0.4 * 0.1 * 0.07**3 * scene.angular_speed**2 / 1e-4
    # near top dead centre the linkage turns the crank's way, at 0.03 / 0.383 of its speed
    assert read["power.pin"] == pytest.approx(petroff * (1.0 - 0.03 / 0.383) ** 2, rel=0.01)
    assert read["power"] == read["power.pin"]


@pytest.mark.parametrize(("length", "lasting"), [(0.9e-3, False), (1.1e-3, True)])
def test_a_touch_of_more_than_a_millisecond_is_permanent_contact(length, lasting):
    time = np.linspace(0.0, 0.1, 10001)
    depth = np.where((time > 0.05) & (time < 0.05 + length), 1e-6, -1e-6)
    assert permanent_contact(time, depth) == pytest.approx(length / 0.1 * lasting, rel=0.05)
