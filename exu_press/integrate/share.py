"""What one step may have of a run's tolerance."""

import math
from dataclasses import dataclass

__all__ = ["Share"]


@dataclass(frozen=True)
class Share:
    """What a step may be off by, relative, so that the run is off by its tolerance.

    Generalized-alpha is of second order: its local error goes with h^3, and a run needs about
    tolerance^(-1/2) steps. So that the error of the whole run follows the tolerance, one step may
    have tolerance^(3/2). With clearance joints it may have a hundredth of the tolerance at least,
    as below 1e-4 impacts become no more.

    A run of many more steps adds more errors up: all of them where a phase drifts, none where the
    motion is damped or driven. In between, as for errors of either sign, a step may have less by
    the root of how many steps of its size the run would take, over what is usual.

    Attributes:
        whole: what a step may have in a run of a usual number of steps.
        shortest: step of such a run, s; 0.0 lets all steps have the whole.
    """

    whole: float
    shortest: float = 0.0

    @classmethod
    def of(cls, tolerance: float, duration: float, many_steps: float, impacts: bool) -> "Share":
        """Return the share of a run's steps.

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

    def at(self, step: float) -> float:
        """Return what a step (s) may have."""
        return self.whole if step >= self.shortest else self.whole * math.sqrt(step / self.shortest)
