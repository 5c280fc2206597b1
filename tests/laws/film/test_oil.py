"""Viscosity laws against their points, their limits and their derivatives."""

import math

import pytest

from exu_press.laws.film.oil import film_temperature, roelands, walther

POINTS = (40.0, 30.0), (100.0, 5.23)
VG100 = (40.0, 100.0), (100.0, 11.1)
"""A mineral oil of ISO VG 100 with a viscosity index of 95 (ISO 2909)."""


@pytest.mark.parametrize("points", [POINTS, VG100])
def test_the_points_are_met_whichever_is_first(points):
    for temperature, viscosity in points:
        assert walther(temperature, *points)[0] == pytest.approx(viscosity, rel=1e-12)
        assert walther(temperature, *points[::-1])[0] == pytest.approx(viscosity, rel=1e-12)


def test_between_the_points_it_is_between_exponentials():
    """Convex in log(nu): below the straight line through the logarithms."""
    straight = 30.0 * (5.23 / 30.0) ** (20.0 / 60.0)
    assert 14.0 < walther(60.0, *POINTS)[0] < straight


@pytest.mark.parametrize("temperature", [0.0, 60.0, 120.0])
def test_derivative_over_temperature(temperature):
    step = 1e-4
    ends = [walther(temperature + side * step, *POINTS)[0] for side in (1.0, -1.0)]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    assert walther(temperature, *POINTS)[1] == pytest.approx(slope, rel=1e-6)
    assert slope < 0.0


def test_pressure_thickens():
    assert roelands(0.1, 2e-8, 0.0) == pytest.approx((0.1, 2e-9), rel=1e-12)
    step = 10.0
    ends = [roelands(0.1, 2e-8, 2e8 + side * step)[0] for side in (1.0, -1.0)]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    assert roelands(0.1, 2e-8, 2e8)[1] == pytest.approx(slope, rel=1e-6)


def test_roelands_is_barus_law_at_small_pressure_and_less_above():
    assert roelands(0.1, 2e-8, 1e6)[0] == pytest.approx(0.1 * math.exp(0.02), rel=1e-4)
    assert roelands(0.1, 2e-8, 1e9)[0] < 0.1 * math.exp(20.0)


def test_temperature_of_a_film_whose_viscosity_does_not_change():
    """100 W over 4 W/K of oil and 6 W/K of a frame that is 10 K warmer."""
    found = film_temperature(100.0, 4.0, 6.0, 40.0, 50.0, lambda _: 1.0)
    assert 4.0 * (found - 40.0) + 6.0 * (found - 50.0) == pytest.approx(100.0, rel=1e-9)


def test_temperature_of_a_film_closes_its_balance():
    def thinning(temperature):
        return walther(temperature, *POINTS)[0] / 30.0

    found = film_temperature(500.0, 3.0, 2.0, 40.0, 30.0, thinning)
    off = 3.0 * (found - 40.0) + 2.0 * (found - 30.0)
    assert 500.0 * thinning(found) == pytest.approx(off, rel=1e-9)
    assert film_temperature(600.0, 3.0, 2.0, 40.0, 30.0, thinning) > found


def test_film_that_dissipates_nothing_or_keeps_its_heat():
    assert film_temperature(0.0, 1.0, 0.0, 40.0, 20.0, lambda _: 1.0) == 40.0
    assert film_temperature(0.0, 0.0, 1.0, 40.0, 20.0, lambda _: 1.0) == pytest.approx(20.0)
    assert film_temperature(0.0, 0.0, 0.0, 40.0, 20.0, lambda _: 1.0) == 40.0
    assert film_temperature(1.0, 0.0, 0.0, 40.0, 40.0, lambda _: 1.0) == math.inf
