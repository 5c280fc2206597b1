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


@pytest.mark.parametrize("temperature", [0.0, 60.0, 120.0])
def test_derivative_over_temperature(temperature):
    step = 1e-4
    ends = [walther(temperature + side * step, *POINTS)[0] for side in (1.0, -1.0)]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    assert walther(temperature, *POINTS)[1] == pytest.approx(slope, rel=1e-6)
    assert slope < 0.0


def test_pressure_thickens_as_barus_says_where_it_is_small():
    assert roelands(0.1, 2e-8, 0.0) == pytest.approx((0.1, 2e-9), rel=1e-12)
    assert roelands(0.1, 2e-8, 1e6)[0] == pytest.approx(0.1 * math.exp(0.02), rel=1e-4)
    assert roelands(0.1, 2e-8, 1e9)[0] < 0.1 * math.exp(20.0)
    step = 10.0
    ends = [roelands(0.1, 2e-8, 2e8 + side * step)[0] for side in (1.0, -1.0)]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    assert roelands(0.1, 2e-8, 2e8)[1] == pytest.approx(slope, rel=1e-6)


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
