"""How a run ended: its status, and the reason in words, with what to try."""

import math
from collections.abc import Iterator

from exu_press.integrate.advice import Advice
from exu_press.integrate.monitor import Monitor
from exu_press.integrate.outcome import Status
from exu_press.integrate.problem import Problem
from exu_press.integrate.resolution import Resolution
from exu_press.joints.joint import ClearanceJoint

__all__ = ["how_it_ended"]

SPENT = 1e-3
"""Film thickness over clearance at which a run that gets no further has lost its film."""


def how_it_ended(
    problem: Problem,
    monitor: Monitor,
    resolution: Resolution,
    advice: Advice,
    *,
    gone: float,
    time: float,
    error: float,
    smallest: float,
    failure: str,
) -> tuple[Status, str]:
    """Return status and reason of a run.

    Args:
        problem: what was integrated.
        monitor: of the run.
        resolution: of its impacts.
        advice: words for what to try.
        gone: part of the run that was done.
        time: reached, s.
        error: of the last try, over what it may be; 0.0 with fixed steps.
        smallest: step, s.
        failure: what Exudyn said, if it failed.
    """
    if gone >= 1.0 - 1e-9:
        worst = resolution.worst()
        if worst is None:
            return Status.COMPLETED, ""
        return Status.UNDER_RESOLVED, (
            f"under-resolved {advice.place(worst.time)}: {worst.jump:.0%} of the largest inertia "
            f"force ({problem.nodes[worst.node].name}) within a step of {worst.step:.2g} s; peaks "
            f"are the step's; try {advice.resolution(worst)}"
        )
    where = advice.place(time)
    if monitor.interrupted:
        return Status.INTERRUPTED, f"interrupted {where}"
    if not monitor.go_on:
        return Status.INTERRUPTED, f"stopped by a user function {where}"
    if monitor.over_budget:
        return Status.TOO_MANY_STEPS, (
            f"{monitor.max_steps} steps were used up {where}, {gone:.1%} of the run; try "
            f"{advice.budget()}{advice.cause()}"
        )
    for joint, ratio in _spent_films(problem):
        return Status.FILM_BROKE_DOWN, (
            f"film broke down {where}, eccentricity ratio {ratio:.4f} ({advice.joint(joint)}); "
            f"try {advice.film()}"
        )
    busiest = _busiest_joint(problem, advice)
    if not error <= 1.0:
        return Status.STEP_TOO_SMALL, (
            f"the tolerance needs a step below {smallest:.2g} s {where}{busiest}; try "
            f"{advice.smallest()}{advice.cause()}"
        )
    said = f" [{failure.strip().splitlines()[0]}]" if failure.strip() else ""
    return Status.NOT_CONVERGED, (
        f"Newton's method did not converge {where}{busiest}, down to a step of {smallest:.2g} s; "
        f"try {advice.convergence()}{advice.cause()}{said}"
    )


def _spent_films(problem: Problem) -> Iterator[tuple[ClearanceJoint, float]]:
    """Yield the films that end the run, with their eccentricity ratios at its end."""
    if problem.joints is None:
        return
    for joint in problem.joints.joints:
        if joint.reach < math.inf:
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
    return f", {advice.joint(joint)} carrying {force:.3g} N"
