"""How an integration ended, and what it took."""

from dataclasses import dataclass
from enum import Enum

__all__ = ["Outcome", "Status"]


class Status(Enum):
    """How a run ended; everything but COMPLETED makes exit status 3.

    UNDER_RESOLVED reached its end too, but its steps did not resolve its impacts: its peaks are not
    to be trusted. The others are early stops.
    """

    COMPLETED = "completed"
    UNDER_RESOLVED = "under-resolved"
    INTERRUPTED = "interrupted"
    FILM_BROKE_DOWN = "film broke down"
    STEP_TOO_SMALL = "step below minimum"
    TOO_MANY_STEPS = "too many steps"
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
