"""The ideal slider-crank against its textbook closed form."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from exu_press import Scene
from exu_press.scene import mechanism_of

SIZE = {
    "crank_radius": 0.05,
    "rod_length": 0.2,
    "rod_mass": 3.0,
    "rod_inertia": 0.01,
    "slider_mass": 7.0,
}
SLIDER_CRANK = mechanism_of(
    Scene.from_dict({"mechanism": "slider_crank", "joints": {}, "slider_crank": SIZE})
)
ANGLE = np.radians(np.arange(0.0, 360.0, 1.0))
SPEED = 30.0


def test_slider_follows_the_textbook():
    """y = r cos - sqrt(l^2 - r^2 sin^2), hanging below."""
    r, length = SIZE["crank_radius"], SIZE["rod_length"]
    root = np.sqrt(length**2 - (r * np.sin(ANGLE)) ** 2)
    position, velocity, acceleration = SLIDER_CRANK.ideal_slider(ANGLE, SPEED)
    half = r**2 * np.sin(2 * ANGLE) / 2
    root_2 = (r**2 * np.cos(2 * ANGLE) + half**2 / root**2) / root
    assert_allclose(position, r * np.cos(ANGLE) - root, atol=1e-15)
    assert_allclose(velocity, SPEED * (-r * np.sin(ANGLE) + half / root), atol=1e-13)
    assert_allclose(acceleration, SPEED**2 * (-r * np.cos(ANGLE) + root_2), atol=1e-11)


def test_crank_is_on_top_and_turns_counter_clockwise():
    crank = SLIDER_CRANK.motion(np.array([0.0, math.pi / 2]), SPEED)["crank"]
    pin = next(joint for joint in SLIDER_CRANK.joints if joint.name == "crank_pin")
    assert SLIDER_CRANK.ends(pin)[0] == ("crank", (0.0, 0.05))
    assert np.array_equal(crank.position[:, 2], [0.0, math.pi / 2])
    assert np.all(crank.velocity[:, 2] == SPEED)


def test_rod_carries_the_bearing():
    pin = next(joint for joint in SLIDER_CRANK.joints if joint.name == "crank_pin")
    body, point = SLIDER_CRANK.ends(pin)[1]
    assert body == "rod"
    assert point == pytest.approx((-0.1, 0.0), abs=1e-15)
