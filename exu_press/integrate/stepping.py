"""Steps: their sizes, by a tolerance or fixed, and the events on which they end."""

import math
from collections.abc import Callable
from typing import Any

from exu_press.integrate.controller import Controller, LimitedGrowth
from exu_press.integrate.error import StepError
from exu_press.integrate.task import SAME, Task

__all__ = ["Event", "FixedSteps", "StepControl"]

EVENT_WIDTH = 1e-6
"""Over the largest step: within which an event is located."""


class StepControl:
    """Sets the step so that its error stays below 1.

    Attributes:
        error: of the last try.
    """

    def __init__(
        self,
        task: Task,
        estimate: StepError,
        next_corner: Callable[[float], float],
        controller: Controller | None = None,
    ) -> None:
        """Control the steps of a task, which end on corners, by a controller or `LimitedGrowth`."""
        self.error = 0.0
        self._controller = controller or LimitedGrowth(task.tuning)
        self._estimate, self._next_corner = estimate, next_corner
        self._end, self._smallest, self._largest = task.end, task.smallest, task.largest
        self._no_shorter = task.no_shorter
        self._step = self._first = task.first
        self._asked = 0.0  # what Exudyn is to try, s; shorter than the step, up to a corner

    def restart(self) -> None:
        """Go on with the first step's size, as the motion begins anew."""
        self._estimate.restart()
        self._step = self._first

    def shorter(self, step: float) -> float:
        """Return with which step to repeat one just tried, s, or 0.0 where it is good enough."""
        error = self._estimate(step)
        if error > 1.0 and step <= self._no_shorter:
            error = min(error, self._estimate.of_discontinuity(step))
        self.error = error
        if error <= 1.0:
            return 0.0
        self._step = self._asked = step * self._controller.repeat_factor(error)
        return self._step

    def accept_step(self, step: float, *, at_event: bool = False) -> None:
        """Take the step last tried as done, shortened by an event or not; choose the next ones."""
        self._estimate.accept_step()
        if not at_event and 0.5 * self._step <= step < (1.0 - SAME) * self._asked:
            self._step = step  # shortened by Exudyn
        ratio = step / self._step
        self._step *= self._controller.growth_factor(self.error / (ratio * ratio * ratio))

    def next_step(self, time: float) -> float:
        """Return the step from a time on, s; it ends exactly on corners and the end.

        Two steps of one size lead to the next corner, where one would not get there. A corner
        that only rounding tells from the end is the end.
        """
        self._step = step = min(self._step, self._largest)
        remaining, corner = self._end - time, self._next_corner(time)
        if self._smallest < corner - time < remaining - self._smallest:
            remaining = corner - time
        if remaining > self._smallest and step > 0.5 * remaining:
            step = remaining if step >= remaining else 0.5 * remaining
        self._asked = step
        return step


class FixedSteps:
    """Keeps steps of one size on their grid t = n h.

    The first one is taken in pieces that double where a film takes up its load; and so is what is
    left of a step that Exudyn had to halve.

    Attributes:
        error: none that is known.
    """

    def __init__(self, task: Task) -> None:
        """Take the steps of a task."""
        self.error = 0.0
        self._step, self._start = task.largest, task.start
        self._size = self._next = task.first

    def restart(self) -> None:
        """Keep the grid."""

    def shorter(self, step: float) -> float:
        """Return 0.0: every step is good enough."""
        return 0.0

    def accept_step(self, step: float, *, at_event: bool = False) -> None:
        """Take a step (s) as done."""
        halved = step < 0.99 * self._next
        self._size = step if halved else min(self._step, 2.0 * self._size)

    def next_step(self, time: float) -> float:
        """Return the step from a time on, s."""
        h, gone = self._step, time - self._start
        to_grid = (math.floor(gone / h * (1.0 + 1e-9)) + 1) * h - gone
        on_grid = to_grid > (1.0 - 1e-9) * h
        self._next = self._size if on_grid else min(to_grid, self._size)
        return self._next


class Event:
    """Ends a step right behind the instant at which a function changes its sign.

    A step in which it does is repeated up to where the secant has its zero, and a little further.
    One that then falls short is kept, and the next one begins that much nearer.

    Attributes:
        passed: whether the step last tried ends behind an event.
    """

    def __init__(self, task: Task, function: Callable[[Any, float], float]) -> None:
        """Look for the zeros of a function of the system and the time, s."""
        self._mbs, self._function = task.system.mbs, function
        self._narrow = max(EVENT_WIDTH * task.largest, 2.0 * task.smallest)
        self._start = self._now = 0.0  # at the beginning and at the end of the step last tried
        self.passed = False

    def begin(self, time: float) -> None:
        """Look at the current state, from which the run starts at a time, s."""
        self._start = self._function(self._mbs, time)

    def shorter(self, step: float, end: float) -> float:
        """Return with which step to repeat one (s) that ends at `end`, s, or 0.0 to keep it."""
        self._now = now = self._function(self._mbs, end)
        self.passed = now * self._start < 0.0
        if not self.passed:
            return 0.0
        fraction = self._start / (self._start - now)
        if (1.0 - fraction) * step <= self._narrow:
            return 0.0
        return min(fraction * step + 0.5 * self._narrow, 0.9 * step)

    def accept_step(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._start = self._now or self._start
