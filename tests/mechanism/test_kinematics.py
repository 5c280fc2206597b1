"""Loops closed by Newton's method: every joint, derivatives, textbooks, and what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest
from drawings import coupled_cranks, four_bar, slider_crank, stephenson
from refused import refused

import exu_press.mechanism as shipped
from exu_press import InputError
from exu_press.mechanism import GROUND, Press, SliderCrank
from exu_press.mechanism.turning import require_turning

ANGLES = np.radians(np.arange(0.0, 360.0, 2.0))
SPEED = 25.0
DRAWINGS = {
    "press": shipped.press(Press()),
    "another press": shipped.press(Press(crank_radius=0.05, linkage_mass_offset=0.1)),
    "slider-crank": shipped.slider_crank(SliderCrank()),
    "four-bar": four_bar(),
    "drag link": four_bar(crank=0.3, coupler=0.25, rocker=0.35, base=0.1),
    "oblique guide": slider_crank(tilt=0.5, offset=0.05),
    "guide along -x": slider_crank(tilt=math.pi, offset=-0.02, at=3.0),
    "doubled rod": slider_crank(tilt=math.pi / 2, second_rod=True),
    "coupled cranks": coupled_cranks(),
    "stephenson": stephenson(),
    "gears": shipped.shipped_mechanism("two_point_press"),
    "planet": shipped.shipped_mechanism("cycloidal_press"),
}
ALL = pytest.mark.parametrize("mechanism", DRAWINGS.values(), ids=DRAWINGS)


def places(mechanism, motion, joint):
    """Where the two bodies of a joint have it, (n, 2) each."""
    return [
        np.broadcast_to(point, (len(ANGLES), 2))
        if body == GROUND
        else motion[body].point_motion(point).position[:, :2]
        for body, point in mechanism.ends(joint)
    ]


@ALL
def test_every_joint_is_closed_and_every_guide_kept(mechanism):
    """And the crank turns from the drawing on."""
    motion = mechanism.motion(ANGLES, SPEED)
    for body in mechanism.bodies:
        drawn = [*body.centre_of_mass, body.angle]
        assert motion[body.name].position[0] == pytest.approx(drawn, abs=1e-13), body.name
    crank = motion[mechanism.crank]
    turned = crank.position[:, 2] - mechanism.body(mechanism.crank).angle
    assert turned == pytest.approx(ANGLES, abs=1e-14)
    assert np.all(crank.velocity[:, 2] == SPEED)
    for joint in mechanism.joints:
        one, other = places(mechanism, motion, joint)
        assert one == pytest.approx(other, abs=1e-12 * mechanism.size), joint.name
    for guide in mechanism.guides:
        pose = motion[guide.body].position
        drawn = mechanism.body(guide.body)
        away = (pose[:, :2] - drawn.centre_of_mass) @ np.array(guide.normal)
        assert away == pytest.approx(0.0, abs=1e-13)
        assert pose[:, 2] == pytest.approx(drawn.angle, abs=1e-15)


@ALL
def test_velocities_and_accelerations_are_derivatives(mechanism):
    """Differences exact to the fourth order of 1e-4 rad."""
    width, angle = 1e-4, np.radians(np.arange(0.5, 360.0, 3.0))
    a, b, c, d = (mechanism.motion(angle + k * width, SPEED) for k in (-2, -1, 1, 2))
    for name, body in mechanism.motion(angle, SPEED).items():
        for level, rate in (("position", "velocity"), ("velocity", "acceleration")):
            p, q, r, s = (getattr(m[name], level) for m in (a, b, c, d))
            difference = (p - 8 * q + 8 * r - s) / (12 * width / SPEED)
            given = getattr(body, rate)
            assert np.abs(given - difference).max() < 2e-8 * max(1.0, np.abs(given).max()), name


@ALL
def test_angles_of_any_order_and_revolution(mechanism):
    """Positions repeat; angles of bodies that go round go on."""
    shuffled = np.array([3.0, -1.0, 100.0, 0.2])
    motion = mechanism.motion(shuffled, SPEED)
    for index, angle in enumerate(shuffled):
        by_itself = mechanism.motion(np.array([angle]), SPEED)
        in_a_turn = mechanism.motion(np.array([angle % (2 * np.pi)]), SPEED)
        for name, body in motion.items():
            alone, within = by_itself[name], in_a_turn[name]
            assert body.position[index] == pytest.approx(alone.position[0], abs=1e-13)
            assert body.position[index, :2] == pytest.approx(within.position[0, :2], abs=1e-12)
            turns = (body.position[index, 2] - within.position[0, 2]) / (2 * np.pi)
            assert turns == pytest.approx(round(turns), abs=1e-12)


def test_a_rocker_follows_freudenstein():
    """K1 cos phi - K2 cos theta + K3 = cos(theta - phi), of crank and rocker."""
    crank, coupler, rocker, base = 0.1, 0.4, 0.3, 0.35
    motion = four_bar().motion(ANGLES, 1.0)
    theta = 0.7 + ANGLES
    at_knuckle = np.array(four_bar().joints[2].at) - (base, 0.0)
    phi = math.atan2(at_knuckle[1], at_knuckle[0]) + motion["rocker"].position[:, 2]
    k_1, k_2 = base / crank, base / rocker
    k_3 = (crank**2 - coupler**2 + rocker**2 + base**2) / (2 * crank * rocker)
    left = k_1 * np.cos(phi) - k_2 * np.cos(theta) + k_3
    assert left == pytest.approx(np.cos(theta - phi), abs=1e-12)


def test_a_slider_follows_the_textbook():
    """y = r cos - sqrt(l^2 - r^2 sin^2), hanging below."""
    r, length = 0.05, 0.2
    size = SliderCrank(crank_radius=r, rod_length=length)
    root = np.sqrt(length**2 - (r * np.sin(ANGLES)) ** 2)
    half = r**2 * np.sin(2 * ANGLES) / 2
    root_2 = (r**2 * np.cos(2 * ANGLES) + half**2 / root**2) / root
    expected = (
        r * np.cos(ANGLES) - root,
        SPEED * (-r * np.sin(ANGLES) + half / root),
        SPEED**2 * (-r * np.cos(ANGLES) + root_2),
    )
    found = shipped.slider_crank(size).ideal_slider(ANGLES, SPEED)
    for ours, theirs in zip(found, expected, strict=True):
        assert ours == pytest.approx(theirs, abs=1e-14 * np.abs(theirs).max())


def test_redundant_loops_close_where_half_of_them_is_singular():
    """Each coupling rod alone passes a change point twice a revolution."""
    one_rod = coupled_cranks()
    one_rod = replace(one_rod, bodies=one_rod.bodies[:3], joints=one_rod.joints[:4])
    follower = coupled_cranks().motion(ANGLES, 1.0)["follower"]
    assert follower.position[:, 2] == pytest.approx(ANGLES, abs=1e-12)
    with pytest.raises(InputError, match=r"rod and follower|follower and rod"):
        one_rod.motion(ANGLES, 1.0)


def test_a_change_point_is_refused():
    """A parallelogram branches where all links lie in one line."""
    text = refused(require_turning, four_bar(crank=0.1, coupler=0.35, rocker=0.1, base=0.35))
    assert "branch" in text
    angle = float(text.split("crank angle ")[1].split(" deg")[0])
    assert angle == pytest.approx(180.0 - math.degrees(0.7), abs=0.2)
