"""Velocities of bodies, told from the accelerations at three instants."""

import math

from exu_press.integrate.criteria.share import ErrorPerStep
from exu_press.integrate.criteria.vibration import Quiet
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.settings import SolverTuning

__all__ = ["BodyError"]


class BodyError:
    """Tells from the accelerations at three instants what a step missed; 1 is what it may.

    h^3 |second derivative of the acceleration| / 6 against what velocities may be off by; the
    largest of all bodies, in the kinetic norm sqrt(|dx|^2 + (J/m) dphi^2).

    Attributes:
        change: of the accelerations' rate, by the step last tried, in SI over seconds.
        change_size: its largest kinetic norm, m/s^3.
        rate: of the accelerations' change, in the step last tried.
        noise: accelerations due to rounded positions, times the step's square, m.
        turning: angle by which velocities are to turn yet, rad: `Turning`.
        velocities: of all coordinates, where they are to turn by more than a radian.
        quiet: velocity amplitude of a vibration (`Quiet`) over what the run may miss; infinite
            where it is not known.
    """

    def __init__(
        self,
        accelerations: list[float],
        per_step: ErrorPerStep,
        scales: FoundScales,
        tuning: SolverTuning,
        noise: float,
        tolerance: float = 1.0,
    ) -> None:
        """Take the bodies and the scales.

        Args:
            accelerations: of all coordinates, at the beginning of the first step.
            per_step: allowed error of a velocity in one step, over the scale of speeds.
            scales: of the motion, which knows the bodies.
            tuning: numbers.
            noise: accelerations due to rounded positions, times the step's square, m.
            tolerance: of the run.
        """
        self._scales, self._per_step, self._tolerance = scales, per_step, tolerance
        self.noise = noise
        self._constant = tuning.velocity_constant
        self._before = self._now = accelerations
        self._rate_before: list[float] = []  # none before the first step
        self.rate: list[float] = []
        self.change: list[float] = []
        self.turning = 0.0
        self.velocities: list[float] = []
        self.change_size = 0.0  # its kinetic norm
        self._rate_size = -1.0  # that of the rate, once it was asked for
        self.vibration = Quiet()
        self.quiet = math.inf

    def tried(self, now: list[float], step: float) -> float:
        """Return the error of a step (s) that ends with these accelerations."""
        self._now, self._rate_size = now, -1.0
        before, last = self._before, self._rate_before
        self.rate = rate = [(now[i] - before[i]) / step for i in range(len(now))]
        if last:
            self.change = [rate[i] - last[i] for i in range(len(rate))]
        else:
            part = step * self._part_changed()
            self.change = [part * value for value in rate]
        self.change_size = self._scales.norm(self.change)
        self.quiet = math.inf
        if last and step < self._per_step.shortest:
            allowed = self._tolerance * self._scales.speed
            if allowed > 0.0:
                size = self._size_of_rate()
                self.quiet = self.vibration.amplitude(size, self.change_size, step) / allowed
        return self.error(self.change, step)

    def _size_of_rate(self) -> float:
        """Return the largest kinetic norm of the accelerations' rate in the step last tried."""
        if self._rate_size < 0.0:
            self._rate_size = self._scales.norm(self.rate)
        return self._rate_size

    def _part_changed(self) -> float:
        """Return the rate of the accelerations, in the first step, over them: at most one a step.

        What it changes by within the step is not known yet: as much as the accelerations do.
        """
        change, largest = self._size_of_rate(), self.largest()
        return change / largest if change > 0.0 else 0.0

    def error(self, change: list[float], step: float, left: float = 0.0) -> float:
        """Return the error that goes with a change of the accelerations' rate.

        Args:
            change: in SI over seconds.
            step: s.
            left: position error that its constraints leave, m.
        """
        noise = max(self.noise, left)
        missed = self._constant * step * step
        size = self.change_size if change is self.change else self._scales.norm(change)
        error = missed * size / self._limit(step, noise, 1.0)
        if self.turning > 1.0:
            along = self._scales.along(change, self.velocities)
            error = max(error, missed * along / self._limit(step, noise, self.turning))
        return error

    def of_positions(self, rate: list[float], step: float) -> float:
        """Return the error that goes with positions, where constraints take that of velocities.

        On a circle the third derivative of the velocity points to the centre, and the constraint
        takes it away; but positions miss h^3 |da/dt| / 6 along the circle, and the velocity there
        changes by its acceleration over its speed. What sets out from rest is on no circle yet.

        Args:
            rate: of the accelerations' change, in SI over seconds.
            step: s.
        """
        if self._scales.speed == 0.0:
            return 0.0
        missed = self._constant * step * step * step * self._scales.norm(rate)
        per_length = self.largest() / self._scales.speed
        return missed * per_length / self._limit(step, self.noise, 1.0)

    def _limit(self, step: float, noise: float, grows: float) -> float:
        """Return what a velocity may be off by in a step (s), m/s, if that grows by a factor."""
        return max(self.limit(step) / grows, self._constant * noise / step)

    def limit(self, step: float) -> float:
        """Return what a velocity may be off by in a step (s), m/s, but for rounding."""
        return self._per_step.at(step, self.quiet) * self._scales.speed

    def of_jump(self) -> float:
        """Return the largest change of an acceleration in the step last tried, m/s^2."""
        return self._scales.norm([a - b for a, b in zip(self._now, self._before, strict=True)])

    def largest(self) -> float:
        """Return the largest acceleration at the two ends of the step last tried, m/s^2."""
        return max(self._scales.norm(self._now), self._scales.norm(self._before))

    def offset(self, step: float) -> float:
        """Return what velocities that constraints prescribe are off by at each instant, m/s.

        They follow from two positions: h^2 |rate of the acceleration| / 12, if that is more than
        what alternates because positions are rounded.
        """
        off = step * step * self._size_of_rate() / 12.0
        return off if off > self.noise / (6.0 * step) else 0.0

    @property
    def begun(self) -> bool:
        """Return whether a step was accepted before the one last tried."""
        return bool(self._rate_before)

    def size(self) -> float:
        """Return the largest acceleration at the end of the step last tried, m/s^2."""
        return self._scales.norm(self._now)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._rate_before = self._now, self.rate
        self.vibration.accept()

    def start_again(self, accelerations: list[float]) -> None:
        """Be told of all accelerations with which the next step begins anew, as the first."""
        self._before, self._rate_before = accelerations, []

    def jumped(self) -> None:
        """Be told that accelerations have jumped in the accepted step."""
        self.vibration.forget()
