"""Grooves with oil under pressure: Reynolds' equation, and the law of a run."""

import math

import numpy as np
import pytest

from exu_press.laws.film.grooves import Groove, GroovedBearing, GroovedFilmState, solve_grooved

AROUND = 2.0 * math.pi

RING = GroovedBearing(0.5, (Groove(0.0, AROUND, 0.2, 1.0),))

POCKETS = GroovedBearing(
    0.5, (Groove(0.5 * math.pi, 0.3, 0.8, 1.0), Groove(-0.5 * math.pi, 0.2, 0.5, 0.4))
)


@pytest.mark.parametrize("eps", [0.0, 0.3, 0.8])
def test_flow_of_a_groove_around(eps):
    """Two lands of length L_l, of which each passes pi D c^3 p (1 + 1.5 eps^2) / (12 mu L_l)."""
    film = GroovedFilmState(RING, eps, 0.0, (72, 8)).solve(0.0, 0.0, None, 2.0)
    land = 0.4 * RING.length_to_diameter  # over D; the pressure is in 12 mu R^2 / c^2
    expected = AROUND / RING.length_to_diameter * 2.0 / land * 0.5 * (1.0 + 1.5 * eps**2)
    assert film.side_flow == pytest.approx(expected, rel=2e-3)
    assert film.feed == pytest.approx(film.side_flow, rel=1e-9)


def test_what_the_pump_and_the_journal_put_in_is_lost():
    """At any motion; with all three speeds doubled, everything doubles."""
    rng = np.random.default_rng(7)
    for _ in range(60):
        eps, angle, supply = rng.uniform(0.0, 0.95), rng.uniform(-3, 3), 10.0 ** rng.uniform(-2, 2)
        turn = rng.uniform(-math.pi, math.pi)
        state = GroovedFilmState(POCKETS, eps, angle, (48, 6))
        film = state.solve(math.sin(turn), math.cos(turn), None, supply)
        journal = -film.f_r * math.sin(turn) + film.f_t * math.cos(turn)
        assert journal + 12.0 * supply * film.feed > 0.0
        twice = state.solve(2.0 * math.sin(turn), 2.0 * math.cos(turn), None, 2.0 * supply)
        assert twice[:4] == pytest.approx([2.0 * value for value in film[:4]], rel=1e-9)


def test_no_pressure_is_the_ambient_film():
    ambient = GroovedBearing(
        0.5, tuple(Groove(g.angle, g.width, g.length) for g in POCKETS.grooves)
    )
    arguments = 0.6, 0.4, 0.3, 0.8, (72, 8)
    expected = solve_grooved(ambient, *arguments)
    assert solve_grooved(POCKETS, *arguments) == pytest.approx(expected, rel=1e-10)
    assert solve_grooved(POCKETS, *arguments, supply=1e-9) == pytest.approx(expected, rel=1e-6)
