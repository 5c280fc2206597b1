"""Commands to start and to stop, and the share of clutch and brake that follows over time."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["Ramp", "Schedule"]

NEAR = 2e-5
"""rad of the crank: corners and commands that are as near as that are reached."""

LONG_AGO = -1e30
"""s, or rad: command of the state at the start."""


@dataclass(frozen=True)
class Ramp:
    """A fraction that grows linearly from 0 to 1 after a command.

    >>> [round(Ramp(0.02, 0.06).fraction(since), 12) for since in (0.0, 0.04, 0.1)]
    [0.0, 0.5, 1.0]

    Attributes:
        begin: s, or rad of the crank, after the command.
        end: likewise, after `begin`.
        over_angle: whether these are angles of the crank.
    """

    begin: float
    end: float
    over_angle: bool = False

    def fraction(self, since: float) -> float:
        """Return the fraction at a time, s, or angle, rad, since the command."""
        return min(1.0, max(0.0, (since - self.begin) / (self.end - self.begin)))


@dataclass
class Command:
    """The last command of a kind.

    Attributes:
        time: at which it was given, s.
        angle: of the crank then, rad.
    """

    time: float = LONG_AGO
    angle: float = LONG_AGO

    def since(self, ramp: Ramp, time: float, angle: float) -> float:
        """Return the time, s, or angle, rad, since the command, as the ramp counts."""
        return angle - self.angle if ramp.over_angle else time - self.time

    def fraction(self, ramp: Ramp | None, time: float, angle: float) -> float:
        """Return a ramp's fraction at a time, s, and an angle, rad; 1 without a ramp."""
        return 1.0 if ramp is None else ramp.fraction(self.since(ramp, time, angle))


class Schedule:
    """Commands until now; a crank angle may command a stop.

    A start lets the brake go and then engages the clutch; a stop does the reverse.

    >>> schedule = Schedule(False, [0.1], [0.5], None, Ramp(0.0, 0.04), None, None, Ramp(0.0, 0.1))
    >>> schedule.accept(0.1, 0.0)
    >>> schedule.running, round(schedule.clutch(0.12, 0.0), 3), schedule.brake(0.12, 0.0)
    (True, 0.5, 0.0)

    Attributes:
        running: whether the last command was a start.
        starts: instants of commands to start, s.
        stops: instants of commands to stop, s.
    """

    def __init__(
        self,
        running: bool,
        starts: Sequence[float],
        stops: Sequence[float],
        stop_angle: float | None,
        clutch_on: Ramp | None,
        clutch_off: Ramp | None,
        brake_off: Ramp | None,
        brake_on: Ramp | None,
    ) -> None:
        """Begin with a press that runs or stands.

        Args:
            running: whether it runs.
            starts: instants of commands to start, s, increasing.
            stops: instants of commands to stop, s, increasing.
            stop_angle: of the crank, rad, at which a stop is commanded instead.
            clutch_on: of the clutch behind a start.
            clutch_off: falling torque of the clutch behind a stop.
            brake_off: falling torque of the brake behind a start.
            brake_on: of the brake behind a stop.
        """
        self.running, self.starts, self.stops = running, tuple(starts), tuple(stops)
        self._stop_angle = stop_angle
        self._clutch_on, self._clutch_off = clutch_on, clutch_off
        self._brake_off, self._brake_on = brake_off, brake_on
        self._start, self._stop = Command(), Command()

    def clutch(self, time: float, angle: float) -> float:
        """Return the fraction of the clutch's capacity at a time, s, and a crank angle, rad."""
        engaged = self._start.fraction(self._clutch_on, time, angle)
        if self.running:
            return engaged
        return min(engaged, 1.0 - self._stop.fraction(self._clutch_off, time, angle))

    def brake(self, time: float, angle: float) -> float:
        """Return the fraction of the brake's capacity at a time, s, and a crank angle, rad."""
        if self.running:
            return 1.0 - self._start.fraction(self._brake_off, time, angle)
        return self._stop.fraction(self._brake_on, time, angle)

    def is_engaged(self, time: float, angle: float) -> bool:
        """Return whether a start was commanded and the clutch has its whole capacity."""
        return self.running and self.clutch(time, angle) >= 1.0

    def done(self, time: float) -> bool:
        """Return whether a stop was commanded, and no start follows it."""
        return not self.running and not any(start > time for start in self.starts)

    def to_stop_angle(self, angle: float) -> float:
        """Return the crank angle until the commanded stop angle, rad; infinity without one."""
        if self._stop_angle is None or not self.running or self._stop.angle > LONG_AGO:
            return math.inf
        return self._stop_angle - angle

    def corner(self, time: float, angle: float, speed: float) -> float:
        """Return the next instant at which a fraction has a corner, s, or infinity.

        Args:
            time: s.
            angle: of the crank, rad.
            speed: of the crank, rad/s, from which corners over the angle are foreseen.
        """
        soonest = min((at for at in (*self.starts, *self.stops) if at > time), default=math.inf)
        remaining = self.to_stop_angle(angle)
        if speed > 0.0 and NEAR < remaining < math.inf:
            soonest = min(soonest, time + remaining / speed)
        start = (self._clutch_on, self._brake_off)
        stop = (self._clutch_on, self._clutch_off, self._brake_on)
        for ramp in start if self.running else stop:
            if ramp is None:
                continue
            command = self._start if ramp in start else self._stop
            since = command.since(ramp, time, angle)
            for edge in (ramp.begin, ramp.end):
                if not ramp.over_angle and edge > since:
                    soonest = min(soonest, command.time + edge)
                elif ramp.over_angle and speed > 0.0 and edge > since + NEAR:
                    soonest = min(soonest, time + (edge - since) / speed)
        return soonest

    def accept(self, time: float, angle: float) -> None:
        """Take the commands that are given until the end of a step, s, at a crank angle, rad."""
        if self.running and (
            self._is_commanded(self.stops, time) or self.to_stop_angle(angle) <= NEAR
        ):
            self.running, self._stop = False, Command(time, angle)
        elif not self.running and self._is_commanded(self.starts, time):
            self.running, self._start = True, Command(time, angle)

    def _is_commanded(self, commands: Sequence[float], time: float) -> bool:
        """Return whether a command has been given since the last one, until a time, s."""
        last = max(self._start.time, self._stop.time)
        return any(last < command <= time * (1.0 + 1e-12) for command in commands)

    def memory(self) -> list[float]:
        """Return the commands so far, as numbers."""
        commands = self._start.time, self._start.angle, self._stop.time, self._stop.angle
        return [float(self.running), *commands]

    def recall(self, memory: Sequence[float]) -> None:
        """Take over another's memory."""
        self.running = bool(memory[0])
        self._start, self._stop = Command(*memory[1:3]), Command(*memory[3:5])
