"""Springs between two points of a mechanism: linear ones, and gas springs.

The force counts positive where it pushes the ends apart, and damping acts against the rate of the
length. A spring holds nothing: the ideal motion does not know of it.

References
----------
.. [1] M. J. Moran, H. N. Shapiro, Fundamentals of Engineering Thermodynamics, 5th ed., Wiley 2006,
   section 2.2.5: work of a polytropic process.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism.parts import GROUND, Point
from exu_press.numerics.arrays import Array
from exu_press.schema.checks import (
    demand_at_least_zero,
    demand_known,
    demand_number,
    demand_point,
)

__all__ = [
    "ATMOSPHERE",
    "HALF_WIDTH",
    "GasSpring",
    "LinearSpring",
    "SpringBetween",
    "check_springs",
]

ATMOSPHERE = 101325.0
"""Pa, the standard atmosphere of ISO 2533."""

HALF_WIDTH = 0.025
"""Half the width of its picture over the size of a drawing."""


@dataclass(frozen=True)
class SpringBetween(ABC):
    """A spring between points of two bodies, or of a body and the frame.

    Attributes:
        name: as in the result's channels.
        between: its two bodies.
        at: its two ends in the drawing, m.
        damping: d, N s/m.
    """

    name: str
    between: tuple[str, str]
    at: tuple[Point, Point]
    damping: float = field(default=0.0, kw_only=True)

    symbol: ClassVar[tuple[Point, ...]] = ()
    """Line that pictures it: shares of its length, and half widths across."""

    @property
    def drawn_length(self) -> float:
        """Distance of its ends in the drawing, m."""
        return math.dist(*self.at)

    @abstractmethod
    def static_force(self, length: Any) -> Any:
        """Return the force without damping, N, at a length, m."""

    @abstractmethod
    def energy(self, length: Array) -> Array:
        """Return the stored energy, J, at lengths (n,), m."""

    @abstractmethod
    def check(self, where: str) -> None:
        """Raise InputError for the first key that is not allowed."""

    def force(self, length: Any, rate: Any) -> Any:
        """Return the force that pushes its ends apart, N.

        Args:
            length: distance of its ends, m.
            rate: of the length, m/s.
        """
        return self.static_force(length) - self.damping * rate

    def force_on_second_end(self, ends: Array, velocity: Array) -> Array:
        """Return the force on its second end, N.

        Args:
            ends: vector from the first end to the second, m.
            velocity: its rate, m/s.
        """
        length = math.hypot(*ends)
        direction = ends / length if length > 0.0 else np.zeros_like(ends)
        with np.errstate(invalid="ignore"):  # of a gas without volume it is infinite
            return np.asarray(self.force(length, float(direction @ velocity)) * direction)

    def outline(self, ends: Array, size: float) -> Array:
        """Return the line (n, 2), m, that pictures it between its ends (2, 2), m.

        Args:
            ends: first and second.
            size: of the drawing, m.
        """
        along = ends[1] - ends[0]
        across = np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-300)
        shares, sideways = np.array(self.symbol).T
        line = ends[0] + np.outer(shares, along) + HALF_WIDTH * size * np.outer(sideways, across)
        return np.asarray(line)

    def why_impossible(self, length: float, least: float = 0.0) -> str:
        """Return why it cannot have a length, m, or nothing.

        Args:
            length: m.
            least: share of its size in the drawing below which it has vanished.
        """
        vanished = length <= least * self.drawn_length
        return "has no length, and so no direction" if vanished else ""


@dataclass(frozen=True)
class LinearSpring(SpringBetween):
    """A spring whose force is k (l_0 - l) - d dl/dt, with l its length.

    Attributes:
        stiffness: k, N/m.
        free_length: l_0, m; None where the preload is given.
        preload: force in the drawing, N, negative where the spring pulls; or None.

    >>> ends = ("ram", "frame"), ((0.0, 0.0), (0.0, 0.5))
    >>> spring = LinearSpring("counterbalance", *ends, stiffness=1e4, preload=-2e3)
    >>> spring.relaxed_length, round(spring.force(0.4, 0.0), 6)
    (0.3, -1000.0)
    """

    stiffness: float = math.nan
    free_length: float | None = None
    preload: float | None = None

    symbol: ClassVar[tuple[Point, ...]] = (
        (0.0, 0.0),
        (0.12, 0.0),
        *((0.12 + 0.76 * (n + 0.5) / 10, 1.0 if n % 2 else -1.0) for n in range(10)),
        (0.88, 0.0),
        (1.0, 0.0),
    )

    @property
    def relaxed_length(self) -> float:
        """Length without force, m."""
        if self.free_length is not None:
            return self.free_length
        assert self.preload is not None
        return self.drawn_length + self.preload / self.stiffness

    def static_force(self, length: Any) -> Any:
        """Return k (l_0 - l), N."""
        return self.stiffness * (self.relaxed_length - length)

    def energy(self, length: Array) -> Array:
        """Return k (l - l_0)^2 / 2, J."""
        return 0.5 * self.stiffness * (length - self.relaxed_length) ** 2

    def check(self, where: str) -> None:
        """Raise InputError for the first key that is not allowed."""
        demand_at_least_zero(f"{where}.stiffness", self.stiffness, "N/m", positive=True)
        alternatives = {"free_length": self.free_length, "preload": self.preload}
        numbers = {key: value for key, value in alternatives.items() if value is not None}
        if len(numbers) != 1:
            raise InputError(
                f"{where}: has {'neither' if not numbers else 'both'} free_length and preload; "
                "allowed is one of the two"
            )
        for key, value in numbers.items():
            demand_number(f"{where}.{key}", value)
        if self.relaxed_length < 0.0:
            ((key, value),) = numbers.items()
            raise InputError(
                f"{where}.{key} = {value!r}: its free length would be {self.relaxed_length:.4g} m; "
                "allowed is a spring of a length >= 0"
            )


@dataclass(frozen=True)
class GasSpring(SpringBetween):
    """A cylinder of gas: A (p - p_0) - d dl/dt, with p V^n constant and V = V_0 + A (l - l_0).

    Attributes:
        area: A of its piston, m^2; negative where the gas lies on the side of the rod and pulls.
        pressure: absolute, in the drawing, where its length is l_0, Pa.
        volume: V_0 of the gas in the drawing, with all vessels that are open to it, m^3.
        exponent: n of the change of state: 1 where heat is exchanged slowly, 1.4 (air, nitrogen)
            where there is no time for it, 0 at constant pressure.
        ambient: p_0, pressure on the other side of the piston, Pa.
    """

    area: float = math.nan
    pressure: float = math.nan
    volume: float = math.nan
    exponent: float = math.nan
    ambient: float = ATMOSPHERE

    symbol: ClassVar[tuple[Point, ...]] = (
        *((0.0, 0.0), (0.1, 0.0), (0.1, 1.0), (0.6, 1.0), (0.6, -1.0), (0.1, -1.0), (0.1, 0.0)),
        *((0.1, 1.0), (0.45, 1.0), (0.45, -1.0), (0.45, 0.0), (1.0, 0.0)),
    )

    def gas_volume(self, length: Any) -> Any:
        """Return V, m^3, at a length, m."""
        return self.volume + self.area * (length - self.drawn_length)

    def gas_pressure(self, length: Any) -> Any:
        """Return p, Pa, at a length, m; infinite without any volume."""
        volume = self.gas_volume(length)
        with np.errstate(divide="ignore", invalid="ignore"):
            pressure = self.pressure * (self.volume / volume) ** self.exponent
        return np.where(volume > 0.0, pressure, np.inf)[()]

    def static_force(self, length: Any) -> Any:
        """Return A (p - p_0), N."""
        return self.area * (self.gas_pressure(length) - self.ambient)

    def energy(self, length: Array) -> Array:
        """Return the work on gas and surroundings from the drawn length, J.

        Of a polytropic process: p V (r^(n - 1) - 1) / (n - 1), with r = V_0 / V [1]_.
        """
        volume = self.gas_volume(length)
        log_ratio, change = np.log(self.volume / volume), self.exponent - 1.0
        work = np.expm1(change * log_ratio) / change if change else log_ratio
        work_on_gas = self.pressure * self.volume * work
        return np.asarray(work_on_gas + self.ambient * (volume - self.volume))

    def check(self, where: str) -> None:
        """Raise InputError for the first key that is not allowed."""
        demand_number(f"{where}.area", self.area)
        if self.area == 0.0:
            raise InputError(
                f"{where}.area = 0.0: allowed is a number > 0 (m^2) where the gas pushes the ends "
                "apart, < 0 where it pulls them together"
            )
        for key, unit in (("pressure", "Pa"), ("volume", "m^3")):
            demand_at_least_zero(f"{where}.{key}", getattr(self, key), unit, positive=True)
        demand_at_least_zero(f"{where}.exponent", self.exponent)
        demand_at_least_zero(f"{where}.ambient", self.ambient, "Pa")

    def why_impossible(self, length: float, least: float = 0.0) -> str:
        """Return why it cannot have a length, m, or nothing."""
        volume = self.gas_volume(length)
        if volume <= least * self.volume:
            return f"has a volume of {volume:.4g} m^3; a larger one in the drawing is needed"
        return super().why_impossible(length, least)


def check_springs(springs: Sequence[SpringBetween], bodies: Collection[str]) -> None:
    """Raise InputError for the first spring that cannot be, with the names of all bodies."""
    for spring in springs:
        where = f"springs.{spring.name}"
        between: Any = spring.between
        if not isinstance(between, tuple) or len(between) != 2:
            raise InputError(f"{where}.between = {between!r}: allowed are the names of two bodies")
        for body in between:
            demand_known(f"{where}.between: {body!r} is unknown", body, [*bodies, GROUND])
        if between[0] == between[1]:
            raise InputError(
                f"{where}.between: joins {between[0]!r} to itself; allowed are two bodies"
            )
        ends: Any = spring.at
        if not isinstance(ends, tuple) or len(ends) != 2:
            raise InputError(f"{where}.at = {ends!r}: allowed are two points [[x, y], [x, y]] (m)")
        for end in ends:
            demand_point(f"{where}.at", end)
        if spring.drawn_length == 0.0:
            raise InputError(f"{where}.at: its ends coincide; allowed are two places")
        demand_at_least_zero(f"{where}.damping", spring.damping, "N s/m")
        spring.check(where)
