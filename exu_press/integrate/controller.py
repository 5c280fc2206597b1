"""Controllers: by what a step is changed for its error. A run takes any one of their kind."""

import math
from typing import Protocol

from exu_press.integrate.task import SolverTuning

__all__ = ["ORDER", "Controller", "LimitedGrowth"]

ORDER = 3
"""Power of the step with which its error goes."""


class Controller(Protocol):
    """Changes steps for their errors; 1 is the largest allowed one."""

    def repeat_factor(self, error: float) -> float:
        """Return the factor with which to repeat a step whose error is above 1, or no number."""

    def growth_factor(self, error: float) -> float:
        """Return the factor for the steps after one whose error is at most 1."""


class LimitedGrowth:
    """The elementary controller h_new = h (safety / error)^(1/3), with a dead zone.

    Steps stay as long as they are until they may grow by `factor_max`, and grow by that alone: what
    an impact leaves decides about the next one, and steps that grew by half passed over it. A PI
    controller needs 26 to 32 % more steps in the press (E. Hairer, S. P. Norsett and G. Wanner,
    Solving Ordinary Differential Equations I, II.4).
    """

    def __init__(self, tuning: SolverTuning) -> None:
        """Take its numbers `safety`, `factor_min` and `factor_max`."""
        self._safety = tuning.safety
        self._factor_min, self._factor_max = tuning.factor_min, tuning.factor_max

    def repeat_factor(self, error: float) -> float:
        """Return the factor with which to repeat a step whose error is above 1, or no number."""
        if error != error:
            return self._factor_min
        return max(self._factor_min, self._factor(error))

    def growth_factor(self, error: float) -> float:
        """Return the factor for the steps after one whose error is at most 1."""
        return self._factor_max if self._factor(error) > self._factor_max else 1.0

    def _factor(self, error: float) -> float:
        return math.pow(self._safety / error, 1.0 / ORDER) if error > 0.0 else math.inf
