"""How an integration ended, what it took, and what a run that did not go through says.

The words of `Advice` are those for any Exudyn system. A scene's own (`exu_press.solving`) name its
keys.
"""

from dataclasses import dataclass
from enum import Enum

from exu_press.integrate.problem import Problem
from exu_press.joints.joint import ClearanceJoint

__all__ = ["Advice", "Outcome", "Status", "Unresolved"]


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


@dataclass(frozen=True)
class Unresolved:
    """The worst step of a run that its steps do not resolve.

    Attributes:
        time: where the step ends, s.
        step: its size, s.
        node: whose inertia force jumps, counted as in the problem.
        jump: of that force, over the largest one of the run.
    """

    time: float
    step: float
    node: int
    jump: float


class Advice:
    """Words for the places and the settings of a system."""

    def __init__(self, problem: Problem, by_tolerance: bool) -> None:
        """Speak of a problem, stepped by tolerance or with fixed steps."""
        self.problem, self.by_tolerance = problem, by_tolerance

    @property
    def setting(self) -> str:
        """What makes steps larger or smaller."""
        return "tolerance" if self.by_tolerance else "step"

    def place(self, time: float) -> str:
        """Return where the run was at a time, s."""
        return f"at t = {time:.6g} s"

    def joint(self, joint: ClearanceJoint) -> str:
        """Return what a clearance joint is called."""
        assert self.problem.joints is not None
        return self.problem.joints.number(joint)

    def film(self) -> str:
        """Return what helps a film that broke down."""
        return "a mixed film (contact=, asperity_onset=), or a larger viscosity or length"

    def smallest(self) -> str:
        """Return what helps where steps became too small."""
        return "a larger tolerance or a smaller settings.timeIntegration.minimumStepSize"

    def budget(self) -> str:
        """Return what helps where too many steps were needed."""
        return f"an earlier end time, a larger {self.setting} or max_steps"

    def convergence(self) -> str:
        """Return what helps where Newton's method did not converge."""
        return f"a smaller {self.setting}"

    def cause(self) -> str:
        """Return what is known of the system that explains why it does not get on, or nothing."""
        return ""

    def resolution(self, worst: Unresolved) -> str:
        """Return what resolves a run that leapt over its impacts."""
        return f"a {self.setting} ten times smaller"
