"""Supply grooves of a bearing: their places, and Reynolds' equation between them."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from exu_press.errors import InputError
from exu_press.laws.film.cavitation import FilmMatrix, Pressures
from exu_press.numerics.arrays import Array

__all__ = ["FilmFlow", "Groove", "GroovedBearing", "GroovedFilmState"]

TURN = 2.0 * math.pi

MOST_ALIKE = 12
"""Grooves in equal steps around a bearing, at most."""

NARROWEST = math.radians(1.0)
"""Least bearing between two grooves, rad: less is not resolved."""

ROUNDING = 1e-9
"""Part of a cell's largest source by which its flow may be short before it counts as wet."""

FAINT = 1e-3
"""Part of the supply pressure whose flow through a cell counts like its source for `ROUNDING`."""

COARSEST = 36, 5
"""Cells of the grid whose refinements have each of its cells divided, around and along."""


class FilmFlow(NamedTuple):
    """What Reynolds' equation says of a film.

    Attributes:
        f_r, f_t: force, 1/s.
        side_flow: out of both ends, over L R c, 1/s.
        feed: out of the grooves, each by its pressure over the largest, over L R c, 1/s. Times the
            largest pressure it is the power of the pump.
        pressures: of each speed and the supply alone, where the film is unbroken.
        pressure: of all together, over 12 mu R^2 / c^2, (n m,), 1/s.
    """

    f_r: float
    f_t: float
    side_flow: float
    feed: float
    pressures: Pressures
    pressure: Array


@dataclass(frozen=True)
class Groove:
    """A groove in a bearing, deep beside the clearance, middle to middle with the bearing.

    Attributes:
        angle: of its middle, in the bearing, rad.
        width: around the bearing, rad; 2 pi of one that goes all around.
        length: along the axis, over the bearing's, 0 to 1.
        pressure: of its oil above ambient, over the largest of the bearing's grooves, 0 to 1.
    """

    angle: float
    width: float
    length: float
    pressure: float = 0.0

    @property
    def is_circumferential(self) -> bool:
        """Whether it goes all around."""
        return self.width >= TURN


@dataclass(frozen=True)
class GroovedBearing:
    """The shape of a bearing with grooves, which its film law depends on.

    Attributes:
        length_to_diameter: L/D.
        grooves: one at least, but of an inclined journal.
    """

    length_to_diameter: float
    grooves: tuple[Groove, ...]

    def __post_init__(self) -> None:
        """Raise InputError for grooves that overlap, or that leave no bearing."""
        around = [groove for groove in self.grooves if groove.is_circumferential]
        if around and (len(self.grooves) > 1 or around[0].length >= 1.0):
            raise InputError(
                "grooves: allowed beside one that goes all around is no other, and it is shorter "
                "than the bearing"
            )
        if self.grooves and not around:
            self._refuse_overlaps()

    def _refuse_overlaps(self) -> None:
        by_angle = sorted(self.grooves, key=lambda groove: groove.angle % TURN)
        widest = max(groove.width for groove in self.grooves)
        if widest > TURN - NARROWEST:
            raise InputError(
                f"groove of width_deg = {math.degrees(widest):g}: allowed is a number <= 359, "
                "which leaves 1 deg of bearing, or 360 for one that goes all around"
            )
        for first, second in pairwise([*by_angle, by_angle[0]]):
            apart = TURN if len(by_angle) == 1 else (second.angle - first.angle) % TURN
            if apart < 0.5 * (first.width + second.width) + NARROWEST:
                at = sorted(round(math.degrees(g.angle), 6) for g in (first, second))
                raise InputError(
                    f"grooves at {at[0]:g} and {at[1]:g} deg overlap; allowed are grooves with "
                    "1 deg of bearing between them at least"
                )

    @property
    def is_pressurized(self) -> bool:
        """Whether a groove has oil under pressure."""
        return any(groove.pressure for groove in self.grooves)

    @property
    def period(self) -> float:
        """Angle after which the grooves repeat themselves, rad; 0 where all go around."""
        if all(groove.is_circumferential for groove in self.grooves):
            return 0.0
        own = self._places(0.0)
        return min(
            TURN / count for count in range(1, MOST_ALIKE + 1) if self._places(TURN / count) == own
        )

    @property
    def mirror_axis(self) -> float | None:
        """Angle of an axis about which the grooves are symmetric, rad, or None."""
        if not self.period:
            return None
        middles = (0.5 * (a.angle + b.angle) for a in self.grooves for b in self.grooves)
        mirrored = (
            axis
            for axis in middles
            if replace(
                self,
                grooves=tuple(replace(g, angle=2.0 * axis - g.angle) for g in self.grooves),
            )._places(0.0)
            == self._places(0.0)
        )
        return next(mirrored, None)

    def _places(self, turned: float) -> set[tuple[int, float, float, float]]:
        """Return the grooves of the turned bearing, their angles to a millionth of a turn."""
        return {
            (
                round((groove.angle + turned) / TURN * 1e6) % 1_000_000,
                groove.width,
                groove.length,
                groove.pressure,
            )
            for groove in self.grooves
        }

    def shear_integral(self, eps: float, angle: float) -> tuple[float, float]:
        r"""Return the integral of 1 / h around the lands, and its derivative by eps.

        The oil in a groove is not sheared: from 2 pi / sqrt(1 - eps^2) the part over each groove is
        left out, between its ends t' and t'' by Sommerfeld's substitution,

        .. math:: \int \frac{dt}{1 - \varepsilon \cos t} = \frac{2}{s} \arctan
            \left(\sqrt{\frac{1 + \varepsilon}{1 - \varepsilon}} \tan\frac{t}{2}\right)
        """
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        shear, slope = TURN / s, TURN * eps / (s * s2)
        for groove in self.grooves:
            if groove.is_circumferential:
                shear -= groove.length * TURN / s
                slope -= groove.length * TURN * eps / (s * s2)
                continue
            begin = math.remainder(groove.angle - 0.5 * groove.width - angle, TURN)
            for sign, t in ((-1.0, begin), (1.0, begin + groove.width)):
                integral, by_eps = _running(eps, t)
                shear -= sign * groove.length * integral
                slope -= sign * groove.length * by_eps
        return shear, slope


def _running(eps: float, t: float) -> tuple[float, float]:
    """Return the integral of 1 / h from 0 to t, and its derivative by eps."""
    s2 = (1.0 - eps) * (1.0 + eps)
    s = math.sqrt(s2)
    turns = round(t / TURN)
    rest = t - TURN * turns
    swept = 2.0 * math.atan2(math.sqrt((1 + eps) / (1 - eps)) * math.sin(0.5 * rest),
                             math.cos(0.5 * rest)) + TURN * turns  # fmt: skip
    integral = swept / s
    by_eps = eps * integral / s2 + math.sin(t) / (s2 * (1.0 - eps * math.cos(t)))
    return integral, by_eps


class GroovedFilmState:
    r"""A journal at a place in a grooved bearing: Reynolds' equation for any of its velocities.

    .. math::
        \partial_\theta (h^3 \partial_\theta p) +
        \frac{1}{(L/D)^2} \partial_\zeta (h^3 \partial_\zeta p)
        = -(\dot\varepsilon \cos\theta - \tfrac12 \varepsilon W \sin\theta), \qquad
        h = 1 - \varepsilon \cos\theta

    with p = 0 at both ends, the grooves' pressures in them, and Swift and Stieber's cavitation, as
    `reynolds.solve_reynolds` has it: a complementarity problem with an M-matrix, solved exactly by
    policy iteration. The grid has the grooves' edges on its lines, and is dense at the narrow gap.
    """

    def __init__(
        self, bearing: GroovedBearing, eps: float, angle: float, cells: tuple[int, int]
    ) -> None:
        """Make the matrix.

        Args:
            bearing: its shape.
            eps: eccentricity ratio.
            angle: of the eccentricity in the bearing, rad.
            cells: around, and over half of the length.
        """
        theta, zeta = _angles(bearing, eps, angle, cells[0]), _heights(bearing, cells[1])
        d_theta, d_zeta = np.diff(np.append(theta, theta[0] + TURN)), np.diff(zeta)
        self._local = theta - angle
        self._w_theta = 0.5 * (d_theta + np.roll(d_theta, 1))
        self._w_zeta = 0.5 * np.append(d_zeta[0], d_zeta[1:] + d_zeta[:-1])
        gap_face = 1.0 - eps * np.cos(self._local + 0.5 * d_theta)
        gap = 1.0 - eps * np.cos(self._local)
        ratio = bearing.length_to_diameter
        around = np.outer(gap_face**3 / d_theta, self._w_zeta)  # to the next one around
        along = np.outer(gap**3 * self._w_theta, 1.0 / (ratio**2 * d_zeta))
        diagonal = around + np.roll(around, 1, axis=0) + along
        diagonal[:, 1:] += along[:, :-1]
        self._matrix, self._to_end = FilmMatrix(around, along[:, :-1], diagonal), along[:, -1]
        share = _groove_pressures(bearing, theta, zeta[:-1]).ravel()
        self._land = np.isnan(share)
        self._share = np.where(self._land, 0.0, share)
        shapes = np.stack([np.cos(self._local), -np.sin(self._local)]) * self._w_theta
        self._sources = (shapes[:, :, None] * self._w_zeta).reshape(2, -1)
        self._area = np.outer(self._w_theta, self._w_zeta).ravel()
        if bearing.is_pressurized:
            self._sources = np.stack([*self._sources, -self._matrix.net(self._share)])

    def solve(
        self,
        eps_dot: float,
        half_w: float,
        supply: float = 0.0,
        guess: Pressures | None = None,
    ) -> FilmFlow:
        """Return force and flows of a velocity, and where the film is unbroken.

        Args:
            eps_dot: d eps/dt, 1/s.
            half_w: eps W / 2, 1/s.
            supply: largest pressure of the grooves, over 12 mu R^2 / c^2, 1/s.
            guess: pressures of another velocity.
        """
        speeds = np.array([eps_dot, half_w, supply])[: len(self._sources)]
        source = speeds[:2] @ self._sources[:2]
        if guess is None:  # a pressure fills the film; cell by cell that would take long
            wet = self._land & ((source > 0.0) | (supply > 0.0))
            guess = self._matrix.pressures(self._sources, wet)
        rounding = math.hypot(eps_dot, half_w) * self._area
        rounding = ROUNDING * (rounding + supply * FAINT * self._matrix.diagonal)
        pressures = self._matrix.solve(self._sources, speeds, rounding, self._land, guess)
        p = speeds @ pressures.by_speed + supply * self._share
        feed = float(self._share @ (self._matrix.net(p) - source)) if supply else 0.0
        return FilmFlow(*self._loads(p), feed, pressures, p)

    def unbroken_loads(self, eps_dot: float, half_w: float) -> tuple[float, float, float]:
        """Return f_r, f_t and side flow of a film that bears negative pressures too, as `solve`."""
        return self._loads(np.array([eps_dot, half_w]) @ self._unbroken)

    @cached_property
    def _unbroken(self) -> Array:
        return self._matrix.pressures(self._sources[:2], self._land).by_speed

    def _loads(self, p: Array) -> tuple[float, float, float]:
        around = p.reshape(len(self._local), -1)
        load = (around @ self._w_zeta) * self._w_theta
        f_r = float(-12.0 * load @ np.cos(self._local))
        f_t = float(-12.0 * load @ np.sin(self._local))
        return f_r, f_t, float(self._to_end @ around[:, -1])

    def largest_pressure(
        self, eps_dot: float, half_w: float, supply: float = 0.0
    ) -> tuple[Array, Array]:
        """Return angles from the narrowest gap, (n,), and the largest pressure over the length.

        Arguments as of `solve`; the pressure is over 12 mu R^2 / c^2, 1/s.
        """
        p = self.solve(eps_dot, half_w, supply).pressure
        return self._local, p.reshape(len(self._local), -1).max(axis=1)


def _angles(bearing: GroovedBearing, eps: float, angle: float, cells: int) -> Array:
    """Return angles once around, with the grooves' edges, dense at the narrow gap."""
    edges = [
        (groove.angle + side * groove.width) % TURN
        for groove in bearing.grooves
        if not groove.is_circumferential
        for side in (-0.5, 0.5)
    ]
    first, *further = sorted(edges) or [0.0]
    ring = np.array([first, *further, first + TURN])
    theta = np.linspace(first, first + TURN, 20 * cells + 1)
    half = 0.5 * (theta - angle)
    turns = np.round(half / math.pi)
    half -= math.pi * turns
    narrow = math.sqrt((1.0 - eps) / (1.0 + eps))
    swept = np.arctan2(np.sin(half), narrow * np.cos(half))  # Sommerfeld's substitution
    even = half + swept + TURN * turns
    at_edges = np.interp(ring, theta, even)
    pieces = []
    for i, (begin, end) in enumerate(pairwise(at_edges)):
        count = _nested_count(cells, (end - begin) / TURN, COARSEST[0], 1)
        piece = np.interp(np.linspace(begin, end, count + 1)[:-1], even, theta)
        piece[0] = ring[i]
        pieces.append(piece)
    return np.concatenate(pieces)


def _heights(bearing: GroovedBearing, cells: int) -> Array:
    """Return zeta from the middle, 0, to the end, 1, with the grooves' ends."""
    ends = sorted({groove.length for groove in bearing.grooves if groove.length < 1.0})
    if not ends:
        return np.sin(0.5 * math.pi * np.linspace(0.0, 1.0, cells + 1))
    pieces = [np.zeros(1)]
    for begin, end in pairwise([0.0, *ends, 1.0]):
        count = _nested_count(cells, math.sqrt(end - begin), COARSEST[1], 2)
        step = np.linspace(0.0, 1.0, count + 1)[1:]
        even = np.sin(0.5 * math.pi * step) if begin == 0.0 else np.sin(0.5 * math.pi * step) ** 2
        pieces.append(begin + (end - begin) * even)
    return np.concatenate(pieces)


def _nested_count(cells: int, share: float, coarsest: int, least: int) -> int:
    """Return the cells of a part, twice as many where the grid has twice as many."""
    refined = 1
    while cells % 2 == 0 and cells > coarsest:
        cells, refined = cells // 2, 2 * refined
    return refined * max(least, round(cells * share))


def _groove_pressures(bearing: GroovedBearing, theta: Array, zeta: Array) -> Array:
    """Return the pressures in the grooves over the largest, (n, m), and NaN beside them."""
    pressures = np.full((len(theta), len(zeta)), np.nan)
    for groove in bearing.grooves:
        away = np.abs(np.mod(theta - groove.angle + math.pi, TURN) - math.pi)
        around, along = away <= 0.5 * groove.width + 1e-9, zeta <= groove.length + 1e-9
        pressures[np.ix_(around, along)] = groove.pressure
    return pressures
