"""The finite bearing and its side flow against Butenschoen 1976 and Reynolds' equation."""

import math
import random

import numpy as np
import pytest
from literature.data import columns_of

from exu_press.laws.film import finite, pi_film
from exu_press.laws.film.reynolds import solve_reynolds, supply_line
from exu_press.laws.film.side_flow import finite_flow, short_flow
from exu_press.scene.film import Finite

COLUMNS = ("1", "2", "2.5", "3", "4", "5", "6", "8")  # D/B
WIDTHS = [1.0 / float(column) for column in COLUMNS]
TABLE = columns_of("butenschoen_1976.csv")
LAWS = [finite(width) for width in WIDTHS]
ERROR = Finite.error
BUTENSCHOEN = pytest.mark.validation(
    "table",
    "finite bearing, B/D 1 to 1/8, eccentricity ratios to 0.99",
    "H. J. Butenschön, dissertation, Karlsruhe 1976",
    "numbers as in octave-user/mboct-mbdyn-pkg, GPL-3",
)


def rows(quantity):
    """Return eccentricity ratios (n,) and values (n, widths)."""
    chosen = TABLE["quantity"] == quantity
    return TABLE["eps"][chosen], np.column_stack([TABLE[name][chosen] for name in COLUMNS])


@BUTENSCHOEN
def test_butenschoen_1976_rotation(compare):
    ratios, published = rows("rotation")
    force = np.array([[law(eps, 0.0, eps)[:2] for law in LAWS] for eps in ratios])
    load = np.hypot(force[..., 0], force[..., 1]) / 2.0
    assert np.abs(load / published - 1.0).mean() < 2e-3  # the last digit of .0025 alone is 2 %
    compare("Sommerfeld number, rotation", published, load, error=ERROR * load, rel=1e-2)
    angle = np.degrees(np.arctan2(force[..., 1], -force[..., 0]))
    error = math.degrees(ERROR)
    compare("attitude angle", rows("attitude")[1], angle, error=error, abs=0.2, unit="deg")


@BUTENSCHOEN
def test_butenschoen_1976_squeeze(compare):
    ratios, published = rows("squeeze")
    forces = [[law(abs(e), math.copysign(1.0, e), 0.0) for law in LAWS] for e in ratios]
    force = np.array(forces)[..., :2]
    load = np.abs(force[..., 0]) / 2.0
    assert np.nanmean(np.abs(load / published - 1.0)) < 2e-3
    compare("Sommerfeld number, squeeze", published, load, error=ERROR * load, rel=1e-2)
    assert np.all(np.abs(force[..., 1]) < 1e-12 * np.abs(force[..., 0]))


def test_reynolds_equation_between_the_knots():
    rng = random.Random(5)
    errors = []
    for _ in range(20):
        ratio, eps = 0.1 * 40.0 ** rng.random(), rng.choice([rng.uniform(0.1, 0.9), 0.985])
        turn = rng.uniform(-0.5, 0.5) * math.pi
        eps_dot, eps_w = math.sin(turn), 2.0 * math.cos(turn)
        exact = solve_reynolds(eps, eps_dot, eps_w, ratio, supply_line(eps_dot, eps_w))
        f_r, f_t, *_ = finite(ratio)(eps, eps_dot, eps_w)
        size = math.hypot(exact.f_r, exact.f_t)
        errors.append(math.hypot(f_r - exact.f_r, f_t - exact.f_t) / size)
    print(f"spline: mean {np.mean(errors):.3%}, worst {max(errors):.3%}")
    assert np.mean(errors) < 1e-3
    assert max(errors) < 1.5e-2


@pytest.mark.parametrize("eps", [-1e-9, 1.0, 1.5, math.nan])
def test_outside_of_its_clearance_it_is_not_a_number(eps):
    assert all(map(math.isnan, LAWS[0](eps, 0.1, 0.3)[:8]))
    assert math.isnan(LAWS[0](0.5, math.inf, 0.3)[0])
    assert math.isnan(LAWS[0](0.5, 0.1, math.nan)[0])


def test_supply_line_follows_the_opening_film_without_a_jump():
    assert supply_line(0.0, 1.0) == math.pi
    assert supply_line(-1e-6, 1.0) == pytest.approx(math.pi)
    assert supply_line(-1.0, 0.0) == 0.0


@pytest.mark.parametrize("eps", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("speeds", [(0.0, 1.0), (1.0, 0.0)])
def test_long_bearing_tendency(eps, speeds):
    # Swift and Stieber's film outlasts Gumbel's half, so the limit is near, not equal.
    long = math.hypot(*pi_film()(eps, *speeds)[:2])
    share = [math.hypot(*finite(ratio)(eps, *speeds)[:2]) / long for ratio in (0.5, 1, 2, 4)]
    assert share == sorted(share)
    assert share[-1] == pytest.approx(1.0, abs=0.2)


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
