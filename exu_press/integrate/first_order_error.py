"""The error of first-order coordinates in one step, and the rates from which they start."""

from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.share import Share

__all__ = ["FirstOrderError", "start_rates"]

CURRENT = exu.ConfigurationType.Current
START = exu.ConfigurationType.StartOfStep


def start_rates(mbs: exu.MainSystem, solver: Any) -> None:
    """Set the rates of first-order coordinates at the start.

    Exudyn takes them for zero there, which leaves half of the first step's change in the result.
    """
    data: Any = mbs.systemData
    before, size = solver.GetODE2size(), data.ODE1Size()
    solver.ComputeODE1RHS(mbs)
    rates = np.array(solver.GetSystemResidual())[before : before + size]
    for configuration in (CURRENT, START):
        data.GetODE1Coordinates_t(configuration, False)[:] = rates


class FirstOrderError:
    """What the trapezoidal rule misses: h^3 |y'''| / 12, over each coordinate's largest value."""

    def __init__(self, data: Any, share: Share) -> None:
        """Take the system's data, and what one step may miss, relative."""
        self._data, self._share = data, share
        self._before = np.array(data.GetODE1Coordinates_t(START, False))
        self._largest = np.abs(np.array(data.GetODE1Coordinates(START, False)))
        self._change: Any = None  # of the rate, over the step, in the step before
        self._tried: tuple[Any, Any] = self._before, None

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state."""
        rate = np.array(self._data.GetODE1Coordinates_t(CURRENT, False))
        change = (rate - self._before) / step
        self._tried = rate, change
        if self._change is None:
            return 0.0
        missed = step * step * np.abs(change - self._change) / 12.0
        largest = np.maximum(self._largest, step * np.abs(rate))
        counts = largest > 0.0
        return float((missed[counts] / largest[counts]).max(initial=0.0)) / self._share.at(step)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._change = self._tried
        values = np.abs(np.array(self._data.GetODE1Coordinates(CURRENT, False)))
        self._largest = np.maximum(self._largest, values)
