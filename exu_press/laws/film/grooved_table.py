r"""The film of a grooved bearing from a table of Reynolds' equation over all its motions.

A film is of first degree in its two speeds, so that it depends on eps, on the angle of the
eccentricity in the bearing, and on the direction of the speeds. Tabulated are ln E and m of
`tabulated_law`, with signs,

.. math::
    f_r = -E\, (a + m b), \qquad f_t = s E\, (b - m a), \qquad
    a = \dot\varepsilon,\quad b = \tfrac12 s\, \varepsilon W,\quad s = \sqrt{1 - \varepsilon^2},

and the side flow. E (a^2 + b^2) is the dissipated power: whatever the table holds, no energy is fed
in. Between its knots are cubic B-splines (de Boor, A Practical Guide to Splines, 1978).
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from exu_press.laws.film.asperities import with_asperities
from exu_press.laws.film.contract import AT_REST, OUTSIDE, FilmForce, FilmLaw
from exu_press.laws.film.grooves import TURN, GroovedBearing, GroovedFilmState
from exu_press.numerics.arrays import Array

__all__ = [
    "GroovedFilm",
    "Knots",
    "extrapolated_rows",
    "interval_of",
    "knots_in_steps",
    "knots_of",
    "open_ended",
    "periodic",
    "slopes",
    "speeds_of",
    "tabulated_row",
    "weights",
]

CELLS = (144, 10)
"""Of the finer grid, around and over half of the length."""

LEVELS, LAST = 26, 5.3
"""Eccentricities, even in -ln(1 - eps) up to 0.995."""

STEP = math.radians(5.0)
"""Largest step of the angle in the bearing."""

DIRECTIONS = 40
"""Of the two speeds."""


class Knots(NamedTuple):
    """Knots of a table: -ln(1 - eps), angle in the bearing, direction of the speeds."""

    x: Array
    angle: Array
    direction: Array


def knots_of(bearing: GroovedBearing) -> Knots:
    """Return the knots of a bearing's table."""
    return knots_in_steps(bearing, LEVELS, STEP, DIRECTIONS)


def knots_in_steps(bearing: GroovedBearing, levels: int, step: float, directions: int) -> Knots:
    """Return knots of which those of the angle are a step apart, rad, or less."""
    period, first = bearing.period, bearing.mirror_axis or 0.0
    count = max(1, math.ceil(period / step))
    return Knots(
        np.linspace(0.0, LAST, levels),
        np.linspace(first, first + period, count, endpoint=False),
        np.linspace(-math.pi, math.pi, directions, endpoint=False),
    )


def tabulated_row(bearing: GroovedBearing, x: float) -> Array:
    """Return ln E, m and the side flow's share at an eccentricity, (angles, directions, 3).

    Richardson's extrapolation from two grids, of which one is twice as fine: the finite volumes
    are of second order.
    """
    knots = knots_of(bearing)
    eps = -math.expm1(-x)
    s = math.sqrt((1.0 - eps) * (1.0 + eps))
    speeds = speeds_of(knots.direction, s)
    return extrapolated_rows(
        bearing,
        knots.angle,
        CELLS,
        lambda angle, cells: np.array(_responses(bearing, eps, angle, speeds, cells)),
        [1.0, -1.0, 1.0],
    )


def extrapolated_rows(
    bearing: GroovedBearing,
    angles: Array,
    cells: tuple[int, int],
    responses: Callable[[float, tuple[int, int]], Array],
    signs: list[float],
) -> Array:
    """Return responses over angles and directions, by Richardson's extrapolation from two grids.

    Args:
        bearing: its shape.
        angles: at which they are wanted, rad.
        cells: of the finer grid.
        responses: over the directions and channels at an angle, on a grid.
        signs: of the channels in a mirror.
    """
    count = len(angles)
    computed = count if bearing.mirror_axis is None else count // 2 + 1
    half = cells[0] // 2, cells[1] // 2
    rows = []
    for angle in angles[:computed].tolist():
        fine, coarse = responses(angle, cells), responses(angle, half)
        rows.append(fine + (fine - coarse) / 3.0)
    directions = len(rows[0])
    turned = (directions // 2 - np.arange(directions)) % directions
    rows += [rows[count - k][turned] * signs for k in range(computed, count)]
    return np.array(rows)


def _responses(
    bearing: GroovedBearing,
    eps: float,
    angle: float,
    speeds: Sequence[tuple[float, float]],
    cells: tuple[int, int],
) -> list[tuple[float, float, float]]:
    """Return ln E, m and the side flow's share at a place, for each pair of speeds."""
    s = math.sqrt((1.0 - eps) * (1.0 + eps))
    state, guess, responses = GroovedFilmState(bearing, eps, angle, cells), None, []
    for u, v in speeds:
        f_r, f_t, flow, _, guess, _ = state.solve(v, u, guess=guess)
        power, b = f_t * u - f_r * v, s * u
        ln_e, m = math.log(power / (v * v + b * b)), (-f_r * b - f_t * v / s) / power
        responses.append((ln_e, m, 0.5 * flow))
    return responses


def speeds_of(directions: Array, s: float) -> list[tuple[float, float]]:
    """Return eps W / 2 and d eps/dt, of length 1, of the directions of a table."""
    angle = np.linspace(-math.pi, math.pi, 4001)
    at = _direction(np.cos(angle), np.sin(angle), s)
    at[0], at[-1] = -math.pi, math.pi
    turned = np.interp(directions, at, angle)
    return [(math.cos(a), math.sin(a)) for a in turned.tolist()]


def _direction(u: Array, v: Array, s: float | Array) -> Array:
    """Return the direction of two speeds, which changes evenly where the film does."""
    return np.asarray(0.5 * (np.arctan2(v, u) + np.arctan2(v, s * u)))


class GroovedFilm:
    """A film law with grooves, as a run calls it: at an angle of the eccentricity in the bearing.

    Attributes:
        bearing: its shape.
        angle: of the eccentricity in the bearing, rad; set before each call.
    """

    def __init__(self, bearing: GroovedBearing, onset_ratio: float | None = None) -> None:
        """Prepare; `set_table` completes it.

        Args:
            bearing: its shape.
            onset_ratio: of `with_asperities`, or None for surfaces that stay apart.
        """
        self.bearing = bearing
        self.angle = 0.0
        self._law: FilmLaw = self._smooth
        if onset_ratio is not None:
            self._law = with_asperities(self._smooth, onset_ratio)
        self._coefficients: Array | None = None
        self._period, self._count = 1.0, 1
        self._first_angle = bearing.mirror_axis or 0.0

    def set_table(self, table: Array) -> None:
        """Take the table, (eccentricities, angles, directions, 3)."""
        self._count = table.shape[1]
        self._period = self.bearing.period or 1.0
        smooth = periodic(periodic(table, 1), 2)
        edges = ((1, 2), (0, 0), (1, 2), (0, 0))
        angle_first = np.swapaxes(open_ended(smooth), 0, 1)
        self._coefficients = np.pad(angle_first, edges, mode="wrap")

    def __call__(self, eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        """Return the response, as every film law does."""
        return self._law(eps, eps_dot, eps_w)

    def _smooth(self, eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        if not 0.0 <= eps < 1.0 or not math.isfinite(abs(eps_dot) + abs(eps_w)):
            return OUTSIDE
        if abs(eps_dot) + abs(eps_w) < AT_REST:
            eps_dot = AT_REST
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        u = 0.5 * eps_w
        rho = math.hypot(eps_dot, u)
        c, d = u / rho, eps_dot / rho
        q = s2 * c * c + d * d
        y = 0.5 * (math.atan2(d, c) + math.atan2(d, s * c))
        dy = 0.5 * (1.0 + s / q) / rho  # along c for eps_dot, against d for eps_w / 2
        dy_eps = 0.5 * eps * c * d / (s * q)
        x = -math.log1p(-eps)
        (g, m, _), (g_x, m_x, _), (g_y, m_y, _) = self._interpolate(x, y, self.angle)
        e = math.exp(g)
        x_eps = 1.0 / (1.0 - eps)
        g_eps, m_eps = g_x * x_eps + g_y * dy_eps, m_x * x_eps + m_y * dy_eps
        g_y *= dy
        m_y *= dy
        a, b = eps_dot, s * u
        b_eps = -eps * u / s
        f_r = -e * (a + m * b)
        f_t = s * e * (b - m * a)
        shear, shear_eps = self.bearing.shear_integral(eps, self.angle)
        return (
            f_r,
            f_t,
            f_r * g_eps - e * (m * b_eps + m_eps * b),
            f_r * g_y * c - e * (1.0 + m_y * c * b),
            0.5 * (-f_r * g_y * d - e * (m * s - m_y * d * b)),
            f_t * (g_eps - eps / s2) + s * e * (b_eps - m_eps * a),
            f_t * g_y * c - s * e * (m + m_y * c * a),
            0.5 * (-f_t * g_y * d + s * e * (s + m_y * d * a)),
            shear,
            shear_eps,
        )

    def side_flow(self, eps: Array, eps_dot: Array, eps_w: Array, angle: Array) -> Array:
        """Return the side flow over L R c, (n,), 1/s; beyond the table's end as there."""
        u = 0.5 * eps_w
        inside = np.clip(eps, 0.0, -math.expm1(-LAST))
        s = np.sqrt((1.0 - inside) * (1.0 + inside))
        y = _direction(u, eps_dot, s)
        states = zip((-np.log1p(-inside)).tolist(), y.tolist(), angle.tolist(), strict=True)
        share = np.array([self._interpolate(*state)[0][2] for state in states])
        return np.asarray(2.0 * share * np.hypot(eps_dot, u))

    def _interpolate(self, x: float, y: float, angle: float) -> list[list[float]]:
        """Return ln E, m and the side flow's share, then these by x and by y.

        Beyond the table's end E goes on by its power law, and m and the share stay.
        """
        assert self._coefficients is not None, "set_table comes first"
        i, along_x = interval_of(min(x, LAST), LAST / (LEVELS - 1), LEVELS - 1)
        in_period = (angle - self._first_angle) % self._period
        j, around = interval_of(in_period, self._period / self._count, self._count)
        k, along_y = interval_of(y + math.pi, TURN / DIRECTIONS, DIRECTIONS)
        near = self._coefficients[j : j + 4, i : i + 4, k : k + 4]
        at_angle = np.array(weights(around)) @ near.reshape(4, 48)
        w_x = np.array([weights(along_x), slopes(along_x, (LEVELS - 1) / LAST)])
        w_y = np.array([weights(along_y), slopes(along_y, DIRECTIONS / TURN)])
        both = w_y @ (w_x @ at_angle.reshape(4, 12)).reshape(2, 4, 3)
        (values, by_y), (by_x, _) = both.tolist()
        if x > LAST:
            values[0] += by_x[0] * (x - LAST)
            by_x[1] = by_x[2] = 0.0
        return [values, by_x, by_y]


def interval_of(value: float, step: float, count: int) -> tuple[int, float]:
    """Return the interval of a value, and where it lies in it, 0 to 1."""
    at = value / step
    interval = min(int(at), count - 1)
    return interval, at - interval


def weights(t: float) -> tuple[float, float, float, float]:
    """Return the values of the four cubic B-splines of an interval."""
    r, square, cube = 1.0 - t, t * t, t * t * t
    second = 2.0 / 3.0 - square + 0.5 * cube
    return r * r * r / 6.0, second, (1.0 + 3.0 * (t + square - cube)) / 6.0, cube / 6.0


def slopes(t: float, per_step: float) -> tuple[float, float, float, float]:
    """Return their derivatives."""
    half, r = 0.5 * per_step, 1.0 - t
    third = 1.0 + 2.0 * t - 3.0 * t * t
    return -half * r * r, half * t * (3.0 * t - 4.0), half * third, half * t * t


def periodic(values: Array, axis: int) -> Array:
    """Return the B-splines' coefficients of values that are periodic along an axis."""
    n = values.shape[axis]
    shape = [1] * values.ndim
    shape[axis] = n
    factors = (2.0 + np.cos(TURN * np.arange(n) / n)) / 3.0
    of_waves = np.fft.fft(values, axis=axis) / factors.reshape(shape)
    return np.asarray(np.fft.ifft(of_waves, axis=axis).real)


def open_ended(values: Array) -> Array:
    """Return the coefficients along the first axis: not-a-knot at its begin, natural at its end."""
    n = len(values)
    matrix = np.zeros((n + 2, n + 2))
    for i in range(n):
        matrix[i + 1, i : i + 3] = 1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0
    matrix[0, :5] = 1.0, -4.0, 6.0, -4.0, 1.0
    matrix[-1, -3:] = 1.0, -2.0, 1.0
    right = np.zeros((n + 2, *values.shape[1:]))
    right[1:-1] = values
    return np.asarray(np.linalg.solve(matrix, right.reshape(n + 2, -1)).reshape(right.shape))
