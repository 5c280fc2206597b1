"""Controllers: by how much a step is changed for its error. A run takes any one of their kind."""

import math
from typing import Protocol

from exu_press.integrate.settings import SolverTuning

__all__ = ["ORDER", "Controller", "LimitedGrowth"]

ORDER = 3
"""Power of the step with which its error goes."""


SHORTENED = 0.05
"""Least ratio by which a failed step is shortened."""


class Controller(Protocol):
    """Changes steps for their errors; 1 is the largest allowed one."""

    def repeated(self, error: float) -> float:
        """Return the factor with which to repeat a step whose error is above 1, or no number."""

    def continued(self, error: float) -> float:
        """Return the factor for the steps after one whose error is at most 1."""


class LimitedGrowth:
    """The elementary controller h_new = h (safety / error)^(1/3), with a dead zone.

    Steps stay as long as they are until they may grow by `factor_max`, and grow by that alone: what
    an impact leaves decides about the next one, and steps that grew by half passed over it. Where
    there are no impacts, the first steps, short by guess, grow by `factor_max_at_start` until an
    error limits one (E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential
    Equations I, II.4).
    """

    def __init__(self, tuning: SolverTuning, *, impacts: bool = True) -> None:
        """Take its numbers `safety`, `factor_max` and, without impacts, `factor_max_at_start`."""
        self._safety, self._factor_max = tuning.safety, tuning.factor_max
        self._limit = self._factor_max if impacts else tuning.factor_max_at_start

    def repeated(self, error: float) -> float:
        """Return the factor with which to repeat a step whose error is above 1, or no number."""
        self._limit = self._factor_max
        return max(SHORTENED, self._factor(error))

    def continued(self, error: float) -> float:
        """Return the factor for the steps after one whose error is at most 1."""
        factor = self._factor(error)
        if factor > self._factor_max:
            return min(factor, self._limit)
        self._limit = self._factor_max
        return 1.0

    def _factor(self, error: float) -> float:
        """Return by how much a step may be changed for its error; to nothing where that is nan."""
        if error != error:
            return 0.0
        return math.pow(self._safety / error, 1.0 / ORDER) if error > 0.0 else math.inf
