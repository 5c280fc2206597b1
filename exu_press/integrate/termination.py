"""How a run ended: status and a message that says when, where, why, and what to try.

`Advice` words messages for any system; that of a scene (`exu_press.model.advice`) names its keys.
"""

import math
from collections.abc import Iterator

from exu_press.integrate.monitor import RunMonitor
from exu_press.integrate.outcome import Outcome, SolverStatus
from exu_press.integrate.resolution import UnresolvedImpact
from exu_press.integrate.system import System
from exu_press.integrate.task import Task
from exu_press.integrate.user_functions import user_function
from exu_press.joints.joint import ClearanceJoint

__all__ = ["ARRIVED", "Advice", "termination"]

SPENT = 1e-3
"""Film thickness over clearance below which a run that stops has lost its film."""

EXUDYN_ENDS = 1e-10
"""Largest time by which Exudyn ends a run early, s."""

ARRIVED = "arrived"
"""A watch's word for a run that has reached its aim: it is completed."""


class Advice:
    """Parts of messages: location, joint, setting and cure, for any system."""

    def __init__(self, system: System, by_tolerance: bool) -> None:
        """Word messages about a system, stepped by tolerance or with fixed steps."""
        self.system, self.by_tolerance = system, by_tolerance

    @property
    def setting(self) -> str:
        """The key that makes steps larger or smaller."""
        return "tolerance" if self.by_tolerance else "step"

    def location(self, time: float) -> str:
        """Return where the run was at a time, s."""
        return f"at t = {time:.6g} s"

    def joint(self, joint: ClearanceJoint) -> str:
        """Return the name of a clearance joint."""
        assert self.system.joints is not None
        return self.system.joints.number(joint)

    def film(self) -> str:
        """Return the cure for a film that broke down."""
        return "a mixed film (contact=, asperity_onset=), or a larger viscosity or length"

    def smallest(self) -> str:
        """Return what helps where steps became too small."""
        return "a larger tolerance or a smaller settings.timeIntegration.minimumStepSize"

    def budget(self) -> str:
        """Return what helps where too many steps were needed."""
        return f"an earlier end time, a larger {self.setting} or max_steps"

    def long(self, step: float, joint: ClearanceJoint | None) -> str:
        """Return why a run takes long: its mean step, s, and the joint that limits most steps."""
        words = f"steps of {step:.2g} s"
        if joint is not None:
            words += f", as {self.joint(joint)} needs them{self.stiff(joint)}"
        return f"{words}; a larger {self.setting} makes it shorter"

    def stiff(self, joint: ClearanceJoint) -> str:
        """Return which keys make a joint need small steps, or nothing."""
        return ""

    def convergence(self) -> str:
        """Return what helps where Newton's method did not converge.

        A larger tolerance asks it for less, and its longer steps leap over stiff transients, which
        shorter steps resolve; a smaller one has stopped runs that a larger one completes.
        """
        if self.by_tolerance:
            return self.smallest()
        return f"another {self.setting}, or a tolerance instead"

    def redundancy(self, redundant: int) -> str:
        """Return the cure for a number of redundant constraints."""
        return (
            f"{redundant} constraint{'s say' if redundant > 1 else ' says'} the same as others: "
            "leave out the redundant ones, or settings.linearSolver.solverType = EigenDense with "
            "ignoreSingularJacobian = True"
        )

    def cause(self) -> str:
        """Return a possible cause of failed steps that lies in the system, or nothing."""
        moved = self.system.rates_not_provided or user_function(self.system.mbs, "PreStep")
        return " (or no offset that jumps)" if moved else ""

    def resolution(self, worst: UnresolvedImpact) -> str:
        """Return the cure for steps that do not resolve an impact."""
        return f"a {self.setting} ten times smaller"

    def about_outcome(self, outcome: Outcome) -> Iterator[str]:
        """Yield warnings about an outcome, as a script may not look at it."""
        if outcome.status not in (SolverStatus.COMPLETED, SolverStatus.INTERRUPTED):
            yield f"{outcome.status.value}: {outcome.reason}"
        error = outcome.error
        if error is not None and error.since < math.inf:
            begins = f"from t = {error.since:.6g} s on"
            yield (
                f"no error is known {begins}: the finer run stopped early, {error.reason}"
                if error.reason
                else f"errors are above ten tolerances {begins}, up to {error.motion:.2g} of the "
                "largest speed: the motion amplifies what steps miss; try a smaller tolerance, or "
                "believe the run up to there"
            )

    def about_start(self, task: Task, changes: tuple[float, float]) -> Iterator[str]:
        """Yield a warning of a start that was moved by more than the tolerance, in m and m/s."""
        (moved, changed), scales = changes, task.scales
        if max(moved / scales.length, changed / (scales.speed or 1.0)) > task.tolerance:
            yield (
                "the start did not fit joints and prescribed motions: positions were changed by "
                f"up to {moved:.2g} m, velocities by up to {changed:.2g} m/s, the least that fits; "
                "give initial values that fit"
            )

    def about_system(self, *, held: bool) -> Iterator[str]:
        """Yield a warning of parts without an estimated error; held outputs are meant to jump."""
        system = self.system
        unfollowed = [*system.contacts]
        if len(system.current.first_order):
            unfollowed.append("first-order coordinates")
        if user_function(system.mbs, "PreStep") and not held:
            unfollowed.append("what the pre-step function sets, where that jumps")
        if self.by_tolerance and unfollowed:
            yield (
                f"no error of a step is estimated for {', '.join(unfollowed)}: compare with a run "
                "of a smaller largest step, by settings.timeIntegration.numberOfSteps"
            )


def termination(
    task: Task, monitor: RunMonitor, advice: Advice, *, time: float, failure: str
) -> tuple[SolverStatus, str]:
    """Return status and reason of a run that reached a time, s, or failed with a message."""
    system, smallest = task.system, task.smallest
    gone = (time - task.start) / (task.end - task.start)
    exudyn_ended = not failure and 0.0 < task.end - time <= EXUDYN_ENDS and monitor.go_on
    if gone >= 1.0 - 1e-9 or exudyn_ended or monitor.stalled == ARRIVED:
        worst = monitor.resolution.worst() if monitor.resolution is not None else None
        if worst is None:
            return SolverStatus.COMPLETED, ""
        return SolverStatus.UNDER_RESOLVED, (
            f"under-resolved {advice.location(worst.time)}: {worst.jump:.0%} of the largest "
            f"inertia force ({system.nodes[worst.node].name}) within a step of {worst.step:.2g} s; "
            f"peaks are the step's; try {advice.resolution(worst)}"
        )
    if monitor.stalled:
        return SolverStatus.STALLED, monitor.stalled
    where = advice.location(time)
    if monitor.interrupted:
        return SolverStatus.INTERRUPTED, f"interrupted {where}"
    if not monitor.go_on:
        return SolverStatus.INTERRUPTED, f"stopped by a user function {where}"
    if monitor.over_budget:
        return SolverStatus.TOO_MANY_STEPS, (
            f"{monitor.max_steps} steps were used up {where}, {gone:.1%} of the run; try "
            f"{advice.budget()}{advice.cause()}"
        )
    for joint, ratio in _spent_films(system):
        return SolverStatus.FILM_BROKE_DOWN, (
            f"film broke down {where}, eccentricity ratio {ratio:.4f} ({advice.joint(joint)}); "
            f"try {advice.film()}"
        )
    busiest, redundancy = _busiest_joint(system, advice), _redundancy(task, monitor, advice)
    if not monitor.control.error <= 1.0:
        cure = redundancy or f"try {advice.smallest()}{advice.cause()}"
        return SolverStatus.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest:.2g} s {where}{busiest}; {cure}"
        )
    if redundancy:
        return SolverStatus.NOT_CONVERGED, f"Newton's method did not converge {where}: {redundancy}"
    message = f" [{failure.strip().splitlines()[0]}]" if failure.strip() else ""
    return SolverStatus.NOT_CONVERGED, (
        f"Newton's method did not converge {where}{busiest}, down to a step of {smallest:.2g} s; "
        f"try {advice.convergence()}{advice.cause()}{message}"
    )


def _redundancy(task: Task, monitor: RunMonitor, advice: Advice) -> str:
    """Return what to do about redundant constraints, or nothing."""
    if task.system.mbs.sys["simulationSettings"].linearSolver.ignoreSingularJacobian:
        return ""
    redundant = monitor.constraints.redundant()
    return advice.redundancy(redundant) if redundant else ""


def _spent_films(system: System) -> Iterator[tuple[ClearanceJoint, float]]:
    """Yield the films that end the run, with their eccentricity ratios at its end."""
    if system.joints is None:
        return
    for joint in system.joints.joints:
        if joint.contact_onset < math.inf:
            continue  # what lies beyond the film is in its model
        if joint.outside is not None:
            yield joint, joint.outside
        else:
            gap = system.joints.state(joint).gap
            if gap < SPENT * joint.clearance:
                yield joint, 1.0 - gap / joint.clearance


def _busiest_joint(system: System, advice: Advice) -> str:
    """Return in words which clearance joint carries the largest force at the end, if one does."""
    if system.joints is None:
        return ""
    states = [(math.hypot(*system.joints.state(j).force), j) for j in system.joints.joints]
    force, joint = max(states, key=lambda s: s[0] if math.isfinite(s[0]) else -1.0)
    carries = f"carrying {force:.3g} N" if math.isfinite(force) else "whose laws give no numbers"
    return f", {advice.joint(joint)} {carries}"
