"""Steps that follow a tolerance, on Exudyn's own integrator.

No implicit integrator of Exudyn controls its error, but after each Newton solve it asks a user
function for an error and a step to repeat with, and before each step it lets its step be set.
"""

import math
from collections.abc import Callable

import exudyn as exu

from exu_press.integrate.error import StepError

__all__ = ["StepControl"]

GROW_BELOW = 0.15
"""Error below which steps are doubled. Doubling makes it 4 times larger, 0.6; the reserve is for
what a shorter step inherits: the velocities' constraint error of a long step, which then shows in
the accelerations."""

CALM_STEPS = 2
"""Accepted steps between two doublings: a change of step rings for a few steps."""

SMALLEST_CUT = 2.0**-5
"""How far one rejection may shorten a step."""

INHERITED = 3.0
"""An error up to this that does not shrink with the step is inherited, not made by the step."""


class StepControl:
    """Halves, keeps and doubles the step so that the error stays below 1.

    Steps are changed by powers of two, and not often, as accelerations ring after a change.

    Attributes:
        rejected: number of steps repeated for their error.
        smallest: the smallest step that was accepted, s.
    """

    def __init__(
        self,
        error: StepError,
        *,
        duration: float,
        smallest: float,
        largest: float,
        next_corner: Callable[[float], float],
    ) -> None:
        """Control the steps of a run from 0 to `duration`, s.

        Args:
            error: estimates the error of a step.
            duration: end of the run, s.
            smallest: below it the run is given up, s.
            largest: s; also the mean step of Exudyn's own settings.
            next_corner: time -> the next instant at which a load has a corner, s, or infinity.
        """
        self.rejected = 0
        self.error = 0.0
        self._estimate = error
        self._duration, self._smallest, self._largest = duration, smallest, largest
        self._next_corner = next_corner
        self._step = min(largest, max(largest / 64.0, 64.0 * smallest))
        self._calm = 0
        self._tried = (0.0, 0.0)  # step and error of the last rejection

    def attach(self, mbs: exu.MainSystem) -> None:
        """Let Exudyn ask this control after every Newton solve and every step."""
        mbs.SetPostNewtonUserFunction(self._after_newton)
        mbs.SetPostStepUserFunction(self._after_step)

    def _after_newton(self, mbs: exu.MainSystem, time: float) -> list[float]:
        """Return [0, -1] to accept the step, or [2, shorter step] to have it repeated."""
        start = mbs.systemData.GetTime(exu.ConfigurationType.StartOfStep)
        step = time - start
        if step <= 0.0:
            return [0.0, -1.0]
        self.error = error = self._estimate(step)
        if error > 1.0 and not self._inherited(step, error):
            self.rejected += 1
            self._calm = 0
            self._tried = step, error
            cut = max(SMALLEST_CUT, 0.5 ** math.ceil(0.5 * math.log2(error / 0.5)))
            self._step = step * cut
            return [2.0, self._step]
        self._estimate.accept(step)
        self._calm += 1
        if step >= 0.5 * self._step:  # else it was cut short by a corner or by the end
            self._step = step
        if error < GROW_BELOW and self._calm > CALM_STEPS:
            self._step *= 2.0
            self._calm = 0
        return [0.0, -1.0]

    def _inherited(self, step: float, error: float) -> bool:
        """Return whether the error is as large as that of the longer step rejected last."""
        rejected_step, rejected_error = self._tried
        return error < INHERITED and step < 0.75 * rejected_step and error > 0.75 * rejected_error

    def _after_step(self, mbs: exu.MainSystem, time: float) -> bool:
        """Set the next step; corners and the end are stepped on exactly."""
        self._step = step = min(self._step, self._largest)
        for stop in (self._next_corner(time), self._duration):
            left = stop - time
            if left <= self._smallest:
                continue
            if step >= left:
                step = left
            elif step > 0.5 * left:
                step = 0.5 * left
        mbs.sys["dynamicSolver"].it.currentStepSize = step
        return True
