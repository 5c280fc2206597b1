"""A load on its mechanism: where it acts, which way, and how much when."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from exu_press.laws.load_curve import LoadCurve, PulseClock, closing
from exu_press.laws.sheet import PunchStroke, Sheet
from exu_press.mechanism import Mechanism, Point
from exu_press.numerics.arrays import Array

__all__ = ["AppliedLoad", "fastest_output"]


@dataclass(frozen=True)
class AppliedLoad:
    """One load.

    Attributes:
        kind: "blanking", "table", "sheet" or "spring".
        body: on which it acts.
        point: where, in the body's frame, m.
        direction: unit vector, in the frame, in which a positive force acts.
        over: "time", "crank_angle_deg", "height", "penetration" or "pulse".
        curve: the force over time, s, crank angle, rad, the output's height, m, or the time since
            the beginning of a pulse, s.
        clock: of a pulse, with the crank's angle and speed at the start -> the clock of its
            beginning.
        fade: of a force that acts while the output closes, the speed from which it acts in full,
            m/s; None where it acts both ways.
        damping: of the force per speed over the force, s/m.
        sheet: that is cut.
        top: height of its upper face, m.
    """

    kind: str
    body: str
    point: Point
    direction: Point
    over: str
    curve: LoadCurve
    fade: float | None
    clock: Callable[[float, float], PulseClock] | None = None
    damping: float = 0.0
    sheet: Sheet | None = None
    top: float = 0.0

    def force_at(self, position: float, velocity: float) -> float:
        """Return the force, N, at a place on its curve and a velocity of the output, m/s."""
        force = self.curve(position)
        if self.damping:
            force *= max(0.0, 1.0 - self.damping * velocity)
        return force if self.fade is None else force * closing(velocity, self.fade)

    def force(
        self,
        time: Array,
        crank: tuple[Array, Array],
        slider: tuple[Array, Array],
        memory: tuple[float, float | None] | None = None,
    ) -> Array:
        """Return the force in its direction, (n,), N, at instants (n,), s.

        Args:
            time: of the instants, from the start of the run for a pulse.
            crank: its angle, rad, and angular velocity, rad/s.
            slider: its height, m, and velocity, m/s.
            memory: of the load's clock or sheet before the first instant.
        """
        if self.sheet is not None:
            cut = PunchStroke(self.sheet)
            return _replay(cut, cut.force, (time, self.top - slider[0], -slider[1]), memory)
        if self.clock is not None:
            clock = self.clock(float(crank[0][0]), float(crank[1][0]))
            position = _replay(clock, clock.since_begin, (time, *crank), memory)
        else:
            position = {"time": time, "crank_angle_deg": crank[0], "height": slider[0]}[self.over]
        pairs = zip(position.tolist(), slider[1].tolist(), strict=True)
        return np.array([self.force_at(*pair) for pair in pairs])

    def moment(self, force: Array, angle: Array) -> Array:
        """Return the moment (n,), N m, of forces about the centre of a body at angles, rad."""
        (x, y), (u, v) = self.point, self.direction
        c, s = np.cos(angle), np.sin(angle)
        return np.asarray(force * ((c * x - s * y) * v - (s * x + c * y) * u))

    @property
    def largest(self) -> float:
        """Magnitude, N, that the force never exceeds: infinity where damping adds to its curve."""
        return math.inf if self.damping else self.curve.peak

    def shortest_edge(self, mechanism: Mechanism, angular_speed: float) -> float:
        """Return how long the steepest part of the curve takes from zero to the peak, s."""
        if self.sheet is not None:
            return min(self.sheet.crack_time, self._rise(fastest_output(mechanism, angular_speed)))
        if self.curve.steepest == 0.0:
            return math.inf
        rate = 1.0
        if self.over == "crank_angle_deg":
            rate = angular_speed
        elif self.over == "height":
            rate = fastest_output(mechanism, angular_speed)
        return self._rise(rate)

    def _rise(self, rate: float) -> float:
        return self.curve.peak / (self.curve.steepest * rate)


def _replay(
    clock: PulseClock | PunchStroke,
    value: Callable[..., float],
    states: tuple[Array, Array, Array],
    memory: tuple[float, float | None] | None,
) -> Array:
    """Return the values of a clock, (n,), whose memory follows the states over n instants."""
    if memory is not None:
        clock.recall(memory)
    values: list[float] = []
    for state in zip(*(level.tolist() for level in states), strict=True):
        if isinstance(clock, PunchStroke) and not values:
            clock.accept(*state)
        values.append(value(*state))
        clock.accept(*state)
    return np.array(values)


def fastest_output(mechanism: Mechanism, angular_speed: float) -> float:
    """Return the largest speed of a mechanism's ideal output, m/s, at one of the crank, rad/s."""
    angle = np.linspace(0.0, 2.0 * math.pi, 361)
    return float(np.abs(mechanism.ideal_slider(angle, angular_speed)[1]).max())
