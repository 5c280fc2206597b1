"""Instants at which a run looks at its surroundings: the grid of a pre-step function, and
events."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.settings import Task
from exu_press.integrate.start import start_rates

__all__ = ["Event", "Sampling"]

NARROW = 1e-6
"""Over the largest step: to which an event is located."""

LOOKS = 3
"""Calls of a pre-step function, at the first of which is seen whether it moves constraints."""


class Sampling:
    """Calls a pre-step function on a grid, as a controller samples its plant.

    With fixed steps a user's pre-step function is called once a step, with the step's end, and what
    it sets is held until the next one. With a tolerance steps have other sizes and are repeated. So
    steps end on the grid, and the function is called once for each of its intervals, with the
    interval's end. A function that changes what constraints prescribe describes a motion instead of
    a controller: held for several steps it would be a staircase. It is called before every step.

    Attributes:
        calls: number of intervals that it was called for.
        called_at: where the interval begins that was last called for, s.
        switched: whether the function has switched constraints on or off in a call looked at.
    """

    def __init__(self, task: Task, constraints: Constraints, period: float) -> None:
        """Sample with a period, s; 0.0 calls the function before every step."""
        self._start, self._end, self._period = task.start, task.end, period
        self._task, self._constraints = task, constraints
        self._called = -math.inf  # the end of the interval that was last called for, s
        self._looks = LOOKS if constraints.count else 0
        self.calls, self.called_at, self.switched = 0, math.nan, False
        now, before = task.problem.current, task.problem.start
        # what the function may set, where a step starts from, and from where it is repeated
        self._states = [
            (now.positions, before.positions),
            (now.velocities, before.velocities),
            (now.first_order, before.first_order),
            (now.data, before.data),
        ]

    @property
    def on_grid(self) -> bool:
        """Return whether a function is called once a period, and not before every step."""
        return self._period > 0.0

    def next(self, time: float) -> float:
        """Return where the interval that a time (s) begins or lies in has its end, s."""
        if self._period <= 0.0:
            return math.inf
        number = math.floor((time - self._start) / self._period * (1.0 + 1e-12) + 1e-6) + 1
        return min(self._start + number * self._period, self._end)

    def call(self, function: Any, mbs: Any, begin: float, end: float) -> bool:
        """Call a function before a step from `begin` to `end`, s, if it is due; return its word."""
        if self._period > 0.0:
            end = self.next(begin)
            if end == self._called:
                return True
            self._called, self.called_at = end, begin
            self.calls += 1
        looks = self._looks and self._period > 0.0
        before = self._constraints.violated() if looks else np.empty(0)
        go_on = bool(function(mbs, end))
        if looks:
            self._looks -= 1
            self.switched = self._constraints.switched()
            if not (self.switched or np.array_equal(before, self._constraints.violated())):
                self._period = 0.0
        if self._period > 0.0:  # else it is called for each try anew
            for state, kept in self._states:
                kept[:] = state
        start_rates(self._task, begin)
        return go_on


class Event:
    """Ends a step right behind the instant at which a function changes its sign.

    A step in which it does is repeated up to where the secant has its zero, and a little further.
    One that then falls short is kept, and the next one begins that much nearer.

    Attributes:
        passed: whether the step last tried ends behind an event.
    """

    def __init__(self, task: Task, function: Callable[[Any, float], float] | None) -> None:
        """Look for the zeros of a function of the system and the time, s."""
        self._mbs, self._function = task.problem.mbs, function
        self._narrow = max(NARROW * task.largest, 2.0 * task.smallest)
        self._before = self._now = 0.0  # at the beginning and at the end of the step last tried
        self.passed = False

    def begin(self, time: float) -> None:
        """Look at the current state, from which the run starts at a time, s."""
        if self._function is not None:
            self._before = self._function(self._mbs, time)

    def shorter(self, step: float, end: float) -> float:
        """Return with which step to repeat one (s) that ends at `end`, s, or 0.0 to keep it."""
        if self._function is None:
            return 0.0
        self._now = now = self._function(self._mbs, end)
        self.passed = now * self._before < 0.0
        if not self.passed:
            return 0.0
        part = self._before / (self._before - now)
        if (1.0 - part) * step <= self._narrow:
            return 0.0
        return min(part * step + 0.5 * self._narrow, 0.9 * step)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before = self._now or self._before
