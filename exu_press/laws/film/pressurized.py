r"""The film of a bearing whose grooves have oil under pressure, from tables of Reynolds' equation.

The film is of first degree in its two speeds and the supply pressure Pi = p c^2 / (12 mu R^2)
together. Its force is that of `grooved_table` at ambient pressure, and more by

.. math::
    \Delta f_{r,t} = \Pi\, H_{r,t}(\varepsilon, \text{angle})
    + \frac{\sqrt{a^2 + b^2}}{\lambda}\,
    g_{r,t}(\varepsilon, \text{angle}, \text{direction}, \psi), \qquad
    \tan^2 \psi = \frac{K \lambda\, \Pi}{\sqrt{a^2 + b^2}}, \qquad
    \lambda = s^3 \bigl(1 + (D/L)^2\bigr).

psi = 0 is the ambient film, in which g is 0. At psi = pi / 2 the pressure keeps the film unbroken,
so that it is linear: H is the force at rest. The side flow is alike. The dissipated power, of
which the pump does what the journal does not, is

.. math::
    D = \bigl(E (a^2 + b^2) + 12\, G\, \Pi^2\bigr)\, e^\chi

with the conductance G of the journal at rest: it is positive whatever the table holds.
"""

import math
from operator import add
from typing import Any, TypeVar

import numpy as np

from exu_press.laws.film.contract import AT_REST, FilmForce
from exu_press.laws.film.grooved_table import (
    LAST,
    GroovedFilm,
    Knots,
    extrapolated_rows,
    interval_of,
    knots_in_steps,
    open_ended,
    periodic,
    slopes,
    speeds_of,
    weights,
)
from exu_press.laws.film.grooves import TURN, GroovedBearing, GroovedFilmState
from exu_press.numerics.arrays import Array

__all__ = ["PressurizedFilm", "knots_of", "tabulated_row"]

CELLS = (72, 8)
"""Of the finer grid, around and over half of the length: for the pressure's part of the force."""

FINE_CELLS = (144, 16)
"""Of the grid for a journal at rest."""

CORNER = 4.0 / 3.0
"""Order of a grid's error in the flow, by the pressure's gradient at a rectangular corner."""

LEVELS = 14
"""Eccentricities, even in -ln(1 - eps) up to 0.995."""

STEP = math.radians(10.0)
"""Largest step of the angle in the bearing."""

DIRECTIONS = 20
"""Of the two speeds."""

INTERVALS = 16
"""Of psi."""

RATIO = 0.4
"""The K of psi."""

SLOWEST = 1e-6
"""Speeds over lambda Pi below which the force is that of this speed, for its derivatives."""

Ratio = TypeVar("Ratio", float, Array)

CHANNELS = 8
"""g_r, g_t and that of the side flow, chi, ln G, H_r, H_t and that of the side flow."""


def knots_of(bearing: GroovedBearing) -> Knots:
    """Return the knots of a bearing's table but psi's."""
    return knots_in_steps(bearing, LEVELS, STEP, DIRECTIONS)


def tabulated_row(bearing: GroovedBearing, x: float) -> Array:
    """Return the channels at an eccentricity, (angles, directions, psi, channels)."""
    eps, angles = -math.expm1(-x), knots_of(bearing).angle
    rows = extrapolated_rows(
        bearing,
        angles,
        CELLS,
        lambda angle, cells: _responses(bearing, eps, angle, cells),
        [1.0, -1.0, 1.0, 1.0, 1.0, 1.0, -1.0, 1.0],
    )
    for row, angle in zip(rows, angles.tolist(), strict=True):
        *loads, conductance = _at_rest(bearing, eps, angle)
        row[..., 4], row[..., 5:] = math.log(conductance), loads
    return rows


def _at_rest(bearing: GroovedBearing, eps: float, angle: float) -> list[float]:
    """Return force, side flow and feed of a journal at rest at a supply of 1, on a finer grid.

    The flows are extrapolated as is due to the corners of grooves: errors go with h^(4/3) there.
    """
    fine, coarse = (
        np.array(GroovedFilmState(bearing, eps, angle, cells).solve(0.0, 0.0, 1.0)[:4])
        for cells in (FINE_CELLS, CELLS)
    )
    orders = np.array([2.0, 2.0, CORNER, CORNER])
    loads: list[float] = (fine + (fine - coarse) / (2.0**orders - 1.0)).tolist()
    return loads


def _responses(bearing: GroovedBearing, eps: float, angle: float, cells: tuple[int, int]) -> Array:
    """Return the channels at a place, (directions, psi, channels)."""
    s = math.sqrt((1.0 - eps) * (1.0 + eps))
    psi = np.linspace(0.0, 0.5 * math.pi, INTERVALS + 1)
    state = GroovedFilmState(bearing, eps, angle, cells)
    hydrostatic = state.solve(0.0, 0.0, 1.0)
    conductance = hydrostatic.feed
    rows = np.empty((DIRECTIONS, INTERVALS + 1, CHANNELS))
    rows[...] = 0.0
    guess = None
    for row, (u, v) in zip(rows, speeds_of(knots_of(bearing).direction, s), strict=True):
        ambient = state.solve(v, u, guess=guess)
        guess = ambient.pressures
        lost = ambient.f_t * u - ambient.f_r * v
        speed = math.hypot(v, s * u) / _stiffness(bearing, eps)
        row[-1, :3] = np.subtract(state.unbroken_loads(v, u), ambient[:3]) / speed
        film = hydrostatic
        for k in range(INTERVALS - 1, 0, -1):  # from the unbroken film on: it breaks quickly
            supply = math.tan(psi[k]) ** 2 / RATIO * speed
            film = state.solve(v, u, supply, film.pressures)
            added = np.subtract(film[:3], ambient[:3]) - supply * np.array(hydrostatic[:3])
            row[k, :3] = added / speed
            power = film.f_t * u - film.f_r * v + 12.0 * supply * film.feed
            row[k, 3] = math.log(power / (lost + 12.0 * conductance * supply**2))
    return rows


def _stiffness(bearing: GroovedBearing, eps: Ratio) -> Ratio:
    """Return lambda, of psi."""
    stiffness: Ratio = ((1.0 - eps) * (1.0 + eps)) ** 1.5 * (1.0 + bearing.length_to_diameter**-2)
    return stiffness


class PressurizedFilm(GroovedFilm):
    """A film law with grooves under pressure.

    Attributes:
        supply: largest pressure of the grooves, over 12 mu R^2 / c^2, 1/s; set before each call.
        pump_power: at the last call, over P c, 1/s^2.
    """

    def __init__(self, bearing: GroovedBearing, onset_ratio: float | None = None) -> None:
        """Prepare; arguments as of `GroovedFilm`."""
        super().__init__(bearing, onset_ratio)
        self.supply = self.pump_power = 0.0
        self._supply_coefficients: Array | None = None
        self._supply_count = 1

    def set_supply_table(self, table: Array) -> None:
        """Take the table of what the pressure adds, (eccentricities, angles, directions, psi, 8).

        It has no slope over psi at both ends.
        """
        self._supply_count = table.shape[1]
        mirrored = np.concatenate([table, table[:, :, :, -2:0:-1]], axis=3)
        smooth = periodic(periodic(periodic(mirrored, 1), 2), 3)
        angle_first = np.swapaxes(open_ended(smooth), 0, 1)
        padded = np.pad(angle_first, ((1, 2), (0, 0), (1, 2), (1, 2), (0, 0)), mode="wrap")
        self._supply_coefficients = np.ascontiguousarray(padded[:, :, :, : INTERVALS + 3])

    def _smooth(self, eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        supply, u = self.supply, 0.5 * eps_w
        if supply <= 0.0 or not 0.0 <= eps < 1.0 or not math.isfinite(eps_dot + eps_w):
            return super()._smooth(eps, eps_dot, eps_w)
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        slowest = SLOWEST * supply * _stiffness(self.bearing, eps)
        speed = math.hypot(eps_dot, s * u)
        if speed < slowest:
            if speed < AT_REST:
                eps_dot, u, speed = slowest, 0.0, slowest
            eps_dot, u = eps_dot / speed * slowest, u / speed * slowest
            eps_w, speed = 2.0 * u, slowest
        ambient = super()._smooth(eps, eps_dot, eps_w)
        values, by_x, by_y, by_psi = self._interpolate_supply(eps, eps_dot, u, self.angle)
        (g_r, g_t, _, chi, ln_g, h_r, h_t, _), rho = values, math.hypot(eps_dot, u)
        c, d, b = u / rho, eps_dot / rho, s * u
        q = s2 * c * c + d * d
        dy = 0.5 * (1.0 + s / q) / rho
        scale = speed / _stiffness(self.bearing, eps)
        tan2 = RATIO * supply / scale
        turn = math.sqrt(tan2) / (2.0 * (1.0 + tan2))  # d psi / d ln tan^2 psi
        # the last is that of ln scale
        by_eps = (1.0 / (1.0 - eps), 0.5 * eps * c * d / (s * q),
                  3.0 * eps / s2 - u * u * eps / speed**2)  # fmt: skip
        by_dot = 0.0, dy * c, eps_dot / speed**2
        by_w = 0.0, -0.5 * dy * d, 0.5 * s * b / speed**2
        more = [
            supply * x * by_x[k + 5]
            + scale * (x * by_x[k] + y * by_y[k] + grown * (values[k] - turn * by_psi[k]))
            for k in (0, 1)
            for x, y, grown in (by_eps, by_dot, by_w)
        ]
        f_r = ambient[0] + supply * h_r + scale * g_r
        f_t = ambient[1] + supply * h_t + scale * g_t
        lost = ambient[1] * u - ambient[0] * eps_dot + 12.0 * math.exp(ln_g) * supply**2
        self.pump_power = lost * math.exp(chi) - (f_t * u - f_r * eps_dot)
        r_eps, r_dot, r_w, t_eps, t_dot, t_w = map(add, ambient[2:8], more)
        return f_r, f_t, r_eps, r_dot, r_w, t_eps, t_dot, t_w, ambient[8], ambient[9]

    def side_flow(self, eps: Array, eps_dot: Array, eps_w: Array, angle: Array) -> Array:
        """Return the side flow over L R c, (n,), 1/s; beyond the table's end as there."""
        states = zip(eps.tolist(), eps_dot.tolist(), (0.5 * eps_w).tolist(), angle.tolist(),
                     strict=True)  # fmt: skip
        ambient = super().side_flow(eps, eps_dot, eps_w, angle)
        if self.supply <= 0.0:
            return ambient
        values = np.array([self._interpolate_supply(*state)[0] for state in states])
        inside = np.minimum(eps, -math.expm1(-LAST))
        s = np.sqrt((1.0 - inside) * (1.0 + inside))
        scale = np.hypot(eps_dot, 0.5 * s * eps_w) / _stiffness(self.bearing, inside)
        return np.asarray(ambient + self.supply * values[:, 7] + scale * values[:, 2])

    def _interpolate_supply(
        self, eps: float, eps_dot: float, u: float, angle: float
    ) -> list[list[float]]:
        """Return the channels, then these by x, by the direction and by psi."""
        assert self._supply_coefficients is not None, "set_supply_table comes first"
        eps = min(eps, 1.0 - 1e-15)
        s = math.sqrt((1.0 - eps) * (1.0 + eps))
        speed = max(math.hypot(eps_dot, s * u), AT_REST)
        x, y = -math.log1p(-eps), 0.5 * (math.atan2(eps_dot, u) + math.atan2(eps_dot, s * u))
        psi = math.atan(math.sqrt(RATIO * _stiffness(self.bearing, eps) * self.supply / speed))
        x_step, step = LAST / (LEVELS - 1), 0.5 * math.pi / INTERVALS
        i, along_x = interval_of(min(x, LAST), x_step, LEVELS - 1)
        count = self._supply_count
        in_period = (angle - self._first_angle) % self._period
        j, around = interval_of(in_period, self._period / count, count)
        k, along_y = interval_of(y + math.pi, TURN / DIRECTIONS, DIRECTIONS)
        n, along_psi = interval_of(psi, step, INTERVALS)
        near = self._supply_coefficients[j : j + 4, i : i + 4, k : k + 4, n : n + 4]
        at_angle = (np.array(weights(around)) @ near.reshape(4, -1)).reshape(4, -1)
        w_x = np.array([weights(along_x), slopes(along_x, 1.0 / x_step)])
        w_y = np.array([weights(along_y), slopes(along_y, DIRECTIONS / TURN)])
        w_psi = np.array([weights(along_psi), slopes(along_psi, 1.0 / step)])
        at_x = (w_x @ at_angle).reshape(2, 4, -1)
        of_y = (w_y @ at_x).reshape(2, 2, 4, CHANNELS)  # by x or not, by y or not
        every: Any = w_psi @ of_y
        ((values, by_psi), (by_y, _)), ((by_x, _), _) = every.tolist()
        if x > LAST:
            by_x = [0.0] * CHANNELS
        return [values, by_x, by_y, by_psi]
