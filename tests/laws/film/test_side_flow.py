"""Side flow against limits and Reynolds' equation; tests/literature has published tables."""

import math

import numpy as np
import pytest

from exu_press.laws.film.reynolds import solve_reynolds, supply_line
from exu_press.laws.film.side_flow import finite_flow, no_flow, short_flow


def at(flow, eps, eps_dot, eps_w):
    return float(flow(*(np.array([value]) for value in (eps, eps_dot, eps_w)))[0])


def test_all_that_a_short_bearing_displaces_leaves_it():
    flow, theta = short_flow(0.25), np.linspace(0.0, 2.0 * math.pi, 100_001)
    for eps, eps_dot, eps_w in ((0.3, 0.0, 0.3), (0.5, 0.7, -0.4), (0.8, -0.2, 0.1)):
        displaced = np.maximum(0.0, eps_dot * np.cos(theta) - 0.5 * eps_w * np.sin(theta))
        assert at(flow, eps, eps_dot, eps_w) == pytest.approx(np.trapezoid(displaced, theta))


def test_a_narrow_bearing_is_a_short_one_and_a_wide_one_tends_to_none():
    for eps in (0.05, 0.5, 0.95):
        for eps_dot in (-1.0, 0.0, 1.0):
            motion = eps, eps_dot, eps
            narrow = at(finite_flow(0.1), *motion) / at(short_flow(0.1), *motion)
            assert 0.985 < narrow <= 1.0
            wide = [at(finite_flow(ratio), *motion) for ratio in (0.5, 1.0, 2.0, 4.0)]
            assert sorted(wide, reverse=True) == wide
            assert at(no_flow(4.0), *motion) == 0.0


@pytest.mark.parametrize("ratio", [0.37, 1.1, 3.0])
def test_between_the_knots_it_is_that_of_reynolds_equation(ratio):
    flow = finite_flow(ratio)
    for eps, eps_dot, eps_w in ((0.33, 0.1, 0.4), (0.62, 0.5, -0.3), (0.87, -0.05, 0.5)):
        supply = supply_line(eps_dot, eps_w)
        exact = solve_reynolds(eps, eps_dot, eps_w, ratio, supply).side_flow
        assert at(flow, eps, eps_dot, eps_w) == pytest.approx(exact, rel=0.015)


def test_what_flows_out_is_what_the_pressure_displaces_less_what_it_turns_back():
    """The balance of the numerical solution itself: less than all, nearly all where narrow."""
    shares = [
        solve_reynolds(0.6, 0.3, 0.6, r).side_flow / (2.0 * math.hypot(0.3, 0.3))
        for r in (4.0, 1.0, 0.25)
    ]
    assert 0.2 < shares[0] < shares[1] < shares[2] < 1.0
    assert shares[2] > 0.97


def test_it_is_of_first_degree_and_has_no_side():
    flow = finite_flow(0.8)
    one = at(flow, 0.7, 0.2, 0.5)
    assert at(flow, 0.7, 0.6, 1.5) == pytest.approx(3.0 * one, rel=1e-12)
    assert at(flow, 0.7, 0.2, -0.5) == one
    assert at(flow, 0.7, 0.0, 0.0) == 0.0
