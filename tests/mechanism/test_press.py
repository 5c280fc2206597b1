"""The ideal press: published numbers, loops that close, links that keep their length."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from exu_press import Scene
from exu_press.mechanism import GROUND, mechanism_of

IDEAL = Scene.from_dict({"mechanism": "press", "joints": {}})
PRESS = mechanism_of(IDEAL)
DEGREES = np.arange(0.0, 360.0, 0.1)
BOTTOM = 1800


def motion(speed_rpm=240.0, degrees=DEGREES):
    return PRESS.motion(np.radians(degrees), speed_rpm * math.pi / 30)


def point(body, offset):
    """Position (n, 2) of a point of a body."""
    x, y, angle = body.position.T
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([x + c * offset[0] - s * offset[1], y + s * offset[0] + c * offset[1]], 1)


def slider(speed_rpm=240.0):
    return PRESS.ideal_slider(np.radians(DEGREES), speed_rpm * math.pi / 30)


def test_stroke():
    position, _, _ = slider()
    assert np.ptp(position) == pytest.approx(26.19e-3, abs=0.02e-3)


def test_peak_acceleration_at_240_rpm():
    """17.84 m/s^2 (the paper measures 17.8)."""
    _, _, acceleration = slider()
    assert np.abs(acceleration).max() == pytest.approx(17.84, abs=0.05)


@pytest.mark.parametrize(
    ("speed_rpm", "peak", "digit"), [(240.0, 0.441, 5e-4), (200.0, 0.37, 5e-3), (500.0, 0.92, 5e-3)]
)
def test_peak_velocity(speed_rpm, peak, digit):
    _, velocity, _ = slider(speed_rpm)
    assert np.abs(velocity).max() == pytest.approx(peak, abs=digit)


def test_bottom_dead_centre_is_the_lowest_point_and_lies_at_470_mm():
    position, velocity, _ = slider()
    assert position.argmin() == BOTTOM
    assert position[BOTTOM] == pytest.approx(0.47, abs=1e-12)
    assert velocity[BOTTOM] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("side", ["left", "right"])
def test_knuckle_is_straight_at_bottom_dead_centre(side):
    """Links 6 and 7 hang in one vertical line: pivot, knuckle, plunger."""
    at = motion(degrees=np.array([180.0]))
    x = {"left": -0.1655, "right": 0.1655}[side]
    for link in ("link_6", "link_7"):
        body = at[f"{link}_{side}"]
        assert body.position[0, 0] == pytest.approx(x, abs=1e-12)
        assert body.position[0, 2] == pytest.approx(-math.pi / 2, abs=1e-9)


def test_velocities_and_accelerations_of_every_body_are_derivatives():
    speed, width = 240 * math.pi / 30, 1e-4
    angle = np.radians(np.arange(0.0, 360.0, 1.0))
    a, b, c, d = (PRESS.motion(angle + k * width, speed) for k in (-2, -1, 1, 2))
    for name, body in PRESS.motion(angle, speed).items():
        for level, rate in (("position", "velocity"), ("velocity", "acceleration")):
            p, q, r, s = (getattr(m[name], level) for m in (a, b, c, d))
            difference = (p - 8 * q + 8 * r - s) / (12 * width / speed)
            given = getattr(body, rate)
            scale = max(1.0, np.abs(given).max())
            assert np.abs(given - difference).max() < 1e-8 * scale, (name, rate)


def test_every_joint_is_closed_at_every_angle():
    """The two bodies of each joint meet in it; that covers every link's length too."""
    at = motion()
    for joint in PRESS.joints:
        journal = point(at[joint.journal], joint.journal_point)
        if joint.bearing == GROUND:
            bearing = np.broadcast_to(joint.bearing_point, journal.shape)
        else:
            bearing = point(at[joint.bearing], joint.bearing_point)
        assert_allclose(journal, bearing, atol=1e-14, rtol=0, err_msg=joint.name)


def test_every_guide_holds_what_it_says():
    at = motion()
    for guide in PRESS.guides:
        x, _, angle = at[guide.body].position.T
        assert np.ptp(x) == 0.0, guide
        assert np.all(angle == 0.0), guide


@pytest.mark.parametrize(
    ("body", "length"),
    [
        ("linkage", 0.383),
        ("link_5_left", 0.23),
        ("link_5_right", 0.23),
        ("link_6_left", 0.24),
        ("link_6_right", 0.24),
        ("link_7_left", 0.164),
        ("link_7_right", 0.164),
        ("counter_linkage", 0.275),
    ],
)
def test_link_lengths_of_table_2(body, length):
    """Both joints of a link sit at its ends, so that closed joints mean a constant length."""
    ends = [
        joint.journal_point if joint.journal == body else joint.bearing_point
        for joint in PRESS.joints
        if body in (joint.journal, joint.bearing)
    ]
    assert {end[1] for end in ends} == {0.0}
    assert {end[0] for end in ends} == {length / 2, -length / 2}


def test_the_two_sides_are_mirror_images():
    at = motion()
    for part in ("link_5", "link_6", "link_7", "plunger"):
        left, right = at[f"{part}_left"], at[f"{part}_right"]
        assert_allclose(left.position[:, 0], -right.position[:, 0], atol=1e-14)
        assert_allclose(left.position[:, 1], right.position[:, 1], atol=1e-14)


def test_counterweight_moves_against_the_slide_above_the_shaft():
    at = motion()
    weight, slide = at["counterweight"].position[:, 1], at["slide"].position[:, 1]
    assert weight.min() > 0.0
    assert np.corrcoef(weight, slide)[0, 1] < -0.99


def test_masses_of_table_2():
    """Links per side (A-7), slide 60 kg (A-4)."""
    assert {body.name: body.mass for body in PRESS.bodies} == {
        "crank": 217.6,
        "linkage": 184.5,
        "slide": 60.0,
        "link_5_right": 22.72,
        "link_6_right": 24.13,
        "link_7_right": 15.5,
        "plunger_right": 155.3,
        "link_5_left": 22.72,
        "link_6_left": 24.13,
        "link_7_left": 15.5,
        "plunger_left": 155.3,
        "slider": 1347.0,
        "counter_linkage": 22.58,
        "counterweight": 1847.2,
    }


def test_links_are_uniform_rods():
    """A-6: inertia m l^2 / 12 about the middle."""
    inertia = {body.name: body.inertia for body in PRESS.bodies}
    assert inertia["linkage"] == pytest.approx(184.5 * 0.383**2 / 12)
    assert inertia["link_6_left"] == pytest.approx(24.13 * 0.24**2 / 12)
