"""What is recorded of a revolution changes nothing of the next one, and a lasting contact stays."""

import numpy as np
import pytest
from slider_cranks import section_points

from exu_press import Scene

PRESSED = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 5e-6, "radius": 0.07}},
    contact={"length": 0.1},
)


def test_it_goes_on_bit_for_bit_from_what_is_recorded():
    coarse = PRESSED.replace({"solver.tolerance": 5e-2})
    assert np.array_equal(
        section_points(coarse, 2, recorded=True), section_points(coarse, 2, recorded=False)
    )


@pytest.mark.long
def test_a_contact_that_lasts_does_not_creep():
    """By a ten-thousandth of the clearance a revolution, where what steps miss is kept for good."""
    _, first, last = section_points(PRESSED, 3, recorded=False)
    assert np.abs(last - first).max() < 1e-5
