"""Instants at which the velocity of a prescribed motion jumps."""

import math

import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.settings import SAME, Task
from exu_press.integrate.start import LOOK_AHEAD
from exu_press.numerics.arrays import Array

__all__ = ["VelocityJumps"]

SHORT = 0.1
"""Time within which velocities are told from positions, over the smallest step."""

JUMPS = 0.25
"""Change of velocities at a jump, over that within the step in which it is sought, or above."""


class VelocityJumps:
    """Lets steps end before and behind the instants at which prescribed velocities jump.

    As where the offset of a user function turns a corner. No step across is small enough: its
    accelerations are the jump over the step. So a step that fails is looked at: what constraints
    prescribe is asked for while nothing moves, and the instant is found by halving the step. So is
    the one before: with a jump in its last part a step may have been good enough. The next step
    ends before the jump, and one of about the smallest size leads across, behind which the
    motion begins anew (`fit_jump`). What changes within the smallest step is a jump as well. An
    offset that jumps itself, and not its velocity alone, is none.

    Attributes:
        crossed: whether the step last looked at is the short one across.
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Look at the constraints of a task."""
        problem = task.problem
        self._constraints, self._data, self._smallest = constraints, problem.data, task.smallest
        self._length, self._positions = problem.length or 1.0, problem.current.positions
        self._ahead = LOOK_AHEAD * task.largest
        self._short, self._rounding = SHORT * task.smallest, task.tuning.rounding
        self._behind = math.inf  # the jump last found, s
        # where the step last looked at begins, and the one before unless motion begins anew, s
        self._begin = self._last = task.start
        self.crossed = False

    @property
    def _sought(self) -> bool:
        return self._constraints.untold and self._constraints.count > 0

    def shorter(self, begin: float, step: float, *, failed: bool) -> float:
        """Return with which step to repeat one just tried, s, or 0.0 where there is no jump in it.

        Args:
            begin: of the step, s.
            step: s.
            failed: whether it is too long as it is; else only what is known is looked at.
        """
        self.crossed = False
        if not self._sought:
            return 0.0
        if begin != self._begin:
            self._last, self._begin = self._begin, begin
        if self._behind - begin > step * (1.0 + SAME):
            if not failed:
                return 0.0
            self._behind = self._found(self._last, begin + step)
        across = self._behind - begin
        if across == math.inf:
            return 0.0
        before = across - (1.0 + 2.0 * SHORT) * self._smallest
        if before >= self._smallest:
            return before
        across = max(across, self._smallest)
        self.crossed = step <= across * (1.0 + SAME)
        if not self.crossed:
            return across
        self._behind, self._begin = math.inf, begin + step
        self._last = self._begin
        return 0.0

    def ahead(self, time: float) -> float:
        """Return the time between instants at which constraints are asked for rates, s.

        Four of them from a time (s) on lie before the next jump.
        """
        if not self._sought:
            return self._ahead
        left = self._found(time, time + 4.0 * self._ahead) - time
        return min(self._ahead, max(0.25 * (left - 2.0 * self._smallest), self._smallest))

    def _found(self, begin: float, end: float) -> float:
        """Return an instant less than two smallest steps behind a jump, s, or infinity."""
        now = self._data.GetTime()
        below, above = self._prescribed(begin), self._prescribed(end)
        jump = change = _distance(above, below)
        length = float(np.abs(self._positions).max(initial=self._length))
        rounded = self._rounding * length / self._short
        while jump > rounded and end - begin > self._smallest * (1.0 + SAME):
            middle = 0.5 * (begin + end)
            between = self._prescribed(middle)
            if _distance(between, below) > _distance(above, between):
                end, above = middle, between
            else:
                begin, below = middle, between
            jump = _distance(above, below)
            if jump < JUMPS * change:  # it is smooth
                jump = 0.0
        self._data.SetTime(now)
        return end + self._short if jump > rounded else math.inf

    def _prescribed(self, time: float) -> Array:
        """Return the velocities that constraints prescribe at a time (s), while nothing moves."""
        constraints, behind = self._constraints, time + self._short
        self._data.SetTime(time)
        here = constraints.violated()
        self._data.SetTime(behind)
        rates = (constraints.violated() - here) / (behind - time)
        return np.where(constraints.of_velocities(), here, rates)


def _distance(one: Array, other: Array) -> float:
    return float(np.linalg.norm(one - other))
