"""First-order coordinates."""

from typing import Any

import numpy as np

from exu_press.integrate.criteria.share import ErrorPerStep
from exu_press.integrate.problem import Problem

__all__ = ["FirstOrderError"]

TINY = 1e-300
"""In the place of zero, where it divides."""


class FirstOrderError:
    """The error of the trapezoidal rule: h^3 |y'''| / 12, over each coordinate's largest value.

    Where a rate jumps between two steps, as of a pressure whose valve is set, they do not tell
    y''': in the step y'' is taken to change by the part by which the rate does.
    """

    def __init__(self, problem: Problem, per_step: ErrorPerStep) -> None:
        """Take what is solved, and what one step may miss, relative."""
        self._current, self._start, self._per_step = problem.current, problem.start, per_step
        self._before = np.array(problem.start.rates)  # at the end of the last step
        self._largest = np.abs(problem.start.first_order)
        self._change: Any = None  # of the rate, over the step, in the step before
        self._tried: tuple[Any, Any] = self._before, None

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state."""
        rate, before = np.array(self._current.rates), self._start.rates
        change = (rate - before) / step
        self._tried = rate, change
        if self._change is None:
            return 0.0
        turned = np.abs(change - self._change)
        jumped = before != self._before
        if jumped.any():
            part = np.abs(rate - before) / np.maximum(
                np.maximum(np.abs(rate), np.abs(before)), TINY
            )
            turned = np.where(jumped, part * np.abs(change), turned)
        missed = step * step * turned / 12.0
        largest = np.maximum(self._largest, step * np.abs(rate))
        counts = largest > 0.0
        relative = float((missed[counts] / largest[counts]).max(initial=0.0))
        return relative / self._per_step.relaxing(step)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._change = self._tried
        self._largest = np.maximum(self._largest, np.abs(self._current.first_order))
