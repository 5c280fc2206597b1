"""An inclined journal: Reynolds' equation against limits, a finer grid and its own derivatives."""

import math
import random

import numpy as np
import pytest
from slopes import slopes

from exu_press import InputError
from exu_press.laws.film.grooves import Groove, GroovedBearing, GroovedFilmState
from exu_press.laws.film.reynolds import solve_reynolds
from exu_press.laws.film.tilted import CELLS, CELLS_WITH_GROOVES, TiltedFilm

PLAIN = GroovedBearing(0.5, ())
AXIAL = GroovedBearing(0.5, (Groove(0.5 * math.pi, 0.17, 1.0), Groove(-0.5 * math.pi, 0.17, 0.8)))
RING = GroovedBearing(0.5, (Groove(0.0, 2.0 * math.pi, 0.1),))


def states(seed, count, largest=0.95):
    """Yield tilt, its direction, angle, share of the admissible eccentricity, and three speeds."""
    rng = random.Random(seed)
    for _ in range(count):
        around, up = rng.uniform(-math.pi, math.pi), rng.uniform(-1.5, 1.5)
        speed = 10.0 ** rng.uniform(-3.0, 3.0)
        yield (
            rng.uniform(0.0, 0.8),
            rng.uniform(-4.0, 4.0),
            rng.uniform(-4.0, 4.0),
            rng.uniform(0.0, largest),
            speed * math.sin(around) * math.cos(up),
            2.0 * speed * math.cos(around) * math.cos(up),
            2.0 * speed * math.sin(up),
        )


def response(film, angle, share, eps_dot, eps_w, spin):
    film.angle, film.spin = angle, spin
    return film.respond(share * film.largest_ratio(angle), eps_dot, eps_w)


def dissipated(law, eps_dot, eps_w, spin):
    return -law[0] * eps_dot + 0.5 * law[1] * eps_w + 0.5 * law[10] * spin


def test_without_a_tilt_it_is_the_parallel_journal():
    """Whose oil comes in at the ends, or by grooves; its rotation makes no pressure by itself."""
    for eps, eps_dot, eps_w in ((0.6, 0.1, 0.6), (0.3, -0.2, 0.5), (0.9, 0.0, 0.9)):
        expected = solve_reynolds(eps, eps_dot, eps_w, 0.5, None, (288, 20))
        film = TiltedFilm(PLAIN, 0.0, 0.3)
        film.angle, film.spin = 0.8, 3.0
        parallel = film.respond(eps, eps_dot, eps_w)
        assert parallel[:2] == pytest.approx(expected[:2], abs=5e-3 * math.hypot(*expected[:2]))
        assert parallel[8] == pytest.approx(2.0 * math.pi / math.sqrt(1.0 - eps**2), rel=2e-3)
        assert parallel[10] == 0.0
    for bearing in (AXIAL, RING):
        film = TiltedFilm(bearing, 0.0, 0.0)
        film.angle = 0.3
        f_r, f_t, flow, *_ = GroovedFilmState(bearing, 0.6, 0.3, (288, 20)).solve(0.1, 0.3)
        inclined = film.respond(0.6, 0.1, 0.6)
        assert inclined[:2] == pytest.approx((f_r, f_t), abs=8e-3 * math.hypot(f_r, f_t))
        assert inclined[8] == pytest.approx(bearing.shear_integral(0.6, 0.3)[0], rel=1e-3)
        (out,) = film.side_flow(*map(np.atleast_1d, (0.6, 0.1, 0.6, 0.3, 0.0)))
        assert out == pytest.approx(flow, rel=0.01)


def test_squeeze_of_a_narrow_bearing_has_a_closed_form():
    """Flow along the axis alone: h^3 p' = C - S zeta (L/D)^2, with p = 0 at both ends."""
    ratio, tilt, direction, eps, angle = 0.02, 0.4, 0.9, 0.35, 0.2
    zeta, w = np.polynomial.legendre.leggauss(80)
    theta = (np.arange(2000) + 0.5) * (2.0 * math.pi / 2000)
    closing = np.cos(theta - angle)
    h = 1.0 - eps * closing[:, None] - tilt * np.cos(theta - direction)[:, None] * zeta
    i_0, i_1, i_2 = ((zeta**k / h**3) @ w for k in range(3))
    mean = 0.5 * ratio**2 * np.maximum(closing, 0.0) * (i_2 - i_1**2 / i_0)
    load = 12.0 * mean * (2.0 * math.pi / 2000)
    film = TiltedFilm(GroovedBearing(ratio, ()), tilt, direction)
    film.angle = angle
    expected = -load @ closing, -load @ np.sin(theta - angle)
    assert film(eps, 1.0, 0.0)[:2] == pytest.approx(expected, abs=5e-3 * math.hypot(*expected))


def test_the_rotation_of_the_inclination_counts():
    """In steady rotation, by the part of the force that eps W alone would miss."""
    film, missed = TiltedFilm(PLAIN, 0.4, 0.0), []
    for share in (0.2, 0.5, 0.8):
        for film.angle in (0.0, 0.7, 0.5 * math.pi, -0.7):
            eps = share * film.largest_ratio(film.angle)
            film.spin = 1.0
            whole = film(eps, 0.0, eps)
            film.spin = 0.0
            without = film(eps, 0.0, eps)
            change = math.hypot(whole[0] - without[0], whole[1] - without[1])
            missed.append(change / math.hypot(*whole[:2]))
    assert 0.03 < min(missed) < 0.05
    assert 0.18 < max(missed) < 0.21


def test_it_ends_where_an_end_touches():
    for tilt, direction, angle, _, *speeds in states(6, 20):
        film = TiltedFilm(PLAIN, tilt, direction)
        largest = film.largest_ratio(angle)
        end = largest * np.exp(1j * angle) + np.array([1.0, -1.0]) * tilt * np.exp(1j * direction)
        assert np.abs(end).max() == pytest.approx(1.0)
        assert film.least_gap(largest, angle) == pytest.approx(0.0, abs=1e-12)
        assert film.least_gap(0.5 * largest, angle) > 0.0
        assert math.isnan(response(film, angle, 1.0, *speeds)[0])
        assert math.isfinite(response(film, angle, 0.999, *speeds)[0])
    with pytest.raises(InputError, match="tilt \\* length / 2 = 1 clearances: allowed"):
        TiltedFilm(PLAIN, 1.0, 0.0)
    with pytest.raises(InputError, match="grooves with pressure and"):
        TiltedFilm(GroovedBearing(0.5, (Groove(0.0, 0.1, 1.0, 1.0),)), 0.1, 0.0)


@pytest.mark.parametrize("bearing", [PLAIN, AXIAL, RING], ids=["plain", "axial", "ring"])
def test_it_dissipates(bearing):
    """In any motion, up to where it touches."""
    for tilt, direction, angle, share, *speeds in states(7, 20, 0.999):
        film = TiltedFilm(bearing, tilt, direction)
        assert dissipated(response(film, angle, share, *speeds), *speeds) > 0.0


def assert_near_finer_grid(bearing, seed, count):
    """1 % of the force, but where it is the small difference of what both ends bear."""
    of_force, of_ends, (n, m) = [], [], CELLS_WITH_GROOVES if bearing is AXIAL else CELLS
    for tilt, direction, angle, share, *speeds in states(seed, count):
        law, finer = (
            response(TiltedFilm(bearing, tilt, direction, cells), angle, share, *speeds)
            for cells in (None, (2 * n, 2 * m))
        )
        change, force = (
            math.hypot(*pair) for pair in ((law[0] - finer[0], law[1] - finer[1]), finer[:2])
        )
        of_force.append(change / force)
        of_ends.append(change / (force + abs(finer[10]) / tilt))
    assert max(of_ends) < 0.02
    assert np.quantile(of_force, 0.95) < 0.01
    assert np.median(of_force) < 0.003


@pytest.mark.parametrize("bearing", [PLAIN, RING], ids=["plain", "ring"])
def test_force_against_twice_the_grid(bearing):
    assert_near_finer_grid(bearing, 8, 8)


@pytest.mark.long
@pytest.mark.parametrize("bearing", [PLAIN, AXIAL, RING], ids=["plain", "axial", "ring"])
def test_force_against_twice_the_grid_in_many_states(bearing):
    """For random motions up to 0.95 of the admissible eccentricity."""
    assert_near_finer_grid(bearing, 9, 50)


def test_derivatives():
    """By eps, the three speeds and the angle; the grid moves with the place, which they leave out.

    So those by the place are compared on a fine grid.
    """
    film = TiltedFilm(GroovedBearing(0.7, ()), 0.4, 0.5, (192, 16))
    rng = random.Random(3)
    for _ in range(3):
        state = [rng.uniform(0.1, 0.5), rng.uniform(-1, 1), rng.uniform(-2, 2),
                 rng.uniform(-3, 3), rng.uniform(-3, 3)]  # fmt: skip

        def law(*values):
            film.spin, film.angle = values[3:]
            return film.respond(*values[:3])

        f = law(*state)
        of_r, of_t, of_couple, of_shear = (
            (f[2], f[3], f[4], -0.5 * f[13], f[15]),
            (f[5], f[6], f[7], 0.5 * f[14], f[16]),
            (f[11], f[13], 0.5 * f[14], 0.5 * f[12], f[17]),
            (f[9], 0.0, 0.0, 0.0, f[18]),
        )
        found = slopes(law, state, [1e-5] * 5)[:, [0, 1, 10, 8]].T
        allowed = max(map(abs, (*of_r[:3], *of_t[:3]))) * np.array([4e-3, 1e-6, 1e-6, 1e-6, 4e-3])
        assert (np.abs(found - [of_r, of_t, of_couple, of_shear]) < allowed).all()
