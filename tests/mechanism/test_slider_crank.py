"""The ideal slider-crank against its textbook closed form."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from exu_press import Scene
from exu_press.mechanism import GROUND, mechanism_of

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


def test_stroke_is_twice_the_crank_radius():
    position, _, _ = SLIDER_CRANK.ideal_slider(ANGLE, SPEED)
    assert np.ptp(position) == pytest.approx(0.1, abs=1e-15)
    assert position.argmax() == 0
    assert position.argmin() == 180


def test_crank_is_on_top_and_turns_counter_clockwise():
    crank = SLIDER_CRANK.motion(np.array([0.0, math.pi / 2]), SPEED)["crank"]
    pin = next(joint for joint in SLIDER_CRANK.joints if joint.name == "crank_pin")
    assert (pin.journal, pin.journal_point) == ("crank", (0.0, 0.05))
    assert np.array_equal(crank.position[:, 2], [0.0, math.pi / 2])
    assert np.all(crank.velocity[:, 2] == SPEED)


def test_rod_carries_the_bearing():
    pin = next(joint for joint in SLIDER_CRANK.joints if joint.name == "crank_pin")
    assert (pin.bearing, pin.bearing_point) == ("rod", (-0.1, 0.0))


def test_every_joint_is_closed_at_every_angle():
    at = SLIDER_CRANK.motion(ANGLE, SPEED)
    for joint in SLIDER_CRANK.joints:
        ends = []
        for body, (along, across) in (
            (joint.journal, joint.journal_point),
            (joint.bearing, joint.bearing_point),
        ):
            if body == GROUND:
                ends.append(np.broadcast_to((along, across), (len(ANGLE), 2)))
                continue
            x, y, turn = at[body].position.T
            c, s = np.cos(turn), np.sin(turn)
            ends.append(np.stack([x + c * along - s * across, y + s * along + c * across], 1))
        assert_allclose(ends[0], ends[1], atol=1e-15, err_msg=joint.name)


def test_velocities_and_accelerations_of_every_body_are_derivatives():
    width = 1e-4
    a, b, c, d = (SLIDER_CRANK.motion(ANGLE + k * width, SPEED) for k in (-2, -1, 1, 2))
    for name, body in SLIDER_CRANK.motion(ANGLE, SPEED).items():
        for level, rate in (("position", "velocity"), ("velocity", "acceleration")):
            p, q, r, s = (getattr(m[name], level) for m in (a, b, c, d))
            difference = (p - 8 * q + 8 * r - s) / (12 * width / SPEED)
            given = getattr(body, rate)
            scale = max(1.0, np.abs(given).max())
            assert np.abs(given - difference).max() < 1e-8 * scale, (name, rate)
