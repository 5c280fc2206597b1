"""Instants at which a run looks at its surroundings: the grid of a pre-step function, and
events."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.set_numbers import SetNumbers
from exu_press.integrate.settings import Task
from exu_press.integrate.start import start_rates
from exu_press.numerics.arrays import Array

__all__ = ["Event", "Sampling"]

NARROW = 1e-6
"""Over the largest step: to which an event is located."""

SAME_PLACE = 1e-9
"""Over the length: by which constraints may differ that are the same."""

LOOKS = 3
"""First calls on a grid, at which is seen whether a function moves constraints; later on, where a
number begins to change."""


class Sampling:
    """Calls a pre-step function on a grid, as a controller samples its plant.

    With fixed steps a user's pre-step function is called once a step, with the step's end. With a
    tolerance steps have other sizes and are repeated. So steps end on the grid, and the function is
    called once for each of its intervals, with the interval's end; what it sets of numbers goes
    over from one call to the next, or is held.

    A function of time that changes what constraints prescribe describes a motion. Its rates have to
    be known, as those of an offset's own function: it is called wherever constraints are asked. It
    is told by a call for an interval's beginning, which sets what was there.

    Attributes:
        calls: number of intervals that it was called for.
        called_at: where the interval begins that was last called for, s.
    """

    def __init__(
        self,
        task: Task,
        constraints: Constraints,
        numbers: SetNumbers,
        function: Any,
        period: float,
        *,
        hold: bool,
    ) -> None:
        """Sample a function with a period.

        Args:
            task: to be solved.
            constraints: of the system.
            numbers: that functions set.
            function: of the user's own, of the system and the time, s; or nothing.
            period: s; 0.0 calls the function before every step.
            hold: whether what the function sets is held until it is called again.
        """
        self._period = 0.0 if task.fixed else period
        self._start, self._end = task.start, task.end
        self._task, self._constraints = task, constraints
        self._mbs, self._function = task.problem.mbs, function
        self._called = -math.inf  # the end of the interval that was last called for, s
        self._looks = LOOKS if constraints.count and function and not task.fixed else 0
        self._same = SAME_PLACE * max(1.0, task.problem.length)
        self._changed = self._moves = False  # constraints, in a call; their motion, in all
        self._told = math.nan  # for which time it was last called, s
        self.calls, self.called_at = 0, math.nan
        self._numbers = None if hold or self._period <= 0.0 else numbers
        now, before = task.problem.current, task.problem.start
        # what the function may set, where a step starts from, and from where it is repeated
        self._states = [
            (now.positions, before.positions),
            (now.velocities, before.velocities),
            (now.first_order, before.first_order),
            (now.data, before.data),
        ]

    def next(self, time: float) -> float:
        """Return where the interval that a time (s) begins or lies in has its end, s."""
        if self._period <= 0.0:
            return math.inf
        number = math.floor((time - self._start) / self._period * (1.0 + 1e-12) + 1e-6) + 1
        return min(self._start + number * self._period, self._end)

    def look(self) -> bool:
        """Call the function for the run's start; return whether it has changed constraints."""
        if self._looks:
            self.call(self._start, self._start + self._task.largest)
        return self._changed

    def call(self, begin: float, end: float) -> bool:
        """Call the function for a step from `begin` to `end`, s, if it is due; return its word."""
        if self._period > 0.0:
            end = self.next(begin)
            if end == self._called:
                return True
            self._called, self.called_at = end, begin
            self.calls += 1
        looks = self._looks > 0
        before = self._constraints.violated() if looks else np.empty(0)
        if self._numbers is None:
            go_on = self._ask(end)
        else:
            go_on = self._numbers.call(lambda: self._ask(end), begin, end)
            if self._numbers.fresh and self._constraints.count and not looks:
                looks = True
                self._numbers.at(begin)
                before = self._constraints.violated()
                self._numbers.at(end)
        if looks:
            self._look(before, begin, end)
        self.set(begin)
        if self._period > 0.0:  # else it is called for each try anew
            for state, kept in self._states:
                kept[:] = state
        start_rates(self._task, begin)
        return go_on

    def _look(self, before: Array, begin: float, end: float) -> None:
        """See whether a call for an interval's end has changed constraints, and how.

        Args:
            before: by how much they were violated before it.
            begin: of the interval, s.
            end: of it, s.
        """
        constraints = self._constraints
        self._looks -= self._period > 0.0
        self._changed = constraints.switched()
        if self._changed or np.array_equal(before, constraints.violated()):
            return
        self._ask_again(begin)
        self._moves = np.allclose(before, constraints.violated(), rtol=0.0, atol=self._same)
        if self._moves:
            self._period, self._numbers, self._looks = 0.0, None, 0
        else:
            self._ask_again(end)
        self._changed = self._moves or self._numbers is not None
        if self._changed:
            constraints.prescribed_by(self.set)

    def _ask_again(self, time: float) -> None:
        """Call the function for a time (s) without a look at what it sets."""
        if self._numbers is None:
            self._ask(time)
        else:
            self._numbers.unseen(lambda: self._ask(time))

    def _ask(self, time: float) -> bool:
        self._told = time
        return bool(self._function(self._mbs, time))

    def set(self, time: float) -> None:
        """Set what is prescribed at a time, and numbers that go over; s."""
        if self._numbers is not None:
            self._numbers.at(time)
        elif self._moves and time != self._told:
            self._ask(time)


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
