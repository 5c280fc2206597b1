"""Stroke, dead centres, mechanical advantage and transmission angles against closed forms."""

import math

import numpy as np
import pytest
from drawings import four_bar, slider_crank, stephenson

from exu_press.mechanism import Press, SliderCrank, press, shipped_mechanism
from exu_press.mechanism import slider_crank as shipped_slider_crank
from exu_press.mechanism.stroke import stroke_of
from exu_press.mechanism.transmission import (
    group_equal_angles,
    least_transmission_angle,
    transmission_angles,
)

ANGLES = np.radians(np.arange(0.0, 361.0))
R, L = 0.1, 0.4


def test_a_slider_crank_in_line_has_a_stroke_of_two_radii():
    size = SliderCrank(crank_radius=0.05, rod_length=0.2)
    found = stroke_of(shipped_slider_crank(size), ANGLES)
    assert found.length == pytest.approx(0.1, abs=1e-15)
    top, bottom = found.dead_centres
    assert (top.top, bottom.top) == (True, False)
    assert top.angle == pytest.approx(0.0, abs=1e-12)
    assert bottom.angle == pytest.approx(math.pi, abs=1e-12)


def test_an_offset_slider_crank_turns_back_where_rod_and_crank_are_in_line():
    """Stroke sqrt((l + r)^2 - e^2) - sqrt((l - r)^2 - e^2)."""
    offset, at = 0.05, 0.7
    found = stroke_of(slider_crank(offset=offset, crank=R, rod=L, at=at), ANGLES)
    far, near = (math.sqrt((L + sign * R) ** 2 - offset**2) for sign in (1, -1))
    assert found.length == pytest.approx(far - near, abs=1e-14)
    outer = math.asin(offset / (L + R))
    inner = math.asin(offset / (L - R)) + math.pi
    expected = sorted((angle - at) % (2 * math.pi) for angle in (outer, inner))
    assert [centre.angle for centre in found.dead_centres] == pytest.approx(expected, abs=1e-11)


def test_mechanical_advantage_is_the_crank_s_speed_over_the_slider_s():
    found = stroke_of(slider_crank(crank=R, rod=L, at=0.0), ANGLES)
    swing = R * np.sin(ANGLES)
    velocity = -swing - swing * R * np.cos(ANGLES) / np.sqrt(L**2 - swing**2)
    assert found.velocity == pytest.approx(velocity, abs=1e-13)
    moving = np.abs(velocity) > 1e-6
    product = found.mechanical_advantage[moving] * np.abs(velocity[moving])
    assert product == pytest.approx(1.0, abs=1e-8)
    assert np.all(np.isinf(found.mechanical_advantage[~moving]))


def test_the_largest_velocity_lies_between_whole_degrees():
    """A trammel's tracer (0.03, 0.01): x = 0.03 cos - 0.01 sin of the crank's angle."""
    found = stroke_of(shipped_mechanism("elliptic_trammel"), ANGLES)
    assert found.peak_velocity == pytest.approx(math.hypot(0.03, 0.01), rel=1e-10)
    assert math.tan(found.peak_angle) == pytest.approx(-3.0, rel=1e-4)


def test_dead_centres_are_those_of_the_mechanism():
    mechanism = press(Press())
    top, bottom = stroke_of(mechanism, ANGLES).dead_centres
    assert (top.angle, bottom.angle) == pytest.approx(mechanism.dead_centres, abs=1e-4)


@pytest.mark.parametrize("offset", [0.0, 0.05])
def test_transmission_angle_of_a_slider_crank(offset):
    """cos mu = (r sin theta - e) / l."""
    at = 0.7
    found = transmission_angles(slider_crank(offset=offset, crank=0.1, rod=0.4, at=at), ANGLES)
    (values,) = found.values()
    expected = np.arccos(np.abs(0.1 * np.sin(ANGLES + at) - offset) / 0.4)
    assert values == pytest.approx(expected, abs=1e-12)


def test_transmission_angle_of_a_four_bar():
    """The law of cosines over the distance of crank pin and pivot."""
    at, (crank, coupler, rocker, base) = 0.7, (0.1, 0.4, 0.3, 0.35)
    found = transmission_angles(four_bar(crank, coupler, rocker, base, at), ANGLES)
    assert list(found) == ["knuckle"]
    across = crank**2 + base**2 - 2 * crank * base * np.cos(ANGLES + at)
    cosine = (coupler**2 + rocker**2 - across) / (2 * coupler * rocker)
    assert found["knuckle"] == pytest.approx(np.arccos(np.abs(cosine)), abs=1e-11)


def test_larger_groups_have_no_transmission_angle():
    assert transmission_angles(stephenson(), ANGLES) == {}


def test_dyads_of_a_press_have_transmission_angles():
    """The right half holds the slider, which holds the left plunger: its link has none."""
    found = set(transmission_angles(press(Press()), ANGLES))
    right = {"knuckle_6_right", "plunger_pin_right"}
    assert found == {"slide_pin", "counterweight_pin", "knuckle_6_left"} | right


def test_equal_transmission_angles_are_named_together_smallest_first():
    values = np.array([1.0, 0.5])
    found = group_equal_angles({"a": values + 0.1, "left": values, "right": values.copy()})
    assert [name for name, _ in found] == ["left, right", "a"]


def test_the_least_transmission_angle_is_between_whole_degrees():
    """Of a four-bar, where its crank lies on the frame: 0.3 deg from a whole one here."""
    at, (crank, coupler, rocker, base) = np.radians(90.3), (0.1, 0.4, 0.3, 0.35)
    mechanism = four_bar(crank, coupler, rocker, base, at)
    values = transmission_angles(mechanism, ANGLES)["knuckle"]
    least, angle = least_transmission_angle(mechanism, "knuckle", ANGLES[values.argmin()])
    cosine = (coupler**2 + rocker**2 - (base - crank) ** 2) / (2 * coupler * rocker)
    assert least == pytest.approx(np.arccos(cosine), abs=1e-10) and least < values.min()
    assert angle == pytest.approx(2.0 * np.pi - at, abs=1e-5)
