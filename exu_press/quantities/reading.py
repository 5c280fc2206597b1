"""A run as quantities read it; what several of them need is computed once."""

from collections.abc import Callable
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from exu_press.mechanism import Mechanism
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import integral
from exu_press.quantities.alternating import Peaks, peaks
from exu_press.quantities.dead_centre import DeadCentre, bottom_dead_centres
from exu_press.result import Result
from exu_press.result.windows import NEARLY, settled_part, whole_revolutions
from exu_press.scene import mechanism_of

__all__ = ["Reading"]

Read = TypeVar("Read")


class Reading:
    """A run and its readings, each computed once.

    Attributes:
        run: all of it.
        result: its settled part, from which quantities are read.
    """

    def __init__(self, run: Result) -> None:
        """Take the settled part of a run."""
        self.run = run
        self.result = settled_part(run)
        self._computed: dict[Any, Any] = {}
        self._peaks: dict[str, Peaks] = {}

    def __getitem__(self, channel: str) -> Array:
        return self.result[channel]

    def channel(self, name: str) -> Array | None:
        """Return the values of a channel, None where the run does not have it."""
        channel = self.result.channels.get(name)
        return None if channel is None else channel.values

    def peaks(self, name: str) -> Peaks:
        """Return the peaks of a channel that follows from accelerations."""
        if name not in self._peaks:
            self._peaks[name] = peaks(self.time, self[name])
        return self._peaks[name]

    def peak(self, name: str) -> float | None:
        """Return the largest magnitude of such a channel, None where the run does not have it."""
        return None if self.channel(name) is None else self.peaks(name).length

    def at_most_peak(self, mean: float | None, channel: str, column: int = 0) -> float | None:
        """Return the mean of a channel over a window, which may be shorter than steps.

        It is no larger than the peak, which has no oscillation from step to step.
        """
        return None if mean is None else min(mean, float(self.peaks(channel).columns[column]))

    def once(self, read: Callable[["Reading"], Read]) -> Read:
        """Return a function of this reading, which is called once."""
        if read not in self._computed:
            self._computed[read] = read(self)
        value: Read = self._computed[read]
        return value

    @property
    def time(self) -> Array:
        """Instants, (n,), s."""
        return self.result.time

    @cached_property
    def mechanism(self) -> Mechanism:
        """The mechanism of the scene."""
        return mechanism_of(self.result.scene)

    @property
    def starts_or_stops(self) -> bool:
        """Whether the press starts or stops within the run."""
        motor = self.result.scene.drive
        return motor is not None and motor.has_schedule

    @property
    def span(self) -> tuple[float, float]:
        """Return the first and the last revolution that are read."""
        if "figures" in self.run.info:
            read_from = self.run.info["figures"]["read_from"]
            return read_from["from"], read_from["to"]
        first, *_, last = self["crank_angle"] if len(self.time) > 1 else [0.0, 0.0]
        begin = self.run.scene.start_angle
        return self._turns(first - begin), self._turns(last - begin)

    @staticmethod
    def _turns(angle: float) -> float:
        """Return the revolutions of an angle, rad, without the rounding of its sums."""
        return round(float(angle) / (2 * np.pi), 12) + 0.0

    @cached_property
    def dead_centres(self) -> list[DeadCentre]:
        """The bottom dead centre of every stroke."""
        return bottom_dead_centres(self.result)

    @cached_property
    def revolutions(self) -> int:
        """Number of whole revolutions at the end.

        0 of a press that starts or stops: its mean is not that of operation.
        """
        if self.starts_or_stops:
            return 0
        angle = self["crank_angle"]
        return whole_revolutions(float(angle[-1] - angle[0]) / (2.0 * np.pi))

    @cached_property
    def whole(self) -> float | None:
        """Begin of the whole revolutions at the end, s, or None."""
        if not self.revolutions:
            return None
        angle = self["crank_angle"]
        begin = angle[-1] - 2.0 * np.pi * self.revolutions
        if begin - angle[0] <= 2.0 * np.pi * NEARLY:
            return float(self.time[0])
        return float(np.interp(begin, angle, self.time))

    @cached_property
    def speed_from(self) -> float | None:
        """Begin of the revolutions from which the crank's speed is read, s, or None.

        They are the last whole ones; where a motor lags in a run of one, a nominal one.
        """
        period = 60.0 / self.result.scene.speed_rpm
        if self.starts_or_stops:
            return None
        duration = float(self.time[-1] - self.time[0])
        if self.whole is None and whole_revolutions(duration / period):
            return float(max(self.time[-1] - period, self.time[0]))
        return self.whole

    def mean(self, values: Array) -> float | None:
        """Return the mean of a channel (n,) over the last whole revolutions, None without one."""
        return self.rate(integral(self.time, values))

    def rate(self, amount: Array) -> float | None:
        """Return the mean rate of change of a channel (n,) over the last whole revolutions.

        None without one: over a fraction of a revolution the stored energy would count.
        """
        if self.whole is None:
            return None
        return self._change(amount, self.whole) / float(self.time[-1] - self.whole)

    def per_stroke(self, amount: Array) -> float | None:
        """Return the mean change of a channel (n,) in a revolution, over the last whole ones."""
        return None if self.whole is None else self._change(amount, self.whole) / self.revolutions

    def _change(self, amount: Array, begin: float) -> float:
        """Return by how much a channel (n,) changes from an instant, s, to the end."""
        return float(amount[-1] - np.interp(begin, self.time, amount))
