"""How a run ended, what it took, and what it is off by."""

from dataclasses import dataclass
from enum import Enum

from exu_press.numerics.arrays import Array

__all__ = ["Outcome", "RunError", "SolverStatus"]


class SolverStatus(Enum):
    """The end of a run; all but COMPLETED have exit status 3.

    UNDER_RESOLVED reached its end too, but its steps did not resolve its impacts: its peaks are not
    to be trusted. The others are early stops.
    """

    COMPLETED = "completed"
    UNDER_RESOLVED = "under-resolved"
    INTERRUPTED = "interrupted"
    STALLED = "stalled"
    FILM_BROKE_DOWN = "film broke down"
    STEP_TOO_SMALL = "step below minimum"
    TOO_MANY_STEPS = "too many steps"
    NOT_CONVERGED = "not converged"

    @property
    def reached_end(self) -> bool:
        """Whether the run reached its end."""
        return self in (SolverStatus.COMPLETED, SolverStatus.UNDER_RESOLVED)


@dataclass(frozen=True)
class RunError:
    """Errors of a run: 10/3 of its differences from a run with a quarter of the tolerance.

    They hold where errors go with the tolerance, and say how much it matters where they do not, as
    the motion amplifies them. What both runs miss, as a blow within one step, is in neither.

    Attributes:
        motion: the largest one of 100 instants: of a body's velocity in the kinetic norm over the
            largest speed, or of a first-order coordinate over its largest value. Infinite where the
            finer run stopped early.
        since: the first of these instants with more than ten tolerances, s, or infinity.
        sensors: of each sensor with `storeInternal` (of others an empty array): of each of its
            values the largest one in a row, (values,). Empty where the finer run stopped early.
        peaks: likewise, of the largest magnitude of each of its values in all rows.
        reason: why the finer run stopped early, or nothing.
    """

    motion: float
    since: float
    sensors: list[Array]
    peaks: list[Array]
    reason: str = ""


@dataclass(frozen=True)
class Outcome:
    """SolverStatus, reason and statistics of an integration.

    Attributes:
        status: how it ended; the reason says when, where, why, and what to try.
        end_time: the time reached, s.
        wall_time: the integration alone, s.
        steps: accepted ones; rejected_steps were repeated.
        newton_iterations: of all steps.
        law_evaluations: how often the clearance joints' forces were asked for.
        error: of the run, where it was asked for and the run got to its end.
    """

    status: SolverStatus
    reason: str
    end_time: float
    wall_time: float
    steps: int
    rejected_steps: int
    newton_iterations: int
    law_evaluations: int
    error: RunError | None = None

    def check(self) -> "Outcome":
        """Return this outcome where the run was completed.

        Raises:
            RuntimeError: it was not; with the reason.
        """
        if self.status is not SolverStatus.COMPLETED:
            raise RuntimeError(f"{self.status.value}: {self.reason}")
        return self
