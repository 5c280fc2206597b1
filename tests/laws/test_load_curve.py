"""Forces given by points: between them, beyond them, around a period; where the corners are."""

import math

import numpy as np
import pytest

from exu_press.laws.load_curve import LoadCurve, blanking_pulse

RAMP = LoadCurve([1.0, 2.0, 4.0], [0.0, 10.0, -10.0])
TURN = LoadCurve([1.0, 2.0, 4.0], [0.0, 10.0, -10.0], period=6.0)


def test_between_and_beyond_its_points():
    places = np.linspace(-1.0, 6.0, 141)
    expected = np.interp(places, RAMP.places, RAMP.forces)
    assert [RAMP(place) for place in places] == pytest.approx(expected, abs=1e-12)


def test_a_period_joins_the_last_point_to_the_first():
    places = np.linspace(-14.0, 20.0, 341)
    expected = np.interp(places, TURN.places, TURN.forces, period=6.0)
    assert [TURN(place) for place in places] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("start", [-8.3, 0.2, 1.0, 3.0, 13.9])
def test_corners_forwards_and_backwards(start):
    """One after the other, none twice, none left out."""
    corners, place = [], start
    for _ in range(6):
        place = TURN.corner_after(place, 1e-9)
        corners.append(place)
    expected = sorted(
        p + 6.0 * turn for p in TURN.places for turn in range(-3, 6) if p + 6.0 * turn > start
    )
    assert corners == pytest.approx(expected[:6], abs=1e-9)
    for expected_before in corners[-2::-1]:
        place = TURN.corner_before(place, 1e-9)
        assert place == pytest.approx(expected_before, abs=1e-9)


def test_behind_the_last_point_there_is_no_corner():
    assert RAMP.corner_after(4.0) == math.inf
    assert RAMP.corner_before(1.0) == -math.inf
    assert (RAMP.corner_after(1.5), RAMP.corner_before(1.5)) == (2.0, 1.0)


def test_peak_and_steepest():
    assert (RAMP.peak, RAMP.steepest) == (10.0, 10.0)
    closing = LoadCurve([0.0, 5.0], [0.0, 10.0], period=5.5)
    assert closing.steepest == 20.0  # from the last point to the next first


def test_the_blanking_pulse_is_the_papers_triangle():
    pulse = LoadCurve(*blanking_pulse(1e4, rise=1e-3, fall=5e-4))
    assert [pulse(t) for t in (0.0, 5e-4, 1e-3, 1.25e-3, 2e-3)] == pytest.approx(
        [0.0, 5e3, 1e4, 5e3, 0.0]
    )
