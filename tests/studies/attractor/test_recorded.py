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


def points(scene, revolutions, recorded):
    orbit, found = Orbit(scene), []
    for _ in range(revolutions):
        orbit.advance(recorded=recorded)
        found.append(orbit.point())
    orbit.close()
    return found


def test_it_goes_on_bit_for_bit_from_what_is_recorded():
    coarse = PRESSED.replace({"solver.tolerance": 5e-2})
    assert np.array_equal(points(coarse, 2, recorded=True), points(coarse, 2, recorded=False))


@pytest.mark.long
def test_a_contact_that_lasts_does_not_creep():
    """By a ten-thousandth of the clearance a revolution, where what steps miss is kept for good."""
    _, first, last = points(PRESSED, 3, recorded=False)
    assert np.abs(last - first).max() < 1e-5
