"""Side flow against limits and Reynolds' equation; tests/literature has published tables."""

import math

import numpy as np
import pytest

from exu_press.laws.film.reynolds import solve_reynolds, supply_line
from exu_press.laws.film.side_flow import finite_flow, short_flow


def at(flow, eps, eps_dot, eps_w):
    return float(flow(*(np.array([value]) for value in (eps, eps_dot, eps_w)))[0])


def test_all_that_a_short_bearing_displaces_leaves_it():
    flow, theta = short_flow(0.25), np.linspace(0.0, 2.0 * math.pi, 100_001)
    for eps, eps_dot, eps_w in ((0.3, 0.0, 0.3), (0.5, 0.7, -0.4), (0.8, -0.2, 0.1)):
        displaced = np.maximum(0.0, eps_dot * np.cos(theta) - 0.5 * eps_w * np.sin(theta))
        assert at(flow, eps, eps_dot, eps_w) == pytest.approx(np.trapezoid(displaced, theta))


@pytest.mark.parametrize("ratio", [0.37, 1.1, 3.0])
def test_between_the_knots_it_is_that_of_reynolds_equation(ratio):
    flow = finite_flow(ratio)
    for eps, eps_dot, eps_w in ((0.33, 0.1, 0.4), (0.62, 0.5, -0.3), (0.87, -0.05, 0.5)):
        supply = supply_line(eps_dot, eps_w)
        exact = solve_reynolds(eps, eps_dot, eps_w, ratio, supply).side_flow
        assert at(flow, eps, eps_dot, eps_w) == pytest.approx(exact, rel=0.015)
