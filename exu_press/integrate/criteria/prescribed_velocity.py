"""Error of velocities that constraints prescribe."""

import math

from exu_press.integrate.task import Task

__all__ = ["PrescribedVelocityError"]


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

    def accept(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""
        self._start = self._now
