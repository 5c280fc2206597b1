"""What a run that did not go through says: where it was, and what to try.

These are the words for any Exudyn system. A scene's own (`exu_press.solving`) name its keys.
"""

from exu_press.integrate.problem import Problem
from exu_press.integrate.resolution import Unresolved
from exu_press.joints.joint import ClearanceJoint

__all__ = ["Advice"]


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
