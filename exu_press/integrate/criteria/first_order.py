"""First-order coordinates."""

from typing import Any

import numpy as np

from exu_press.integrate.criteria.share import ErrorPerStep
from exu_press.integrate.problem import Problem

__all__ = ["FirstOrderError"]


class FirstOrderError:
    """The error of the trapezoidal rule: h^3 |y'''| / 12, over each coordinate's largest value."""

    def __init__(self, problem: Problem, per_step: ErrorPerStep) -> None:
        """Take what is solved, and what one step may miss, relative."""
        self._current, self._per_step = problem.current, per_step
        self._before = np.array(problem.start.rates)
        self._largest = np.abs(problem.start.first_order)
        self._change: Any = None  # of the rate, over the step, in the step before
        self._tried: tuple[Any, Any] = self._before, None

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state."""
        rate = np.array(self._current.rates)
        change = (rate - self._before) / step
        self._tried = rate, change
        if self._change is None:
            return 0.0
        missed = step * step * np.abs(change - self._change) / 12.0
        largest = np.maximum(self._largest, step * np.abs(rate))
        counts = largest > 0.0
        relative = float((missed[counts] / largest[counts]).max(initial=0.0))
        return relative / self._per_step.relaxing(step)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._change = self._tried
        self._largest = np.maximum(self._largest, np.abs(self._current.first_order))
