"""What is wrong with a drawing is found where it is wrong."""

import math
from dataclasses import replace

import numpy as np
import pytest
from drawings import four_bar, slider_crank

from exu_press.mechanism.examine import examine


def test_a_drawing_that_moves_has_no_complaints():
    found = examine(four_bar())
    assert found.complaints == () == found.wrong_bodies == found.wrong_joints
    assert found.stroke is not None


def test_links_that_are_too_short_are_named_with_the_position_of_their_lock():
    """A rod of 0.15 with a crank of 0.2 and no offset locks where r sin theta = l."""
    whole = slider_crank(crank=0.2, rod=0.15, at=0.0)
    found = examine(whole)
    assert found.stroke is None
    assert set(found.wrong_bodies) == {"rod", "slider"}
    assert found.wrong_joints == ("rod_small_end",)
    lock = math.asin(0.15 / 0.2)
    assert found.refusal.angle == pytest.approx(lock, abs=1e-5)
    at = found.refusal.angle
    pin = 0.2 * np.array([math.cos(at), math.sin(at)])
    slider = found.refusal.poses["slider"]
    assert math.dist(pin, slider[:2]) == pytest.approx(0.15, abs=1e-12)


def test_a_body_that_nothing_holds_is_named():
    found = examine(replace(slider_crank(), guides=()))
    assert set(found.wrong_bodies) == {"rod", "slider"}
    assert any(text.startswith("2 degrees of freedom too many") for text in found.complaints)
