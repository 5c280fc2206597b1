"""The part of a run's tolerance that one step may use."""

import math
from dataclasses import dataclass

__all__ = ["ErrorPerStep"]

FEW = 10.0
"""Tolerances up to which errors that are bounded need not be smaller. A phase that is lost for good
is bounded, too, by hundreds of them."""


@dataclass(frozen=True)
class ErrorPerStep:
    """The relative error of a step with which the run's error is its tolerance.

    Generalized-alpha is of second order: its local error goes with h^3, and a run needs about
    tolerance^(-1/2) steps. So that the error of the whole run follows the tolerance, one step may
    have tolerance^(3/2). With clearance joints it may have a hundredth of the tolerance at least,
    as below 1e-4 impacts become no more.

    A run of many more steps adds more errors up: all of them where bodies vibrate and a phase
    drifts, so that a step may have less by how many steps of its size the run would take, over what
    is usual. First-order coordinates relax, and their errors are of either sign: the root of that.

    Attributes:
        whole: error that a step may have in a run of a usual number of steps.
        shortest: step of such a run, s; 0.0 lets all steps have the whole.
    """

    whole: float
    shortest: float = 0.0

    @classmethod
    def of(
        cls, tolerance: float, duration: float, many_steps: float, impacts: bool
    ) -> "ErrorPerStep":
        """Return what the steps of a run may miss.

        Args:
            tolerance: of the run.
            duration: of the run, s.
            many_steps: times tolerance^(-1/2), the largest usual number of steps.
            impacts: whether there are clearance joints.
        """
        whole = math.pow(tolerance, 1.5)
        if impacts:
            return cls(max(whole, 1e-2 * tolerance))
        return cls(whole, duration * math.sqrt(tolerance) / many_steps)

    def at(self, step: float, most: float = math.inf) -> float:
        """Return what a step (s) may have of velocities.

        Args:
            step: s.
            most: to which the errors of all steps can add up, over what the run may have.
        """
        if step >= self.shortest:
            return self.whole
        bounded = math.pow(min(1.0, FEW / most), 3.0) / most
        return self.whole * min(1.0, max(step / self.shortest, bounded))

    def relaxing(self, step: float) -> float:
        """Return what a step (s) may have of first-order coordinates."""
        return math.sqrt(self.whole * self.at(step))
