"""Accelerations between two instants, which the forces of constraints follow."""

from exu_press.integrate.criteria.bodies import BodyError
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.settings import SAME

__all__ = ["Curvature"]


class Curvature:
    """Deviation of accelerations from a line between a step's ends, over its limit.

    h^2 |second derivative of the acceleration| / 8 against a tolerance of the largest one so far,
    or against what changes no velocity within the step by more than the absolute tolerance. What
    alternates from step to step is none of the motion's, and a jump does not shrink with the step:
    what two steps of one size have in common counts, and in a step of another size what the last
    two had.
    """

    def __init__(
        self,
        bodies: BodyError,
        scales: FoundScales,
        noise: float,
        tolerance: float,
        absolute: float = 0.0,
    ) -> None:
        """Follow the accelerations of bodies.

        Args:
            bodies: whose accelerations they are.
            scales: of the motion.
            noise: accelerations due to rounded positions, times the step's square, m.
            tolerance: of the run.
            absolute: errors of velocities below it do not count, m/s.
        """
        self._bodies, self._scales, self._noise = bodies, scales, noise
        self._tolerance, self._absolute = tolerance, absolute
        self._bend: list[float] = []  # second derivative of the accelerations
        self._bend_before: list[float] = []
        self._size = self._size_before = 0.0  # of the bend, its largest norm
        self._common = self._common_before = 0.0  # of the bends of two steps, likewise
        self._step = self._step_before = 0.0
        self._most = bodies.size()  # so far, m/s^2

    def error(self, step: float) -> float:
        """Return it for the step (s) last tried."""
        self._bend = bend = [value / step for value in self._bodies.change]
        self._size, self._step = self._scales.norm(bend), step
        self._common = self._common_before
        if self._bend_before and abs(step - self._step_before) < SAME * step:
            mean = [0.5 * (a + b) for a, b in zip(bend, self._bend_before, strict=True)]
            smaller = min(self._size, self._size_before)
            self._common = min(self._scales.norm(mean), 3.0 * smaller)
        off = 0.125 * step * step * self._common
        allowed = max(self._tolerance * self._most, self._absolute / step)
        return off / max(allowed, self._noise / (step * step))

    def accept(self) -> None:
        """Remember the accepted step, before the bodies' errors do."""
        if self._bend:  # they are asked for
            self._step_before, self._common_before = self._step, self._common
            self._size_before = self._size
            self._bend_before = self._bend if self._bodies.begun else []
            self._most = max(self._most, self._bodies.size())
