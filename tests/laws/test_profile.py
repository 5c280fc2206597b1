"""A worn surface's profile: periodic, smooth, and round where it is worn evenly."""

import math

import numpy as np
import pytest

from exu_press.laws.profile import profile

ANGLES = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)


def test_a_smooth_shape_is_met_with_both_derivatives():
    shape = profile(ANGLES, 1e-5 * (1.0 + np.cos(ANGLES - 0.3)))
    for angle in np.linspace(-7.0, 7.0, 50):
        depth, slope, bend = shape.derivatives(float(angle))
        assert depth == pytest.approx(1e-5 * (1.0 + math.cos(angle - 0.3)), abs=1e-10)
        assert slope == pytest.approx(-1e-5 * math.sin(angle - 0.3), abs=1e-9)
        assert bend == pytest.approx(-1e-5 * math.cos(angle - 0.3), abs=1e-8)
    assert shape.mean == pytest.approx(1e-5, rel=1e-9)
    assert shape.sharpest == pytest.approx(1e-5, rel=2e-3)  # a shifted circle stays a circle


def test_derivatives_are_those_of_the_depth():
    shape = profile([0.1, 1.0, 2.5, 4.0], [1e-5, 3e-5, 0.0, 2e-5])
    for angle in (0.0, 0.1, 0.7, 3.3, 6.2, 6.4):
        high, low = shape.derivatives(angle + 1e-6), shape.derivatives(angle - 1e-6)
        _, slope, bend = shape.derivatives(angle)
        assert slope == pytest.approx((high[0] - low[0]) / 2e-6, rel=1e-6, abs=1e-12)
        assert bend == pytest.approx((high[1] - low[1]) / 2e-6, rel=1e-4, abs=1e-9)
    assert shape.derivatives(0.1 + 2.0 * math.pi) == pytest.approx(shape.derivatives(0.1))


def test_no_number_stays_none():
    assert all(map(math.isnan, profile([0.0, 1.0, 2.0], [0.0, 1e-5, 0.0]).derivatives(math.nan)))
