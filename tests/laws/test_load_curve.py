"""Forces given by points: between them, beyond them, around a period; where the corners are."""

import math

import numpy as np
import pytest

from exu_press.laws.load_curve import LoadCurve, PulseClock, blanking_pulse

RAMP = LoadCurve([1.0, 2.0, 4.0], [0.0, 10.0, -10.0])
TURN = LoadCurve([1.0, 2.0, 4.0], [0.0, 10.0, -10.0], period=6.0)


@pytest.mark.parametrize(("curve", "period"), [(RAMP, None), (TURN, 6.0)])
def test_between_and_beyond_its_points(curve, period):
    """A period joins the last point to the first."""
    places = np.linspace(-14.0, 20.0, 341)
    expected = np.interp(places, curve.places, curve.forces, period=period)
    assert [curve(place) for place in places] == pytest.approx(expected, abs=1e-12)


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


def test_a_clock_begins_at_the_angle_and_goes_on_in_time():
    clock = PulseClock(0.2, 3.0, at_end=False, now=0.0, speed=5.0)
    assert clock.since_begin(0.0, 2.9, 5.0) == pytest.approx(-0.02)
    clock.accept(0.1, 3.5, 5.0)  # it began within the step, 0.1 s ago
    assert clock.since_begin(0.15, 3.5, 0.0) == pytest.approx(0.15), (
        "the crank stands, the pulse goes on"
    )
    clock.accept(0.25, 3.6, 5.0)
    assert clock.since_begin(0.25, 3.6, 5.0) == pytest.approx((3.6 - 3.0 - 2.0 * math.pi) / 5.0)
    assert clock.since_begin(0.25, 3.6, 0.0) == -math.inf


def test_a_clock_foresees_the_end_and_starts_within_a_pulse():
    clock = PulseClock(0.2, 3.0, at_end=True, now=0.0, speed=5.0)
    assert clock.since_begin(0.0, 2.0, 5.0) == pytest.approx(0.0)
    assert clock.since_begin(0.0, 2.0, 2.5) == pytest.approx(-0.2)
    for at_end, angle in ((False, 3.0), (True, 4.0)):
        clock = PulseClock(0.2, angle, at_end=at_end, now=3.5, speed=5.0)
        assert clock.since_begin(0.0, 3.5, 5.0) == pytest.approx(0.1)
