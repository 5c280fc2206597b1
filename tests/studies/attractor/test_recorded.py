"""What is recorded of a revolution changes nothing of the next one, and a lasting contact stays."""

import numpy as np
import pytest

from exu_press import Scene
from exu_press.studies.attractor.orbit import Orbit

PRESSED = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 5e-6, "radius": 0.07}},
    contact={"length": 0.1},
)


@pytest.fixture(scope="module")
def points():
    found = {}
    for recorded, revolutions in ((False, 3), (True, 2)):
        orbit = Orbit(PRESSED)
        found[recorded] = []
        for _ in range(revolutions):
            orbit.advance(recorded=recorded)
            found[recorded].append(orbit.point())
        orbit.close()
    return found


def test_it_goes_on_bit_for_bit_from_what_is_recorded(points):
    assert np.array_equal(points[True], points[False][:2])


def test_a_contact_that_lasts_does_not_creep(points):
    """By a ten-thousandth of the clearance a revolution, where what steps miss is kept for good."""
    first, last = points[False][1:]
    assert np.abs(last - first).max() < 1e-5
