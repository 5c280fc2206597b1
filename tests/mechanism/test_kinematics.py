"""Building blocks of the closed-form kinematics: derivatives, loop closure, what does not reach."""

import numpy as np
import pytest

from exu_press.mechanism.kinematics import (
    AssemblyError,
    Motion,
    dyad,
    fixed,
    guided,
    rod,
    rotating,
    sliding,
    turning,
)

SPEED = 25.0
ANGLES = np.radians(np.arange(0.0, 360.0, 7.0))


def pin(angle):
    return rotating(angle, SPEED, 0.03)


def guided_end(angle, side=-1):
    return guided("link", pin(angle), 0.383, 0.02, side)


def dyad_pin(angle, side=+1):
    return dyad("links", pin(angle), 0.2, fixed(0.25, 0.05, len(angle)), 0.24, side)


PARTS = {
    "rotating": pin,
    "rotating on the opposite side": lambda angle: rotating(angle, SPEED, -0.016),
    "turning": lambda angle: turning(angle, SPEED, 0.015),
    "guided below": guided_end,
    "guided above": lambda angle: guided_end(angle, +1),
    "dyad to the left": dyad_pin,
    "dyad to the right": lambda angle: dyad_pin(angle, -1),
    "rod to a guide": lambda angle: rod(pin(angle), guided_end(angle)),
    "rod to a dyad": lambda angle: rod(dyad_pin(angle), guided_end(angle)),
    "sliding": lambda angle: sliding(guided_end(angle)),
    "shifted": lambda angle: guided_end(angle).shifted((0.1, -0.2)),
}


def assert_derivatives(motion_of, angle, speed):
    """Velocity and acceleration are the time derivatives of the position, at every angle."""
    width = 1e-4  # rad; the differences below are exact to order width^4
    shifted = [motion_of(angle + k * width) for k in (-2, -1, 1, 2)]
    time = width / speed
    for level, rate in (("position", "velocity"), ("velocity", "acceleration")):
        a, b, c, d = (getattr(motion, level) for motion in shifted)
        difference = (a - 8 * b + 8 * c - d) / (12 * time)
        given = getattr(motion_of(angle), rate)
        scale = max(1.0, np.abs(given).max())
        assert np.abs(given - difference).max() < 1e-8 * scale, (level, rate)


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_velocity_and_acceleration_are_derivatives(part):
    assert_derivatives(part, ANGLES, SPEED)


def test_crank_starts_on_top_and_turns_counter_clockwise():
    at = rotating(np.array([0.0, np.pi / 2]), 1.0, 0.03).position
    assert at == pytest.approx(np.array([[0.0, 0.03], [-0.03, 0.0]]), abs=1e-17)


@pytest.mark.parametrize("side", [-1, +1])
def test_guided_end_keeps_its_length_and_its_side(side):
    link = guided_end(ANGLES, side).position - pin(ANGLES).position
    assert np.hypot(*link.T) == pytest.approx(0.383, abs=1e-15)
    assert np.all(np.sign(link[:, 1]) == side)
    assert np.all(guided_end(ANGLES, side).position[:, 0] == 0.02)


@pytest.mark.parametrize("side", [-1, +1])
def test_dyad_keeps_both_lengths_and_its_side(side):
    a, b = pin(ANGLES).position, np.array([0.25, 0.05])
    joint = dyad_pin(ANGLES, side).position
    assert np.hypot(*(joint - a).T) == pytest.approx(0.2, abs=1e-15)
    assert np.hypot(*(joint - b).T) == pytest.approx(0.24, abs=1e-15)
    (base_x, base_y), (to_x, to_y) = (b - a).T, (joint - a).T
    assert np.all(np.sign(base_x * to_y - base_y * to_x) == side)


def test_rod_lies_between_its_ends():
    a, b = pin(ANGLES), guided_end(ANGLES)
    x, y, angle = rod(a, b).position.T
    along = np.stack([np.cos(angle), np.sin(angle)], 1)
    middle = np.stack([x, y], 1)
    assert middle - 0.1915 * along == pytest.approx(a.position, abs=1e-15)
    assert middle + 0.1915 * along == pytest.approx(b.position, abs=1e-15)


def test_angle_of_a_rod_that_goes_round_is_continuous():
    turns = np.linspace(0.0, 6 * np.pi, 200)
    centre = fixed(0.0, 0.0, len(turns))
    angle = rod(centre, rotating(turns, 1.0, 0.1)).position[:, 2]
    assert np.diff(angle) == pytest.approx(np.diff(turns), abs=1e-12)


def test_columns_of_a_motion():
    body = rod(pin(ANGLES), guided_end(ANGLES))
    centre = body[:2]
    assert isinstance(centre, Motion)
    assert np.array_equal(centre.acceleration, body.acceleration[:, :2])


def test_link_too_short_for_its_guide_says_where():
    with pytest.raises(AssemblyError, match=r"link = 0\.025: needs > 0\.03") as caught:
        guided("link", pin(np.radians([0.0, 10.0, 90.0])), 0.025, 0.0, -1)
    assert caught.value.index == 2


@pytest.mark.parametrize("lengths", [(0.1, 0.1), (0.5, 0.1)], ids=["too short", "too unequal"])
def test_dyad_that_does_not_meet_says_where(lengths):
    with pytest.raises(AssemblyError, match=r"links = .*must span") as caught:
        dyad("links", pin(ANGLES), lengths[0], fixed(0.25, 0.05, len(ANGLES)), lengths[1], 1)
    assert caught.value.index == 0


def test_links_in_line_are_refused_as_singular():
    with pytest.raises(AssemblyError):
        dyad("links", fixed(0.0, 0.0, 1), 0.1, fixed(0.2, 0.0, 1), 0.1, 1)
