"""Steps that follow a tolerance, on Exudyn's own integrator.

No implicit integrator of Exudyn controls its error, but after each Newton solve it asks a user
function for an error and a step to repeat with, and before each step it lets its step be set.
"""

import math
from collections.abc import Callable
from typing import Any

import exudyn as exu

from exu_press.integrate.constraints import StepChange
from exu_press.integrate.error import StepError
from exu_press.integrate.newton import Newton
from exu_press.integrate.settings import Tuning

__all__ = ["FixedSteps", "StepControl"]

START = exu.ConfigurationType.StartOfStep

ORDER = 3
"""Power of the step with which its error goes."""


class StepControl:
    """Sets the step so that its error stays below 1.

    Attributes:
        error: of the last try.
    """

    def __init__(
        self,
        error: StepError,
        solver: Any,
        newton: Newton,
        *,
        end: float,
        smallest: float,
        largest: float,
        first: float,
        tuning: Tuning,
        film_start: StepChange | None,
        next_corner: Callable[[float], float],
    ) -> None:
        """Control the steps of a run to `end`, s.

        Args:
            error: estimates the error of a step.
            solver: an exu.MainSolverImplicitSecondOrder, whose steps these are.
            newton: is told of every step's end.
            end: of the run, s.
            smallest: below it the run is given up, s.
            largest: s.
            first: s.
            tuning: numbers.
            film_start: starts the first step over where a film takes up its load.
            next_corner: time -> the next instant at which a load has a corner, s, or infinity.
        """
        self.error = 0.0
        self._estimate = error
        self._end, self._smallest, self._largest = end, smallest, largest
        self._next_corner = next_corner
        self._safety = tuning.safety
        self._factor_max, self._factor_min = tuning.factor_max, tuning.factor_min
        self._film_start = film_start
        self._iteration: Any = solver.it  # holds the step
        self._newton, self._data = newton, newton.data
        self._step = max(first, smallest)
        self._tried = 0.0  # size of the step last tried, s

    def after_newton(self, time: float) -> list[float]:
        """Return [0, -1] to accept the step, or [2, shorter step] to have it repeated."""
        step = time - self._data.GetTime(START)
        if step <= 0.0:
            return [0.0, -1.0]
        if self._film_start is not None and self._film_start.start_over(time):
            return [2.0, step]
        error = self._estimate(step)
        if error > 1.0 and step <= self._smallest * (1.0 + 1e-9):
            error = min(error, self._estimate.of_jump(step))
        self.error = error
        if not error <= 1.0:
            self._step = step * max(self._factor_min, self._factor(error))
            return [2.0, self._step]
        self._tried = step
        return [0.0, -1.0]

    def _accept(self, time: float) -> None:
        """Take the step last tried as done; choose the size of those to come."""
        step = self._tried
        self._estimate.accept()
        self._newton.stepped(time, self._estimate.accelerations)
        if step >= 0.5 * self._step:  # else it was cut short, by what it ends on
            self._step = step
        if self._factor(self.error) > self._factor_max:
            self._step *= self._factor_max

    def after_step(self, time: float) -> list[float]:
        """Set the next step; it ends exactly on corners and the end.

        Returns:
            The accelerations at the end of the last step.
        """
        if self._tried > 0.0:
            self._accept(time)
        self._step = step = min(self._step, self._largest)
        for stop in (self._next_corner(time), self._end):
            left = stop - time
            if left <= self._smallest:
                continue
            if step >= left:
                step = left
            elif step > 0.5 * left:
                step = 0.5 * left
        self._iteration.currentStepSize = step
        return self._estimate.accelerations or self._newton.now

    def _factor(self, error: float) -> float:
        """Return by how much a step may be changed for its error; to nothing where that is nan."""
        if error != error:
            return 0.0
        return math.pow(self._safety / error, 1.0 / ORDER) if error > 0.0 else math.inf


class FixedSteps:
    """Keeps steps of one size on their grid t = n h.

    The first one may be taken in pieces that double, so that a film takes up its load; and after a
    step that Exudyn had to halve, steps double back to the grid.

    Attributes:
        error: none that is known.
    """

    def __init__(
        self,
        step: float,
        solver: Any,
        newton: Newton,
        *,
        start: float,
        first: float,
        film_start: StepChange | None,
    ) -> None:
        """Take steps of a size, s.

        Args:
            step: s.
            solver: an exu.MainSolverImplicitSecondOrder, whose steps these are.
            newton: is told of every step's end.
            start: of the run, s.
            first: step, s.
            film_start: starts the first one over.
        """
        self.error = 0.0
        self._step = step
        self._film_start = film_start
        self._iteration: Any = solver.it  # holds the step
        self._newton, self._data = newton, newton.data
        self._size = self._next = first
        self._start = self._time = start

    def after_newton(self, time: float) -> list[float]:
        """Return [0, -1] to accept the step, or [2, step] to have the first one repeated."""
        if self._film_start is None or time <= self._start or not self._film_start.start_over(time):
            return [0.0, -1.0]
        return [2.0, time - self._start]

    def after_step(self, time: float) -> list[float]:
        """Set the next step; return the accelerations at the end of this one."""
        h, done, before = self._step, time - self._time, self._next
        now: list[float] = self._data.GetODE2Coordinates_tt(
            exu.ConfigurationType.Current, False
        ).tolist()
        if done > 0.0:
            self._newton.stepped(time, now)
            halved = done < 0.99 * before
            self._size = done if halved else min(h, 2.0 * self._size)
            gone = time - self._start
            to_grid = (math.floor(gone / h * (1.0 + 1e-9)) + 1) * h - gone
            on_grid = to_grid > (1.0 - 1e-9) * h
            self._next = self._size if on_grid else min(to_grid, self._size)
            if not halved and self._next == before:
                self._time = time
                return now
        self._time = time
        self._iteration.currentStepSize = self._next
        return now
