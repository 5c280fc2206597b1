"""Local error of the bodies' velocities, from the accelerations at three or two instants."""

import math

from exu_press.integrate.newton_filter import NewtonFilter
from exu_press.integrate.task import Task

__all__ = ["PrescribedVelocityError", "VelocityError"]


class VelocityError:
    """Change of velocities by a step's local error, over its limit.

    It is h^3 |second derivative of the acceleration|, twelve times what generalized-alpha with the
    spectral radius 1 misses; the largest one of all bodies, in the kinetic norm. The derivative is
    the change of the accelerations' rate from step to step. Where that is too much, what counts is
    the part that Newton's matrix lets through (`NewtonFilter`).
    """

    def __init__(self, task: Task, newton_filter: NewtonFilter, allowed: float) -> None:
        """Follow the bodies of a task; allowed is an error in one step over the scale of speeds."""
        self._scales, self._filter, self._allowed = task.scales, newton_filter, allowed
        self._accelerations = task.system.current.accelerations
        self._start: list[float] = []  # accelerations at the beginning of the step
        self._now: list[float] = []
        self._rate_before: list[float] = []  # of them, in the step before; none in the first one
        self._rate: list[float] = []

    def restart(self) -> None:
        """Begin with the current state, as at the start."""
        self._start, self._rate_before = self._accelerations.tolist(), []
        self._filter.begin_step()

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state."""
        self._now = now = self._accelerations.tolist()
        start, rate_before = self._start, self._rate_before
        self._rate = rate = [(now[i] - start[i]) / step for i in range(len(now))]
        if rate_before:
            change = [rate[i] - rate_before[i] for i in range(len(rate))]
        else:
            relative = step * self._relative_rate()
            change = [relative * value for value in rate]
        error = self._of_change(change, step, 0.0)
        if error > 1.0:
            change = self._filter.filter_change(change)
            error = self._of_change(change, step, 0.0)
            if error > 1.0:
                error = self._of_change(change, step, self._filter.roundoff_of_constraints())
        return error

    def accept_step(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""
        self._start, self._rate_before = self._now, self._rate
        self._filter.begin_step()

    def _relative_rate(self) -> float:
        """Return the rate of the accelerations over them, as that of their unknown rate."""
        norm = self._scales.norm
        rate, largest = norm(self._rate), max(norm(self._now), norm(self._start))
        return rate / largest if rate > 0.0 else 0.0

    def _of_change(self, change: list[float], step: float, roundoff: float) -> float:
        """Return the error of a change of the accelerations' rate in a step (s), with rounding."""
        scales = self._scales
        limit = max(scales.roundoff, roundoff) / step
        return step * step * scales.norm(change) / max(self._allowed * scales.speed, limit)


class PrescribedVelocityError:
    """Error of constrained velocities at each instant over the tolerance: h^2 |da/dt| / 12.

    They follow from two positions. Errors that are not more than what alternates because positions
    are rounded do not count. For systems without clearance joints, whose impacts and films need
    finer steps, by far.
    """

    def __init__(self, task: Task) -> None:
        """Follow the bodies of a task."""
        self._scales, self._tolerance = task.scales, task.tolerance
        self._accelerations = task.system.current.accelerations
        self._start: list[float] = []  # at the beginning of the step
        self._now: list[float] = []

    def restart(self) -> None:
        """Begin with the current state, as at the start."""
        self._start = self._accelerations.tolist()

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state, as the step's cube."""
        self._now = now = self._accelerations.tolist()
        start, scales = self._start, self._scales
        change = scales.norm([now[i] - start[i] for i in range(len(now))])
        error = step * change / 12.0
        allowed = self._tolerance * scales.speed
        if error <= scales.roundoff / (6.0 * step) or allowed == 0.0:
            return 0.0
        return math.pow(error / allowed, 1.5)

    def accept_step(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""
        self._start = self._now
