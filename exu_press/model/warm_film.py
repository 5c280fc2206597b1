"""A film whose oil warms: its temperature by the heat balance of earlier revolutions."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from exu_press.joints.history import JointHistory
from exu_press.joints.interface import FilmInterface, InterfaceJoint
from exu_press.joints.joint import ClearanceJoint
from exu_press.joints.oriented import GroovedInterface
from exu_press.laws.film.contract import film_scale
from exu_press.laws.film.oil import HOTTEST, STEADY, film_temperature
from exu_press.laws.film.side_flow import SideFlow
from exu_press.numerics.arrays import Array, lengths
from exu_press.scene import LubricatedJoint
from exu_press.scene.film import JournalFilm
from exu_press.scene.joint import Joint, unworn

__all__ = ["Heat", "WarmFilm", "warm_films"]

AVERAGED = 4
"""The temperature follows from the last revolution; where revolutions differ, from the mean of the
last quarter of them."""

STEADY_CHANGE = 0.05
"""Relative change of power and side flow per revolution of a steady film. A journal that sinks for
many revolutions changes them long before the temperature."""

LEAST_SLOPE, LARGEST_SLOPE = -0.5, 0.75
"""Bounds of the derivative of the balance's temperature by the film's. It is not 0, as the journal
sinks when the oil thins, and as friction in contacts does not fall."""


@dataclass(frozen=True)
class Heat:
    """Heat of a film in a revolution.

    Attributes:
        power: dissipated, mean, W.
        flow: out at both ends, mean, m^3/s.
        pressure: force over length times diameter, mean, Pa.
        viscosity: of the oil in the revolution, Pa s.
    """

    power: float
    flow: float
    pressure: float
    viscosity: float


@dataclass
class WarmFilm:
    """A film of a run, with its present temperature.

    Attributes:
        joint: with its oil.
        interface: of the film.
        temperature: deg C.
        pressure: that thickens the oil, Pa.
        history: of earlier revolutions.
        last_balance: temperature in the last revolution, and that of its heat balance, deg C.
    """

    joint: LubricatedJoint
    interface: FilmInterface
    temperature: float
    pressure: float = 0.0
    history: list[Heat] = field(default_factory=list)
    last_balance: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """Take oil and side flow of the film."""
        film, joint = self.joint.film, self.joint
        assert isinstance(film, JournalFilm)
        assert film.oil is not None and film.length is not None
        self.oil, self._length = film.oil, film.length
        self._flow: SideFlow = film.side_flow(joint.radius)

    @property
    def viscosity(self) -> float:
        """Viscosity of the oil in the film, Pa s."""
        return self.oil.viscosity(self.temperature, self.pressure)

    def set_state(self, temperature: float, pressure: float) -> None:
        """Set temperature, deg C, and pressure, Pa."""
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
        eps_w = (e * turning - 2.0 * v_t) / joint.clearance
        motion = e / joint.clearance, e_dot / joint.clearance, eps_w
        if isinstance(self.interface, GroovedInterface):
            spin = states.turning[:, 0] - states.turning[:, 1]
            flow = self.interface.side_flow(*motion, states.orientation[:, 0], spin)
        else:
            flow = self._flow(*motion)
        return self._length * joint.radius * joint.clearance * flow

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
    def is_steady(self) -> bool:
        """Whether heat and temperature of the last revolutions, or their means, are constant."""
        count = self._averaged_count
        recent, earlier = self.history[-count:], self.history[-2 * count : -count]
        if not earlier or self.last_balance is None or not _are_alike(recent, earlier):
            return False
        return abs(self.temperature - self.last_balance[0]) <= STEADY

    @property
    def _averaged_count(self) -> int:
        """Number of the last revolutions whose mean determines the temperature."""
        if _are_alike(self.history[-1:], self.history[-2:-1]):
            return 1
        return max(1, len(self.history) // AVERAGED)

    def balance_heat(self, last: Heat) -> tuple[float, float]:
        """Return temperature, deg C, and pressure, Pa, of the film's heat balance.

        With the motion of the last revolution, or the mean of several where revolutions differ. A
        secant through the last two balances predicts the influence of the temperature on it.
        """
        self.history.append(last)
        recent = self.history[-self._averaged_count :]
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
        previous, self.last_balance = self.last_balance, (self.temperature, balance)
        if previous is None or len(recent) > 1 or balance == math.inf:
            return balance, pressure
        change = self.temperature - previous[0]
        slope = (balance - previous[1]) / change if change else 0.0
        slope = min(max(slope, LEAST_SLOPE), LARGEST_SLOPE)
        predicted = self.temperature + (balance - self.temperature) / (1.0 - slope)
        return min(max(predicted, min(oil.supply_celsius, oil.frame)), HOTTEST), pressure


def _are_alike(recent: Sequence[Heat], earlier: Sequence[Heat]) -> bool:
    """Return whether mean power and side flow of revolutions are those of earlier ones."""
    if not recent or not earlier:
        return False
    for name in ("power", "flow"):
        now, then = (_mean([getattr(h, name) for h in heats]) for heats in (recent, earlier))
        if abs(now - then) > STEADY_CHANGE * abs(now):
            return False
    return True


def warm_films(
    joints: Mapping[str, ClearanceJoint], described: Mapping[str, Joint]
) -> dict[str, WarmFilm]:
    """Return name -> the film whose oil warms, at its supply temperature."""
    films = {}
    for name, joint in joints.items():
        kind = described[name]
        if isinstance(kind, LubricatedJoint) and kind.film.oil is not None:
            assert isinstance(joint, InterfaceJoint)
            (film,) = (law for law in joint.interfaces if isinstance(law, FilmInterface))
            unworn_kind = unworn(kind)
            assert isinstance(unworn_kind, LubricatedJoint)
            films[name] = WarmFilm(unworn_kind, film, kind.film.oil.supply_celsius)
    return films


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
