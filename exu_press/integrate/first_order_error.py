"""The error of first-order coordinates in one step."""

from typing import Any

import exudyn as exu
import numpy as np

__all__ = ["FirstOrderError"]

CURRENT = exu.ConfigurationType.Current


class FirstOrderError:
    """What the trapezoidal rule misses: h^3 |y'''| / 12, over each coordinate's largest value."""

    def __init__(self, data: Any, share: float) -> None:
        """Take the system's data, and what one step may miss, relative."""
        self._data, self._share = data, share
        self._before = np.array(data.GetODE1Coordinates_t(CURRENT, False))
        self._largest = np.abs(np.array(data.GetODE1Coordinates(CURRENT, False)))
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
        return float((missed[counts] / largest[counts]).max(initial=0.0)) / self._share

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._change = self._tried
        values = np.abs(np.array(self._data.GetODE1Coordinates(CURRENT, False)))
        self._largest = np.maximum(self._largest, values)
