"""How a run ended, in words: when, where, why, and what to try.

The words of `Advice` are those for any Exudyn system. A scene's own (`exu_press.solving`) name its
keys.
"""

import math
from collections.abc import Iterator
from typing import Any

from exu_press.integrate.forces import without_solution
from exu_press.integrate.monitor import Monitor
from exu_press.integrate.outcome import Outcome, SolverStatus
from exu_press.integrate.problem import Problem
from exu_press.integrate.settings import Task
from exu_press.integrate.stepping import Unresolved
from exu_press.joints.joint import ClearanceJoint

__all__ = ["ARRIVED", "Advice", "how_it_ended"]

SPENT = 1e-3
"""Film thickness over clearance at which a run that gets no further has lost its film."""

EXUDYN_ENDS = 1e-10
"""Before its end, at most how early Exudyn ends a run, s."""

RESTLESS = 0.1
"""Part of the steps with a switch, above which switches decide about the steps."""

CALMER = (
    "less stiffness, more damping, or friction that is regularised over a wider zone of speeds "
    "(frictionProportionalZone, dryFrictionProportionalZone)"
)
"""What makes contacts and friction of Exudyn's switch less."""

OFTEN = 0.25, 10
"""Part of a function's calls, and number of them, above which what it sets is to be told of."""

ARRIVED = "arrived"
"""A watch's word for a run that has reached its aim: it is completed."""


class Advice:
    """Words for the places and the settings of a system."""

    def __init__(self, problem: Problem, by_tolerance: bool) -> None:
        """Speak of a problem, stepped by tolerance or with fixed steps."""
        self.problem, self.by_tolerance = problem, by_tolerance

    @property
    def setting(self) -> str:
        """The key that makes steps larger or smaller."""
        return "tolerance" if self.by_tolerance else "step"

    def place(self, time: float) -> str:
        """Return where the run was at a time, s."""
        return f"at t = {time:.6g} s"

    def joint(self, joint: ClearanceJoint) -> str:
        """Return the name of a clearance joint."""
        assert self.problem.joints is not None
        return self.problem.joints.number(joint)

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
        """Return why a run of such a mean step, s, is long, and what makes it shorter.

        Args:
            step: s.
            joint: that limits most steps, if one does.
        """
        words = f"steps of {step:.2g} s"
        if joint is not None:
            words += f", as {self.joint(joint)} needs them{self.stiff(joint)}"
        return f"{words}; a larger {self.setting} makes it shorter"

    def stiff(self, joint: ClearanceJoint) -> str:
        """Return which keys make a joint need small steps, or nothing."""
        return ""

    def convergence(self) -> str:
        """Return what helps where Newton's method did not converge."""
        if self.by_tolerance:
            return f"a smaller {self.setting}"
        return f"another {self.setting}, or a tolerance instead"

    def redundancy(self, redundant: int) -> str:
        """Return what helps where so many constraints say the same as others."""
        return (
            f"{redundant} constraint{'s say' if redundant > 1 else ' says'} the same as others: "
            "leave out the redundant ones, or settings.linearSolver.solverType = EigenDense with "
            "ignoreSingularJacobian = True"
        )

    def cause(self) -> str:
        """Return what is known of the system that explains why it does not get on, or nothing."""
        function: Any = self.problem.mbs.GetPreStepUserFunction()
        moved = self.problem.untold_rates or function != 0
        return " (or no offset that jumps)" if moved else ""

    def resolution(self, worst: Unresolved) -> str:
        """Return what resolves a run that leapt over its impacts."""
        return f"a {self.setting} ten times smaller"

    def about_outcome(self, outcome: Outcome) -> Iterator[str]:
        """Say of an outcome what a script may go on without looking at."""
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

    def about_start(self, fitted: tuple[float, float], task: Task) -> Iterator[str]:
        """Say of a start that it was fitted by more than what errors may be.

        Args:
            fitted: by how much it has moved, m, and its speeds, m/s.
            task: that was solved.
        """
        moved, changed = fitted
        scales, tolerance = task.scales, task.tolerance
        if moved > tolerance * scales.length or changed > tolerance * scales.speed:
            yield (
                "the start did not fit joints and prescribed motions: positions were changed by "
                f"up to {moved:.2g} m, velocities by up to {changed:.2g} m/s, by as little as can "
                "be; give initial values that fit"
            )

    def about_functions(self, jumps: tuple[int, int], lags: tuple[int, int]) -> Iterator[str]:
        """Say what functions of the user's own often set so that it jumps or lags.

        Args:
            jumps: calls of a pre-step function that have made forces jump, and all of its grid.
            lags: steps behind which a post-step function has changed numbers, and all of them.
        """
        part, least = OFTEN
        for (number, of), text in (
            (
                jumps,
                "in {} of {} calls a pre-step function made forces jump: what it does not set by "
                "mbs.Set...Parameter, as mbs.variables, is held from call to call, and so are "
                "flags; a function of time, as a trajectory, becomes a staircase, which fixed "
                "steps smooth: sample=0.0 calls it for the end of each step; hold=True if forces "
                "are to jump",
            ),
            (
                lags,
                "behind {} of {} steps a post-step function changed numbers: they lag by a step, "
                "whose size depends on the tolerance; set them in a pre-step function, which has a "
                "period, sample=",
            ),
        ):
            if number > max(part * of, least):
                yield text.format(number, of)


def how_it_ended(
    task: Task, monitor: Monitor, advice: Advice, *, time: float, failure: str
) -> tuple[SolverStatus, str]:
    """Return status and reason of a run.

    Args:
        task: that was solved.
        monitor: of the run.
        advice: words for what to try.
        time: reached, s.
        failure: message of Exudyn, if it failed.
    """
    problem, smallest = task.problem, task.smallest
    gone = (time - task.start) / (task.end - task.start)
    exudyn_ended = not failure and 0.0 < task.end - time <= EXUDYN_ENDS and monitor.go_on
    if gone >= 1.0 - 1e-9 or exudyn_ended or monitor.stalled == ARRIVED:
        worst = monitor.resolution.worst() if monitor.resolution is not None else None
        if worst is None:
            return SolverStatus.COMPLETED, ""
        return SolverStatus.UNDER_RESOLVED, (
            f"under-resolved {advice.place(worst.time)}: {worst.jump:.0%} of the largest inertia "
            f"force ({problem.nodes[worst.node].name}) within a step of {worst.step:.2g} s; peaks "
            f"are the step's; try {advice.resolution(worst)}"
        )
    if monitor.stalled:
        return SolverStatus.STALLED, monitor.stalled
    where = advice.place(time)
    if monitor.interrupted:
        return SolverStatus.INTERRUPTED, f"interrupted {where}"
    if not monitor.go_on:
        return SolverStatus.INTERRUPTED, f"stopped by a user function {where}"
    if monitor.over_budget:
        return SolverStatus.TOO_MANY_STEPS, (
            f"{monitor.max_steps} steps were used up {where}, {gone:.1%} of the run; try "
            f"{advice.budget()}{_cause(task, advice, time)}{_restless(monitor)}"
        )
    for joint, ratio in _spent_films(problem):
        return SolverStatus.FILM_BROKE_DOWN, (
            f"film broke down {where}, eccentricity ratio {ratio:.4f} ({advice.joint(joint)}); "
            f"try {advice.film()}"
        )
    busiest = _busiest_joint(problem, advice)
    if not monitor.control.error <= 1.0:
        cure = (
            _redundancy(task, monitor, advice)
            or f"try {advice.smallest()}{_cause(task, advice, time)}"
        )
        return SolverStatus.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest:.2g} s {where}{busiest}"
            f"{_unfit_start(monitor)}; {cure}"
        )
    found = _what_is_wrong(task, monitor, advice, time)
    if found:
        return SolverStatus.NOT_CONVERGED, f"Newton's method did not converge {where}: {found}"
    said = f" [{failure.strip().splitlines()[0]}]" if failure.strip() else ""
    return SolverStatus.NOT_CONVERGED, (
        f"Newton's method did not converge {where}{busiest}, down to a step of {smallest:.2g} s; "
        f"try {advice.convergence()}{advice.cause()}{said}"
    )


def _cause(task: Task, advice: Advice, time: float) -> str:
    """Return what explains why a run does not get on after a time, s, or nothing."""
    found = without_solution(task, time)
    return f" ({found})" if found else advice.cause()


def _what_is_wrong(task: Task, monitor: Monitor, advice: Advice, time: float) -> str:
    """Return what of a system keeps Newton's method from converging after a time, s, or nothing."""
    problem = task.problem
    found = without_solution(task, time) or _redundancy(task, monitor, advice)
    if found:
        return found
    if monitor.without_mass and not monitor.steps:
        names = (
            n.name for n, m in zip(problem.nodes, task.scales.masses, strict=True) if m == math.inf
        )
        return f"nothing holds the coordinates without mass ({', '.join(names)})"
    if problem.switching and task.solver.it.discontinuousIteration > 1:
        return (
            f"contacts or friction of Exudyn's switch to and fro in steps of any size; try {CALMER}"
            ", or settings.timeIntegration.discontinuous.ignoreMaxIterations = True, with which "
            "steps are taken as such switches leave them"
        )
    return ""


def _restless(monitor: Monitor) -> str:
    """Return that contacts or friction of Exudyn's switch all the time, if they do."""
    part = monitor.switched_steps / max(monitor.steps, 1)
    if part < RESTLESS:
        return ""
    return f"; contacts or friction of Exudyn's switched in {part:.0%} of the steps: {CALMER}"


def _redundancy(task: Task, monitor: Monitor, advice: Advice) -> str:
    """Return what to do about constraints that say the same, or nothing."""
    if task.problem.mbs.sys["simulationSettings"].linearSolver.ignoreSingularJacobian:
        return ""
    redundant = monitor.constraints.redundant()
    return advice.redundancy(redundant) if redundant else ""


def _unfit_start(monitor: Monitor) -> str:
    """Return what a first step tells that no size makes good, or nothing."""
    jump = monitor.first_jump()
    if not 0.0 < jump < math.inf:
        return ""
    return (
        f", as its first step changes a speed by {jump:.2g} m/s: the start does not fit what "
        "constraints and functions ask for right after it"
    )


def _spent_films(problem: Problem) -> Iterator[tuple[ClearanceJoint, float]]:
    """Yield the films that end the run, with their eccentricity ratios at its end."""
    if problem.joints is None:
        return
    for joint in problem.joints.joints:
        if joint.contact_onset < math.inf:
            continue  # what lies beyond the film is in its model
        if joint.outside is not None:
            yield joint, joint.outside
        else:
            gap = problem.joints.state(joint).gap
            if gap < SPENT * joint.clearance:
                yield joint, 1.0 - gap / joint.clearance


def _busiest_joint(problem: Problem, advice: Advice) -> str:
    """Return in words which clearance joint carries the largest force at the end, if one does."""
    if problem.joints is None:
        return ""
    states = [(math.hypot(*problem.joints.state(j).force), j) for j in problem.joints.joints]
    force, joint = max(states, key=lambda s: s[0] if math.isfinite(s[0]) else -1.0)
    carries = f"carrying {force:.3g} N" if math.isfinite(force) else "whose laws give no numbers"
    return f", {advice.joint(joint)} {carries}"
