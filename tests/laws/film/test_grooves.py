"""Bearings with grooves: Reynolds' equation against tables, and the law that is interpolated."""

import math
import random
import runpy
from pathlib import Path

import numpy as np
import pytest
from slopes import slopes

from exu_press.laws.film import dissipated_power
from exu_press.laws.film.grooved_table import (
    DIRECTIONS,
    LAST,
    LEVELS,
    GroovedFilm,
    interval_of,
    knots_of,
    speeds_of,
    tabulated_row,
    weights,
)
from exu_press.laws.film.grooved_table import slopes as spline_slopes
from exu_press.laws.film.grooves import Groove, GroovedBearing, GroovedFilmState
from exu_press.laws.film.reynolds import solve_reynolds
from exu_press.model.film_tables import film_table

SCRIPT = Path(__file__).parents[3] / "scripts" / "compare_grooved_film.py"

WIDTH = math.radians(10.0)


def two_axial(ratio, length=1.0):
    grooves = tuple(Groove(angle, WIDTH, length) for angle in (0.5 * math.pi, -0.5 * math.pi))
    return GroovedBearing(ratio, grooves)


RING = GroovedBearing(0.5, (Groove(0.0, 2.0 * math.pi, 0.1),))


@pytest.fixture(scope="module")
def published_rows():
    rows = list(runpy.run_path(str(SCRIPT))["rows"]())
    assert len(rows) == 27
    return rows


def published(source, table, remark, bounds):
    """Return a table's name with what it allows, and its mark."""
    subject = "bearing with two axial grooves, L/D 1/2 and 1, eccentricity ratios 0.19 to 0.81"
    origin = f"{table}, as transcribed in VictorLier/Tribology"
    mark = pytest.mark.validation("table", subject, origin, "printed numbers", remark)
    return pytest.param(source, bounds, marks=mark, id=source)


@pytest.mark.long
@pytest.mark.parametrize(
    ("source", "bounds"),
    [
        published(
            "Someya",
            "T. Someya (ed.), Journal-Bearing Databook (1989), pp. 14 and 17",
            "Computed as the table's own numbers show that it was (docs/theory/film.md).",
            (0.01, 0.7, 0.05, 0.04),
        ),
        published(
            "Lund",
            "J. W. Lund, K. K. Thomsen, A Calculation Method and Data for the Dynamic Coefficients "
            "of Oil-Lubricated Journal Bearings, ASME 1978",
            "Grooves of 20 deg are assumed.",
            (0.01, 0.2, 0.015, 0.015),
        ),
    ],
)
def test_someya_and_lund(published_rows, source, bounds, compare):
    """Each coefficient over the largest of its matrix."""
    for table, _, _, (s, attitude, k, b), ours in published_rows:
        if table != source:
            continue
        of_s, of_attitude, of_k, of_b = bounds
        compare("Sommerfeld number", s, ours[0], error=None, rel=of_s)
        compare("attitude angle", attitude, ours[1], error=None, abs=of_attitude, unit="deg")
        for name, theirs, our, rel in (
            ("stiffness, over the largest", k, ours[2], of_k),
            ("damping, over the largest", b, ours[3], of_b),
        ):
            compare(name, theirs, our, error=None, rel=rel, scale=np.abs(theirs).max())


def test_someyas_friction_says_how_wide_the_grooves_are():
    """As long as the lands are full: their drag, and the couple of half the load.

    T has three digits, which are 0.3 deg.
    """
    for table, row in runpy.run_path(str(SCRIPT))["table_rows"]():
        if table == "Someya" and row["E"] < 0.65:
            couple = 0.5 * row["E"] * math.sin(math.radians(row["Phi"]))
            sheared = (row["T"] - couple) * math.sqrt(1.0 - row["E"] ** 2) / (math.pi * row["S"])
            assert math.degrees(0.5 * (2.0 * math.pi - sheared)) == pytest.approx(10.0, abs=0.55)


def test_a_narrow_groove_at_the_widest_gap_is_the_supply_line():
    """Raimondi and Boyd's bearing, as `reynolds` has it, at the limit of a groove's width."""
    narrow = GroovedBearing(1.0, (Groove(math.pi, 1e-3, 1.0),))
    expected = solve_reynolds(0.6, 0.0, 0.6, 1.0, math.pi, (144, 10))
    f_r, f_t, flow, *_ = GroovedFilmState(narrow, 0.6, 0.0, (144, 10)).solve(0.0, 0.3)
    assert (f_r, f_t) == pytest.approx(expected[:2], rel=2e-3)
    assert flow == pytest.approx(expected.side_flow, rel=2e-3)


def test_a_cell_whose_sources_cancel_is_settled():
    """Where closing and rotation displace the same but for rounding, at the film's boundary."""
    bearing, guess = two_axial(0.5), None
    knots = knots_of(bearing)
    angle = knots.angle[np.argmin(np.abs(knots.angle - math.radians(145.0)))]
    state = GroovedFilmState(bearing, 0.0, angle, (72, 5))
    for u, v in speeds_of(knots.direction, 1.0):
        guess = state.solve(v, u, guess=guess).pressures


def test_shear_of_the_lands():
    """Against the sum of 1 / h over what is no groove, and its difference by eps."""
    bearing = two_axial(0.5, 0.7)
    theta = (np.arange(200_000) + 0.5) * (2.0 * math.pi / 200_000)
    in_groove = np.zeros(len(theta), dtype=bool)
    for groove in bearing.grooves:
        in_groove |= (
            np.abs(np.mod(theta - groove.angle + math.pi, 2 * math.pi) - math.pi) < WIDTH / 2
        )
    share = np.where(in_groove, 0.3, 1.0)
    for eps, angle in ((0.0, 1.0), (0.6, 1.5), (0.9, -2.0)):
        h = 1.0 - eps * np.cos(theta - angle)
        expected = (share / h).mean() * 2.0 * math.pi
        shear, slope = bearing.shear_integral(eps, angle)
        assert shear == pytest.approx(expected, rel=1e-4)
        higher = bearing.shear_integral(eps + 1e-6, angle)[0]
        assert slope == pytest.approx((higher - shear) / 1e-6, abs=1e-4 * shear)


def states(seed, count, largest=0.95):
    rng = random.Random(seed)
    for _ in range(count):
        a = rng.uniform(-math.pi, math.pi)
        speed = 10.0 ** rng.uniform(-3.0, 3.0)
        yield (
            rng.uniform(0.0, largest),
            speed * math.sin(a),
            2.0 * speed * math.cos(a),
            rng.uniform(-9, 9),
        )


def assert_derivatives(law, eps, eps_dot, eps_w):
    given = np.reshape(law(eps, eps_dot, eps_w)[2:8], (2, 3))
    width = 1e-6 * math.hypot(eps_dot, eps_w)
    found = slopes(law, (eps, eps_dot, eps_w), (1e-7, width, width))[:, :2].T
    size = np.abs(given)
    size[:, 1:] = size.max(axis=1, keepdims=True)
    assert (np.abs(found - given) < 1e-4 * size).all()


def test_whatever_its_table_holds_the_law_dissipates():
    """Any numbers as ln E and m, also of an interpolation that overshoots."""
    law = GroovedFilm(two_axial(0.5))
    rng = np.random.default_rng(3)
    law.set_table(rng.normal(size=(LEVELS, 9, DIRECTIONS, 3)))
    for eps, eps_dot, eps_w, angle in states(1, 300, 0.999):
        law.angle = angle
        assert dissipated_power(law(eps, eps_dot, eps_w), eps_dot, eps_w) > 0.0


@pytest.mark.parametrize("t", [0.0, 0.3, 1.0])
def test_splines_reproduce_a_cubic(t):
    """The coefficients of x^3 are the products (k - 1) k (k + 1) of knots (Marsden 1970)."""
    coefficients = np.array([0.0, 0.0, 0.0, 6.0])
    assert weights(t) @ coefficients == pytest.approx(t**3, abs=1e-15)
    assert spline_slopes(t, 2.0) @ coefficients == pytest.approx(6.0 * t**2, abs=1e-14)
    mirrored = coefficients[::-1]
    assert weights(t) @ mirrored == pytest.approx((1.0 - t) ** 3, abs=1e-15)
    assert weights(t) @ np.array([2.0, -1.0, 2.0, 11.0]) / 3.0 == pytest.approx(t**2, abs=1e-15)
    assert interval_of(3.0 + t, 1.0, 4) == pytest.approx((3, t))


@pytest.fixture(scope="module")
def ring():
    """A groove all around has a table of one angle, made in a second."""
    law = GroovedFilm(RING)
    law.set_table(np.array([tabulated_row(RING, x) for x in np.linspace(0.0, LAST, LEVELS)]))
    return law


@pytest.mark.long
def test_interpolated_law_of_a_groove_around(ring):
    """Force and side flow against twice the grid; its own derivatives; passivity."""
    for eps, eps_dot, eps_w, angle in states(2, 12):
        ring.angle = angle
        force = ring(eps, eps_dot, eps_w)
        state = GroovedFilmState(RING, eps, angle, (288, 20))
        f_r, f_t, flow, *_ = state.solve(eps_dot, 0.5 * eps_w)
        assert math.hypot(force[0] - f_r, force[1] - f_t) < 0.01 * math.hypot(f_r, f_t)
        (interpolated,) = ring.side_flow(*map(np.atleast_1d, (eps, eps_dot, eps_w, angle)))
        assert interpolated == pytest.approx(flow, rel=0.01)
        assert dissipated_power(force, eps_dot, eps_w) > 0.0
        assert_derivatives(ring, eps, eps_dot, eps_w)


@pytest.mark.long
@pytest.mark.parametrize("bearing", [two_axial(0.5), two_axial(1.0, 0.8)], ids=["whole", "part"])
def test_interpolated_law_of_two_grooves(bearing):
    """1 % of the force, against twice the grid, for random motions up to eps = 0.95."""
    law = GroovedFilm(bearing)
    law.set_table(film_table(bearing))
    deviations = []
    for eps, eps_dot, eps_w, angle in states(4, 100):
        law.angle = angle
        force = law(eps, eps_dot, eps_w)
        state = GroovedFilmState(bearing, eps, angle, (288, 20))
        f_r, f_t, *_ = state.solve(eps_dot, 0.5 * eps_w)
        deviations.append(math.hypot(force[0] - f_r, force[1] - f_t) / math.hypot(f_r, f_t))
        assert dissipated_power(force, eps_dot, eps_w) > 0.0
        assert_derivatives(law, eps, eps_dot, eps_w)
    assert max(deviations) < 0.01 and np.median(deviations) < 0.003
