"""A film whose oil warms: its temperature, from the heat of the revolutions before."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from exu_press.joints.history import JointHistory
from exu_press.joints.interface import FilmInterface, InterfaceJoint
from exu_press.joints.joint import ClearanceJoint
from exu_press.laws.film.contract import film_scale
from exu_press.laws.film.oil import HOTTEST, STEADY, film_temperature
from exu_press.laws.film.side_flow import SideFlow
from exu_press.numerics.arrays import Array, lengths
from exu_press.scene import LubricatedJoint
from exu_press.scene.film import JournalFilm
from exu_press.scene.joint import Joint, unworn

__all__ = ["Heat", "WarmFilm", "warm_films"]

AVERAGED = 4
"""A temperature follows from the last revolution, or from the mean of the last quarter of those so
far where no two revolutions are alike."""

SETTLED = 0.05
"""Relative change of power and side flow from revolution to revolution, below which a film has
settled: a journal that sinks for many revolutions changes them long before its temperature."""

LEAST_SLOPE, LARGEST_SLOPE = -0.5, 0.75
"""Share of a step from the film's temperature to the one that the heat asks for.
It is not 0 as the journal sinks when the oil thins, and as friction in contacts does not fall."""


@dataclass(frozen=True)
class Heat:
    """A film's revolution.

    Attributes:
        power: dissipated, mean, W.
        flow: out at both ends, mean, m^3/s.
        pressure: force over length times diameter, mean, Pa.
        viscosity: that it had, Pa s.
    """

    power: float
    flow: float
    pressure: float
    viscosity: float


@dataclass
class WarmFilm:
    """A film of a run, with the temperature that it has at present.

    Attributes:
        joint: with its oil.
        interface: of the film, which has the viscosity.
        temperature: deg C.
        pressure: that thickens the oil, Pa.
        before: its revolutions so far.
        asked: temperature in the last revolution, and the one that its heat asked for, deg C.
    """

    joint: LubricatedJoint
    interface: FilmInterface
    temperature: float
    pressure: float = 0.0
    before: list[Heat] = field(default_factory=list)
    asked: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """Find the side flow."""
        film, joint = self.joint.film, self.joint
        assert isinstance(film, JournalFilm)
        assert film.oil is not None and film.length is not None
        self.oil, self._length = film.oil, film.length
        self._flow: SideFlow = film.side_flow(joint.radius)

    @property
    def viscosity(self) -> float:
        """Return the viscosity of the oil in the film, Pa s."""
        return self.oil.viscosity(self.temperature, self.pressure)

    def put(self, temperature: float, pressure: float) -> None:
        """Go on with another temperature, deg C, and another pressure, Pa."""
        self.temperature, self.pressure = temperature, pressure
        joint = self.joint
        size = self._length, joint.radius, joint.clearance
        self.interface.scale = film_scale(self.viscosity, *size)

    def side_flow(self, states: JointHistory) -> Array:
        """Return the flow at both ends, (n,), m^3/s."""
        joint = self.joint
        e = lengths(states.eccentricity)
        x, y = (states.eccentricity[:, :2] / np.maximum(e, 1e-300)[:, None]).T
        u, v = states.velocity[:, :2].T
        turning = states.turning.sum(axis=1)
        e_dot, v_t = u * x + v * y, v * x - u * y
        rates = e / joint.clearance, e_dot / joint.clearance
        eps_w = (e * turning - 2.0 * v_t) / joint.clearance
        return self._length * joint.radius * joint.clearance * self._flow(*rates, eps_w)

    def cooling(self, flow: Array) -> Array:
        """Return the heat that side flow and frame carry off, (n,), W."""
        oil, film = self.oil, self.temperature
        by_flow = oil.heat_capacity * flow * (film - oil.supply_celsius)
        return np.asarray(by_flow + oil.conductance * (film - oil.frame))

    def mean_pressure(self, force: Array) -> Array:
        """Return the mean pressure on the projected area, (n,), Pa, of a force (n, 2)."""
        area = 2.0 * self.joint.radius * self._length
        return lengths(force) / area

    @property
    def settled(self) -> bool:
        """Whether heat and temperature stay as they are in the last revolutions, or their means."""
        count = self._averaged
        recent, earlier = self.before[-count:], self.before[-2 * count : -count]
        if not earlier or self.asked is None or not _alike(recent, earlier):
            return False
        return abs(self.temperature - self.asked[0]) <= STEADY

    @property
    def _averaged(self) -> int:
        """Number of the last revolutions from whose mean the temperature follows."""
        if _alike(self.before[-1:], self.before[-2:-1]):
            return 1
        return max(1, len(self.before) // AVERAGED)

    def balanced(self, last: Heat) -> tuple[float, float]:
        """Return temperature, deg C, and pressure, Pa, at which the film gets rid of its heat.

        The motion of the last revolution is held, or the mean of several where revolutions are not
        alike. A secant through the last two foretells how it will change with the temperature.
        """
        self.before.append(last)
        recent = self.before[-self._averaged :]
        per_viscosity = _mean([heat.power / heat.viscosity for heat in recent])
        pressure = _mean([heat.pressure for heat in recent])
        oil = self.oil
        balance = film_temperature(
            per_viscosity,
            oil.heat_capacity * _mean([heat.flow for heat in recent]),
            oil.conductance,
            oil.supply_celsius,
            oil.frame,
            lambda temperature: oil.viscosity(temperature, pressure),
        )
        before, self.asked = self.asked, (self.temperature, balance)
        if before is None or len(recent) > 1 or balance == math.inf:
            return balance, pressure
        moved = self.temperature - before[0]
        slope = (balance - before[1]) / moved if moved else 0.0
        slope = min(max(slope, LEAST_SLOPE), LARGEST_SLOPE)
        foretold = self.temperature + (balance - self.temperature) / (1.0 - slope)
        return min(max(foretold, min(oil.supply_celsius, oil.frame)), HOTTEST), pressure


def _alike(recent: Sequence[Heat], earlier: Sequence[Heat]) -> bool:
    """Return whether power and side flow of revolutions are those of earlier ones, on average."""
    if not recent or not earlier:
        return False
    for read in (_power, _flow):
        now, then = _mean([read(heat) for heat in recent]), _mean([read(heat) for heat in earlier])
        if abs(now - then) > SETTLED * abs(now):
            return False
    return True


def _power(heat: Heat) -> float:
    return heat.power


def _flow(heat: Heat) -> float:
    return heat.flow


def warm_films(
    joints: Mapping[str, ClearanceJoint], described: Mapping[str, Joint]
) -> dict[str, WarmFilm]:
    """Return the films whose oil warms, each as its oil is supplied.

    Args:
        joints: name -> joint with clearance.
        described: the same as the scene has them.
    """
    found = {}
    for name, joint in joints.items():
        kind = described[name]
        if isinstance(kind, LubricatedJoint) and kind.film.oil is not None:
            assert isinstance(joint, InterfaceJoint)
            (film,) = (one for one in joint.interfaces if isinstance(one, FilmInterface))
            round_one = unworn(kind)
            assert isinstance(round_one, LubricatedJoint)
            found[name] = WarmFilm(round_one, film, kind.film.oil.supply_celsius)
    return found


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
