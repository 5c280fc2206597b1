"""Transmission angles against closed forms."""

import numpy as np
import pytest
from drawings import four_bar, slider_crank, stephenson

from exu_press.mechanism import Press, press
from exu_press.mechanism.transmission import group_equal_angles, transmission_angles

ANGLES = np.radians(np.arange(0.0, 360.0, 5.0))


@pytest.mark.parametrize("offset", [0.0, 0.05])
def test_of_a_slider_crank(offset):
    """cos mu = (r sin theta - e) / l."""
    at = 0.7
    found = transmission_angles(slider_crank(offset=offset, crank=0.1, rod=0.4, at=at), ANGLES)
    (values,) = found.values()
    expected = np.arccos(np.abs(0.1 * np.sin(ANGLES + at) - offset) / 0.4)
    assert values == pytest.approx(expected, abs=1e-12)


def test_of_a_four_bar():
    """The law of cosines over the distance of crank pin and pivot."""
    at, (crank, coupler, rocker, base) = 0.7, (0.1, 0.4, 0.3, 0.35)
    found = transmission_angles(four_bar(crank, coupler, rocker, base, at), ANGLES)
    assert list(found) == ["knuckle"]
    across = crank**2 + base**2 - 2 * crank * base * np.cos(ANGLES + at)
    cosine = (coupler**2 + rocker**2 - across) / (2 * coupler * rocker)
    assert found["knuckle"] == pytest.approx(np.arccos(np.abs(cosine)), abs=1e-11)


def test_links_that_close_in_larger_groups_only_have_none():
    assert transmission_angles(stephenson(), ANGLES) == {}


def test_of_the_dyads_of_a_press():
    """The right half holds the slider, which holds the left plunger: its link has none."""
    found = set(transmission_angles(press(Press()), ANGLES))
    right = {"knuckle_6_right", "plunger_pin_right"}
    assert found == {"slide_pin", "counterweight_pin", "knuckle_6_left"} | right


def test_the_same_angles_are_named_together_smallest_first():
    values = np.array([1.0, 0.5])
    found = group_equal_angles({"a": values + 0.1, "left": values, "right": values.copy()})
    assert [name for name, _ in found] == ["left, right", "a"]
