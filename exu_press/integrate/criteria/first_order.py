"""First-order coordinates."""

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
        self._before: list[float] = problem.start.rates.tolist()  # at the end of the last step
        self._largest = [abs(value) for value in problem.start.first_order.tolist()]
        self._change: list[float] = []  # of the rate, over the step, in the step before
        self._tried = self._before, self._change

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state."""
        rates: list[float] = self._current.rates.tolist()
        starts: list[float] = self._start.rates.tolist()
        changes = [(rates[i] - starts[i]) / step for i in range(len(rates))]
        self._tried = rates, changes
        if not self._change:
            return 0.0
        missed = 0.0  # over the largest value
        for i in range(len(rates)):
            rate, start, change = rates[i], starts[i], changes[i]
            turned = abs(change - self._change[i])
            if start != self._before[i]:
                turned = abs((rate - start) * change) / max(abs(rate), abs(start), TINY)
            largest = max(self._largest[i], step * abs(rate))
            if largest > 0.0:
                missed = max(missed, turned / largest)
        return step * step * missed / 12.0 / self._per_step.relaxing(step)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._change = self._tried
        values: list[float] = self._current.first_order.tolist()
        self._largest = [max(self._largest[i], abs(values[i])) for i in range(len(values))]
