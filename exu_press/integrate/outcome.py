"""How an integration ended, and what it took."""

from dataclasses import dataclass
from enum import Enum

__all__ = ["Outcome", "Status"]


class Status(Enum):
    """How a run ended; everything but COMPLETED is an early stop (exit status 3)."""

    COMPLETED = "completed"
    INTERRUPTED = "interrupted"
    FILM_BROKE_DOWN = "film broke down"
    STEP_TOO_SMALL = "step below minimum"
    NOT_CONVERGED = "not converged"


@dataclass(frozen=True)
class Outcome:
    """Status, reason and statistics of an integration.

    Attributes:
        status: how it ended.
        reason: when, where, why, and what to try; empty when completed.
        end_time: the time reached, s.
        wall_time: the integration alone, s.
        steps: accepted steps.
        rejected_steps: steps that were repeated with half the size.
        newton_iterations: of all steps.
        law_evaluations: how often the clearance joints' forces were asked for.
    """

    status: Status
    reason: str
    end_time: float
    wall_time: float
    steps: int
    rejected_steps: int
    newton_iterations: int
    law_evaluations: int
