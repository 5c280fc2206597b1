r"""The film of a journal that is inclined in its bearing: Reynolds' equation in each state.

The gap is that of a journal whose centre moves along the axis, z = zeta L / 2,

.. math::
    h = 1 - \varepsilon \cos(\theta - \gamma) - \tau \zeta \cos(\theta - \delta), \qquad
    \tau = \frac{\text{tilt}\; L}{2 c},

and with an inclination that stays in the bearing, its rotation alone makes a wedge:

.. math::
    \partial_\theta (h^3 \partial_\theta p) +
    \frac{1}{(L/D)^2} \partial_\zeta (h^3 \partial_\zeta p)
    = -\bigl[\dot\varepsilon \cos(\theta - \gamma)
    - \tfrac12 \varepsilon W \sin(\theta - \gamma)
    - \tfrac12 \Delta\omega\, \tau \zeta \sin(\theta - \delta)\bigr].

So the film depends on three speeds, the last of which is omega_J - omega_B, and a table of all its
states would be too large. On a coarse grid that follows the gap a state takes some milliseconds.
The pressure p >= 0 of Swift and Stieber's cavitation minimises a quadratic form with the matrix of
the left side: the dissipated power is twice that form, and positive on every grid.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from exu_press.errors import InputError
from exu_press.laws.film.cavitation import FilmMatrix, Mask
from exu_press.laws.film.contract import AT_REST, FilmForce
from exu_press.laws.film.grooves import ROUNDING, TURN, GroovedBearing
from exu_press.numerics.arrays import Array

__all__ = ["CELLS", "TiltedFilm"]

CELLS, CELLS_WITH_GROOVES = (40, 8), (96, 8)
"""Around, and over half of the length."""

SAMPLES = 10
"""Of the grid's density, for each of its cells around."""

LEAST_CELLS, LEAST_STATIONS = 2, 4
"""Of a groove or land, around and along."""

DENSER = 0.6
"""Share of the grid that is dense at the ends, for each part of the clearance that they tilt."""

Response = tuple[float, ...]

OUTSIDE: Response = (math.nan,) * 19


class TiltedFilm:
    """The law of an inclined journal, at an angle of its eccentricity in the bearing and a spin.

    Attributes:
        bearing: its shape.
        tilt: displacement of the journal's axis at the bearing's end, over the clearance.
        direction: of that displacement at the end z = L/2, in the bearing, rad.
        angle: of the eccentricity in the bearing, rad; set before each call.
        spin: omega_J - omega_B, rad/s; set before each call.
    """

    def __init__(
        self,
        bearing: GroovedBearing,
        tilt: float,
        direction: float,
        cells: tuple[int, int] | None = None,
    ) -> None:
        """Order the grid.

        Args:
            bearing, tilt, direction: as above; the bearing may be without grooves.
            cells: around, and over half of the length; by default enough for 1 % of the force in
                nearly all motions.

        Raises:
            InputError: the journal touches both ends, or grooves have a pressure.
        """
        if not 0.0 <= tilt < 1.0:
            raise InputError(f"tilt * length / 2 = {tilt:g} clearances: allowed is a number < 1")
        if bearing.is_pressurized:
            raise InputError(
                "grooves with pressure and film.tilt: allowed is one of the two, as an inclined "
                "journal's film has no oil under pressure"
            )
        self.bearing, self.tilt, self.direction = bearing, tilt, direction
        self.angle = self.spin = 0.0
        axial = any(not groove.is_circumferential for groove in bearing.grooves)
        cells = cells or (CELLS_WITH_GROOVES if axial else CELLS)
        zeta = _stations(bearing, tilt, cells[1])
        self._zeta, self._middles = zeta[1:-1], 0.5 * (zeta[1:] + zeta[:-1])
        self._d_zeta = np.diff(zeta)
        self._w_zeta = 0.5 * (self._d_zeta[1:] + self._d_zeta[:-1])
        shapes = np.stack([self._w_zeta, self._w_zeta, self._w_zeta * self._zeta])
        self._sources_along = shapes[:, None, :]
        self._factor = 6.0 * self._quadrature()
        self._per_along = 1.0 / (bearing.length_to_diameter**2 * self._d_zeta)
        self._order_angles(cells[0])
        self._wet: Mask | None = None

    def largest_ratio(self, angle: float) -> float:
        """Return the eccentricity ratio at which the journal touches an end of the bearing."""
        across = self.tilt * math.sin(angle - self.direction)
        along = self.tilt * abs(math.cos(angle - self.direction))
        return math.sqrt((1.0 - across) * (1.0 + across)) - along

    def least_gap(self, eps: float, angle: float) -> float:
        """Return the least thickness of the film, at an end, over the clearance."""
        along = abs(math.cos(angle - self.direction))
        return 1.0 - math.sqrt(eps * eps + 2.0 * eps * self.tilt * along + self.tilt**2)

    def __call__(self, eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        """Return the response, as every film law does."""
        return self.respond(eps, eps_dot, eps_w)[:10]  # type: ignore[return-value]

    def respond(self, eps: float, eps_dot: float, eps_w: float) -> Response:
        """Return the ten numbers of every film law, and nine of the inclination.

        The latter are the couple m of the inclination, and its derivatives by eps and spin / 2;
        those of -f_r and f_t by spin / 2, which are also those of m by eps_dot and eps W / 2, as
        the dissipated power

            D = -f_r eps_dot + f_t eps W / 2 + m (omega_J - omega_B) / 2 >= 0

        is a quadratic form where the film is unbroken; and the derivatives of f_r, f_t, m and j by
        the angle. P c m / 2 brakes the journal and drives the bearing.
        """
        speeds = np.array([eps_dot, 0.5 * eps_w, 0.5 * self.spin])
        if not 0.0 <= eps < self.largest_ratio(self.angle) or not np.isfinite(speeds).all():
            return OUTSIDE
        if np.abs(speeds).sum() < AT_REST:
            speeds[0] = AT_REST
        return self._response(eps, self.angle, speeds)

    def side_flow(
        self, eps: Array, eps_dot: Array, eps_w: Array, angle: Array, spin: Array
    ) -> Array:
        """Return the side flow over L R c, (n,), 1/s; NaN where the journal touches an end."""
        flows = np.full(len(eps), math.nan)
        for k, (ratio, turned) in enumerate(zip(eps.tolist(), angle.tolist(), strict=True)):
            if ratio < self.largest_ratio(turned):
                speeds = np.array([eps_dot[k], 0.5 * eps_w[k], 0.5 * spin[k]])
                film = self._film(ratio, turned)
                pressure = self._pressures(film, speeds) @ speeds
                flows[k] = self._flow_out(film, pressure, speeds)
        return flows

    def largest_pressure(
        self, eps: float, angle: float, eps_dot: float, half_w: float
    ) -> tuple[Array, Array]:
        """Return angles in the bearing, (n,), and the largest pressure over the length there.

        The pressure is over 12 mu R^2 / c^2, 1/s.
        """
        speeds = np.array([eps_dot, half_w, 0.5 * self.spin])
        film = self._film(eps, angle)
        pressure = self._pressures(film, speeds) @ speeds
        return film.theta, pressure.reshape(self._groove.shape).max(axis=1)

    def _order_angles(self, cells: int) -> None:
        """Share the cells around among lands and grooves: as many in every state."""
        axial = [groove for groove in self.bearing.grooves if not groove.is_circumferential]
        edges = {(g.angle + side * g.width) % TURN for g in axial for side in (-0.5, 0.5)}
        first = min(edges, default=0.0)
        self._ring = np.array([*sorted(edges or {0.0}), first + TURN])
        counts = [max(LEAST_CELLS, round(cells * d / TURN)) for d in np.diff(self._ring).tolist()]
        self._ring_at = np.cumsum([0, *counts])
        n, last = int(self._ring_at[-1]), len(self._w_zeta)
        self._next, self._previous = np.roll(np.arange(n), -1), np.roll(np.arange(n), 1)
        self._samples = np.linspace(first, first + TURN, SAMPLES * n + 1)
        self._groove = np.zeros((n, last), dtype=bool)
        self._land = np.ones((n, last + 1))
        for groove in self.bearing.grooves:
            covered = np.abs(self._zeta) <= groove.length + 1e-9
            cells_covered = np.abs(self._middles) < groove.length
            begin, end = 0, n
            if not groove.is_circumferential:
                start = (groove.angle - 0.5 * groove.width - first) % TURN + first
                begin = int(self._ring_at[np.argmin(np.abs(self._ring[:-1] - start))])
                end = int(self._ring_at[np.searchsorted(self._ring_at, begin) + 1])
            around = np.arange(begin, end + 1) % n
            self._groove[np.ix_(around, covered)] = True
            self._land[np.ix_(around[:-1], cells_covered)] = 0.0

    def _quadrature(self) -> float:
        """Return by how much the grid's flow along the axis alone has too little pressure."""
        around = [g.length for g in self.bearing.grooves if g.is_circumferential]
        length = around[0] if around else -1.0
        inner = np.abs(self._zeta) > length + 1e-9
        d, w = self._d_zeta, self._w_zeta
        matrix = np.diag(1.0 / d[1:] + 1.0 / d[:-1]) - np.diag(1.0 / d[1:-1], 1)
        matrix -= np.diag(1.0 / d[1:-1], -1)
        on_grid = w[inner] @ np.linalg.solve(matrix[np.ix_(inner, inner)], w[inner])
        exact = (1.0 - length) ** 3 / 6.0 if around else 2.0 / 3.0
        return float(exact / on_grid)

    def _angles(self, eps: float, angle: float) -> Array:
        """Return the grid's angles, dense at the narrow gaps of both ends."""
        theta = self._samples
        even = 2.0 * theta
        e, tilt = eps * complex(math.cos(angle), math.sin(angle)), self.tilt
        displaced = tilt * complex(math.cos(self.direction), math.sin(self.direction))
        for end in (e + displaced, e - displaced):
            size = abs(end)
            half = 0.5 * (theta - math.atan2(end.imag, end.real))
            turns = np.rint(half / math.pi)
            half -= math.pi * turns
            wide = math.sqrt((1.0 + size) / (1.0 - size))
            even += np.arctan(wide * np.tan(half)) + math.pi * turns  # Sommerfeld's substitution
        at_edges = np.interp(self._ring, theta, even)
        levels = np.interp(np.arange(self._ring_at[-1]), self._ring_at, at_edges)
        return np.asarray(np.interp(levels, even, theta))

    def _film(self, eps: float, angle: float) -> "_Film":
        """Return the film at a place of the journal's middle."""
        theta = self._angles(eps, angle)
        d_theta = theta[self._next] - theta
        d_theta[-1] += TURN
        w_theta = 0.5 * (d_theta + d_theta[self._previous])
        face, tilt = theta + 0.5 * d_theta, self.tilt
        cos, cos_face = np.cos(theta - angle)[:, None], np.cos(face - angle)[:, None]
        sin, sin_face = np.sin(theta - angle)[:, None], np.sin(face - angle)[:, None]
        by_zeta = tilt * np.cos(theta - self.direction)[:, None]
        by_zeta_face = tilt * np.cos(face - self.direction)[:, None]
        around = 1.0 - eps * cos_face - by_zeta_face * self._zeta
        along = 1.0 - eps * cos - by_zeta * self._middles
        shape = np.stack([cos[:, 0], -sin[:, 0], -tilt * np.sin(theta - self.direction)])
        return _Film(
            theta,
            around**2 * (self._w_zeta / d_theta[:, None]),
            along**2 * (w_theta[:, None] * self._per_along),
            around,
            along,
            1.0 - eps * cos_face - by_zeta_face * self._middles,
            (shape * w_theta)[:, :, None] * self._sources_along,
            np.stack([cos, eps * sin]),
            np.stack([cos_face, eps * sin_face]),
            d_theta,
        )

    def _response(self, eps: float, angle: float, speeds: Array) -> Response:
        """Return the law's response."""
        film = self._film(eps, angle)
        flat = self._pressures(film, speeds).T
        parts = flat.reshape(3, *self._groove.shape)
        matrix = self._factor * (film.sources.reshape(3, -1) @ flat.T)
        steps = parts - parts[:, self._next]
        drops = np.empty((3, *film.along.shape))
        drops[:, :, 1:-1] = parts[:, :, 1:] - parts[:, :, :-1]
        drops[:, :, 0], drops[:, :, -1] = parts[:, :, 0], parts[:, :, -1]
        steps, drops = steps.reshape(3, -1), drops.reshape(3, -1)
        around = film.square_around * (speeds @ steps).reshape(film.square_around.shape)
        along = film.square_along * (speeds @ drops).reshape(film.along.shape)
        by_place = (film.closing_face * around).reshape(2, -1) @ steps.T
        by_place += (film.closing * along).reshape(2, -1) @ drops.T
        (a_a, a_u, a_s), (_, u_u, u_s), (_, _, s_s) = matrix.tolist()
        a, u, s = (matrix @ speeds).tolist()
        by_place *= 3.0 * self._factor
        by_place[1] += speeds[1] * matrix[0] - speeds[0] * matrix[1]
        (a_eps, u_eps, s_eps), (a_turn, u_turn, s_turn) = by_place.tolist()
        sheared = self._land * film.d_theta[:, None] / film.gap
        shear = 0.5 * float(sheared.sum(axis=0) @ self._d_zeta)
        by_gap = film.closing_face * (sheared / film.gap)
        shear_eps, shear_turn = (0.5 * by_gap.sum(axis=1) @ self._d_zeta).tolist()
        return (
            -a, u, -a_eps, -a_a, -0.5 * a_u, u_eps, a_u, 0.5 * u_u, shear, shear_eps,
            s, s_eps, s_s, a_s, u_s, u - a_turn, a + u_turn, s_turn, shear_turn,
        )  # fmt: skip

    def _pressures(self, film: "_Film", speeds: Array) -> Array:
        """Return the pressures of each speed alone, (n m, 3), where that of all is positive."""
        around, along = film.square_around * film.around, film.square_along * film.along
        diagonal = around + around[self._previous] + along[:, 1:] + along[:, :-1]
        matrix = FilmMatrix(around, along[:, 1:-1], diagonal)
        sources, land = film.sources.reshape(3, -1), ~self._groove.ravel()
        source = speeds @ sources
        wet = (source > 0.0 if self._wet is None else self._wet) & land
        guess = matrix.pressures(sources, wet)
        rounding = ROUNDING * np.abs(speeds).max() * np.hypot(sources[0], sources[1])
        solved = matrix.solve(sources, speeds, rounding, land, guess)
        self._wet = solved.unbroken
        return np.asarray(solved.by_speed.T)

    def _flow_out(self, film: "_Film", pressure: Array, speeds: Array) -> float:
        """Return what leaves both ends: by the pressure, and displaced at the ends themselves."""
        p = pressure.reshape(self._groove.shape)
        source = (speeds @ film.sources.reshape(3, -1)).reshape(p.shape) / self._w_zeta
        flow = 0.0
        for near, further, end in ((0, 1, 0), (-1, -2, -1)):
            width, between = self._d_zeta[end], abs(self._zeta[near] - self._zeta[further])
            at_end = source[:, near] + (source[:, near] - source[:, further]) * width / between
            flow += 0.5 * width * float(at_end[p[:, near] > 0.0].sum())
            conductance = film.square_along[:, end] * film.along[:, end]
            flow += float(conductance @ p[:, near])
        return 0.5 * flow


class _Film(NamedTuple):
    """A film on its grid, at a place of the journal.

    Attributes:
        theta: angles in the bearing, (n,), rad.
        square_around, square_along: squared gap over distance, times the width, to the next one
            around and from the one before along the axis.
        around, along: the gap there.
        gap: at the middles of the cells.
        sources: what the film displaces by each of its speeds, (3, n, m).
        closing, closing_face: how the gap closes with eps and with the angle, at the nodes and
            between them, (2, n, 1).
        d_theta: from each angle to the next, rad.
    """

    theta: Array
    square_around: Array
    square_along: Array
    around: Array
    along: Array
    gap: Array
    sources: Array
    closing: Array
    closing_face: Array
    d_theta: Array


def _stations(bearing: GroovedBearing, tilt: float, cells: int) -> Array:
    """Return zeta from end to end, with the grooves' ends, denser at the ends the more it tilts."""
    ends = sorted({groove.length for groove in bearing.grooves if groove.length < 1.0})
    pieces, share = [np.array([-1.0])], DENSER * tilt
    for begin, end in pairwise([-1.0, *(-e for e in reversed(ends)), *ends, 1.0]):
        count = max(LEAST_STATIONS, round(2.0 * cells * math.sqrt(0.5 * (end - begin))))
        at = np.linspace(-1.0, 1.0, count + 1)[1:]
        dense = at * (15.0 - 10.0 * at**2 + 3.0 * at**4) / 8.0
        even = (1.0 - share) * np.sin(0.5 * math.pi * at) + share * dense
        pieces.append(begin + 0.5 * (end - begin) * (1.0 + even))
    return np.concatenate(pieces)
