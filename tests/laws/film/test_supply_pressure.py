"""Grooves with oil under pressure: Reynolds' equation, and the law of a run."""

import math

import numpy as np
import pytest
from scipy.special import ellipk
from test_grooves import assert_derivatives, states

from exu_press.joints.oriented import PressurizedInterface
from exu_press.laws.film import dissipated_power, grooved_table, pressurized
from exu_press.laws.film.grooves import Groove, GroovedBearing, GroovedFilmState
from exu_press.laws.film.pressurized import CHANNELS, INTERVALS, PressurizedFilm
from exu_press.model.film_tables import film_table, supply_table

AROUND = 2.0 * math.pi

RING = GroovedBearing(0.5, (Groove(0.0, AROUND, 0.1, 1.0),))

POCKETS = GroovedBearing(
    0.5, (Groove(0.5 * math.pi, 0.3, 0.8, 1.0), Groove(-0.5 * math.pi, 0.2, 0.5, 0.4))
)

TWO = GroovedBearing(
    0.5, tuple(Groove(angle, math.radians(10.0), 0.8, 1.0) for angle in (1.570796327, -1.570796327))
)


@pytest.mark.parametrize("eps", [0.0, 0.3, 0.8])
def test_flow_of_a_groove_around(eps):
    """Two lands of length L_l, of which each passes pi D c^3 p (1 + 1.5 eps^2) / (12 mu L_l)."""
    film = GroovedFilmState(RING, eps, 0.0, (72, 8)).solve(0.0, 0.0, 2.0)
    land = 0.45 * RING.length_to_diameter  # over D; the pressure is in 12 mu R^2 / c^2
    expected = AROUND / RING.length_to_diameter * 2.0 / land * 0.5 * (1.0 + 1.5 * eps**2)
    assert film.side_flow == pytest.approx(expected, rel=2e-3)
    assert film.feed == pytest.approx(film.side_flow, rel=1e-9)


def feed_flow(ratio, width, share):
    """Return the flow of an axial groove over c^3 p / (12 mu), of a concentric journal."""
    bearing = GroovedBearing(ratio, (Groove(0.0, width, share, 1.0),))
    fine, coarse = (
        GroovedFilmState(bearing, 0.0, 0.0, cells).solve(0.0, 0.0, 1.0).feed
        for cells in ((144, 16), (72, 8))
    )
    return 2.0 * ratio * (2.0 * fine - coarse)  # of first order, by the ends of a slit


@pytest.mark.parametrize("share", [0.4, 0.8])
def test_feed_flow_of_a_slit(share):
    """The conductance 4 K(k) / K(k') of a slit across a strip, k = sin(pi l / (2 L)).

    sinh maps the strip on a plane with two cuts, sn each of its halves on a rectangle.
    """
    m = math.sin(0.5 * math.pi * share) ** 2
    assert feed_flow(1.0, 2e-3, share) == pytest.approx(4.0 * ellipk(m) / ellipk(1.0 - m), rel=5e-3)


@pytest.mark.parametrize("share", [0.4, 0.8])
def test_a_wider_groove_feeds_its_lands_more(share):
    """Two lands of the length L (1 - share) / 2, which each pass c^3 p / (12 mu) over it."""
    added, ratio = 0.35, 0.5
    lands = 2.0 * added / (ratio * (1.0 - share))
    more = feed_flow(ratio, 0.35 + added, share) - feed_flow(ratio, 0.35, share)
    assert more == pytest.approx(lands, rel=5e-3)


def test_what_the_pump_and_the_journal_put_in_is_lost():
    """At any motion; with all three speeds doubled, everything doubles."""
    rng = np.random.default_rng(7)
    for _ in range(60):
        eps, angle, supply = rng.uniform(0.0, 0.95), rng.uniform(-3, 3), 10.0 ** rng.uniform(-2, 2)
        turn = rng.uniform(-math.pi, math.pi)
        state = GroovedFilmState(POCKETS, eps, angle, (48, 6))
        film = state.solve(math.sin(turn), math.cos(turn), supply)
        journal = -film.f_r * math.sin(turn) + film.f_t * math.cos(turn)
        assert journal + 12.0 * supply * film.feed > 0.0
        twice = state.solve(2.0 * math.sin(turn), 2.0 * math.cos(turn), 2.0 * supply)
        assert twice[:4] == pytest.approx([2.0 * value for value in film[:4]], rel=1e-9)


def law_of(bearing, tables):
    """Return a law with its tables, each from a module's rows or numbers."""
    law = PressurizedFilm(bearing)
    for module, take, table in zip(
        (grooved_table, pressurized), (law.set_table, law.set_supply_table), tables, strict=True
    ):
        levels = module.knots_of(bearing).x
        take(np.array([module.tabulated_row(bearing, x) for x in levels]) if table is None
             else table)  # fmt: skip
    return law


@pytest.fixture(scope="module")
def any_law():
    """A law of any numbers."""
    rng = np.random.default_rng(4)
    ambient = rng.normal(size=(grooved_table.LEVELS, 9, grooved_table.DIRECTIONS, 3))
    supply = pressurized.LEVELS, 7, pressurized.DIRECTIONS, INTERVALS + 1, CHANNELS
    table = rng.normal(size=supply)
    table[..., 4:] = table[:, :, :1, :1, 4:]  # of a journal at rest
    return law_of(POCKETS, (ambient, table))


def fed_states(seed, count):
    for eps, eps_dot, eps_w, angle in states(seed, count):
        yield (
            eps,
            eps_dot,
            eps_w,
            angle,
            math.hypot(eps_dot, eps_w) * 10.0 ** (3.0 * math.sin(angle)),
        )


def test_whatever_its_tables_hold_pump_and_journal_put_in_what_is_lost(any_law):
    for eps, eps_dot, eps_w, angle, any_law.supply in fed_states(5, 200):
        any_law.angle = angle
        journal = dissipated_power(any_law(eps, eps_dot, eps_w), eps_dot, eps_w)
        assert journal + any_law.pump_power > 0.0


def test_derivatives_are_the_forces(any_law):
    for eps, eps_dot, eps_w, angle, any_law.supply in fed_states(6, 30):
        any_law.angle = angle
        assert_derivatives(any_law, eps, eps_dot, eps_w)


def test_a_pressure_bears_a_journal_at_rest(any_law):
    """The force is the pressure's alone, and does not jump where the journal begins to move."""
    interface = PressurizedInterface(any_law, 10.0, 1e-4, 240.0)
    interface.orient(0.3)
    assert any_law.supply == 2.0
    at_rest = interface.load(4e-5, 0.0, 0.0, 0.0, 0.0)
    slow = interface.load(4e-5, 1e-14, 0.0, 0.0, 0.0)
    assert at_rest[:2] == pytest.approx(slow[:2], rel=1e-4)
    assert math.hypot(*at_rest[:2]) > 0.0
    assert interface.load(4e-5, 0.0, 0.0, 0.0, 0.0)[:2] == at_rest[:2]


def assert_near_twice_the_grid(law, seed, count):
    """In nine of ten states 1 % of the force, or of the ambient one where the two nearly cancel."""
    deviations = []
    for eps, eps_dot, eps_w, angle in states(seed, count):
        speed = math.hypot(eps_dot, eps_w)
        law.angle, law.supply = angle, speed * 10.0 ** (2.0 * math.sin(angle) - 1.0)
        force = law(eps, eps_dot, eps_w)
        state = GroovedFilmState(law.bearing, eps, angle, (288, 20))
        film = state.solve(eps_dot, 0.5 * eps_w, law.supply)
        ambient = state.solve(eps_dot, 0.5 * eps_w)
        largest = max(math.hypot(*film[:2]), math.hypot(*ambient[:2]))
        (flow,) = law.side_flow(*map(np.atleast_1d, (eps, eps_dot, eps_w, angle)))
        lost = dissipated_power(force, eps_dot, eps_w) + law.pump_power
        exact = film.f_t * 0.5 * eps_w - film.f_r * eps_dot + 12.0 * law.supply * film.feed
        deviations.append(
            (
                math.hypot(force[0] - film.f_r, force[1] - film.f_t) / largest,
                abs(flow / film.side_flow - 1.0),
                abs(lost / exact - 1.0),
            )
        )
    assert (np.median(deviations, axis=0) < [0.005, 0.02, 0.02]).all()
    assert (np.quantile(deviations, 0.9, axis=0) < [0.01, 0.03, 0.03]).all()


@pytest.mark.long
def test_interpolated_law_of_a_groove_around():
    assert_near_twice_the_grid(law_of(RING, (None, None)), 7, 40)


@pytest.mark.long
def test_interpolated_law_of_two_pockets():
    law = PressurizedFilm(TWO)
    law.set_table(film_table(TWO))
    law.set_supply_table(supply_table(TWO))
    assert_near_twice_the_grid(law, 8, 60)
