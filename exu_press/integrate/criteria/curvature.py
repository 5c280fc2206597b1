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
    what two steps of one size have in common counts, their mean, unless they alternate, so that
    both together are less than the larger one. In a step of another size, or a repeated one, what
    the last two had counts. Of a vibration that may be missed (`Quiet`) accelerations may be off by
    as much more as its velocities are below what the run may miss.
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
        self._change_before: list[float] = []  # of the accelerations' rate
        self._size = self._size_before = 0.0  # of their second derivative, its largest norm
        self._common = 0.0  # of that of two steps, likewise
        self._step = self._step_before = 0.0
        self._most = bodies.size()  # so far, m/s^2

    def error(self, step: float) -> float:
        """Return it for the step (s) last tried."""
        change, before = self._bodies.change, self._change_before
        self._size, self._step = self._bodies.change_size / step, step
        if before and abs(step - self._step_before) < SAME * step:
            both = self._scales.norm([change[i] + before[i] for i in range(len(change))]) / step
            less, larger = sorted((self._size, self._size_before))
            self._common = min(0.5 * both, 3.0 * less) if both >= larger else 0.0
        off = 0.125 * step * step * self._common * min(1.0, self._bodies.quiet)
        allowed = max(self._tolerance * self._most, self._absolute / step)
        return off / max(allowed, self._noise / (step * step))

    def accept(self) -> None:
        """Remember the accepted step, before the bodies' errors do."""
        if self._step > 0.0:  # they are asked for
            self._step_before, self._size_before = self._step, self._size
            self._change_before = self._bodies.change if self._bodies.begun else []
            self._most = max(self._most, self._bodies.size())

    def start_again(self) -> None:
        """Be told that the motion begins anew: what was before it is no part of a curve."""
        self._change_before, self._common = [], 0.0
