"""The user's own functions of a system, called as Exudyn does, and put back after the run."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from exu_press.integrate.system import System

__all__ = ["UserFunctions", "user_function"]

NAMES = "PreStep", "PreNewtonResidual", "PostNewton", "PostStep"
"""Functions that Exudyn calls before a step, before and after Newton's method, after a step."""


class UserFunctions:
    """Functions of the user's own that Exudyn calls before, in and after every step.

    A pre-step function is called before every try of a step, with the step's end; with a period
    once for each of its intervals, with the interval's end, on which steps end.

    Attributes:
        before_step, before_residual: pre-step function and that before Newton's residual, or 0.
    """

    def __init__(self, system: System, start: float, period: float) -> None:
        """Look for the functions of a system; with a period of 0.0 every try of a step is one."""
        self._mbs, self._start, self._period, self._interval = system.mbs, start, period, -1
        self._functions = [user_function(self._mbs, name) for name in NAMES]
        self.before_step, self.before_residual, self._after_newton, self._after_step = (
            self._functions
        )
        current, at_start = system.current, system.start
        # what the pre-step function may set, where a step starts from and from where it is repeated
        self._states = [
            (current.positions, at_start.positions),
            (current.velocities, at_start.velocities),
            (current.first_order, at_start.first_order),
            (current.data, at_start.data),
        ]
        self._velocities = current.velocities

    @contextmanager
    def replaced_by(self, *functions: Callable[..., Any]) -> Iterator[None]:
        """Let Exudyn call other functions meanwhile, in the order of `NAMES`."""
        setters = [getattr(self._mbs, f"Set{name}UserFunction") for name in NAMES]
        for setter, function in zip(setters, functions, strict=True):
            setter(function)
        try:
            yield
        finally:
            for setter, function in zip(setters, self._functions, strict=True):
                setter(function)

    def with_samples(self, next_corner: Callable[[float], float]) -> Callable[[float], float]:
        """Return a function: time (s) -> the next corner or end of a period, s, or infinity."""
        if not self._period:
            return next_corner
        return lambda time: min(next_corner(time), self._end_of(self._interval_at(time)))

    def _interval_at(self, time: float) -> int:
        """Return the number of the interval that a time (s) begins or lies in."""
        return math.floor((time - self._start) / self._period + 1e-6)

    def _end_of(self, interval: int) -> float:
        """Return the end of an interval, s."""
        return self._start + (interval + 1) * self._period

    def call_before_step(self, begin: float, end: float) -> bool:
        """Call the pre-step function for a step from `begin` to `end`, s; return whether to go on.

        With a period, for the end of its interval, and only once.
        """
        if not self._period:
            return bool(self.before_step(self._mbs, end))
        interval = self._interval_at(begin)
        if interval == self._interval:
            return True
        self._interval = interval
        go_on = bool(self.before_step(self._mbs, self._end_of(interval)))
        for state, start in self._states:
            start[:] = state
        return go_on

    def combine(self, verdict: list[float], end: float) -> list[float]:
        """Return our verdict of a step that ends at a time, s, and the post-Newton function's."""
        if not self._after_newton:
            return verdict
        error, size = self._after_newton(self._mbs, end)
        sizes = [value for value in (verdict[1], size) if value > 0.0]
        return [max(verdict[0], error), min(sizes, default=-1.0)]

    def call_after_step(self, end: float) -> tuple[bool, bool]:
        """Call the post-step function; return whether to go on, and whether it set velocities."""
        if not self._after_step:
            return True, False
        velocities = self._velocities.tobytes()  # to compare bytes takes a tenth of the time
        go_on = bool(self._after_step(self._mbs, end))
        return go_on, self._velocities.tobytes() != velocities


def user_function(mbs: Any, name: str) -> Any:
    """Return a system's function of the user's own, by its name in `NAMES`; 0 where none is set."""
    item = getattr(mbs, f"Get{name}UserFunction")()
    return item["function"] if isinstance(item, dict) else 0
