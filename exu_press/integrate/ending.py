"""How a run ended, in words with what to try, and whether its steps resolved its impacts.

A step of any size gets through an impact, and generalized-alpha is stable at all of them: the run
ends, its curves look smooth, and its peaks have the height that the step gives them. What tells is
how a peak is reached. Resolved, a force rises over several steps; where the largest force of the
run comes or goes within one step, its height is the step's.

So the figure is the largest change of an inertia force m |a| within one step, of any body, against
the largest inertia force of the run. Measured against a tolerance of 1e-5 on dry, lubricated and
mixed presses and slider-cranks of many clearances, speeds and dampings, steps of 1e-3 to 1e-5 s:
above 0.8 the joints' peak forces were off by 9 to 90 %, seldom less; between 0.65 and 0.8 by 2 to
17 %. Below, steps say nothing against a peak, and nothing for it either: an error that an earlier
impact left may have grown by then. How far a figure is off its stated error says (see
`exu_press.confidence`).

Loads and prescribed motions of other systems may jump themselves, and steps end on that within what
the tolerance leaves: a jump that changes no speed by a tenth of it is none of the step's.
"""

import math
from collections.abc import Iterator
from typing import Protocol

from exu_press.integrate.local_error import squares
from exu_press.integrate.outcome import Advice, Status, Unresolved
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.tuning import Tuning
from exu_press.joints.joint import ClearanceJoint

__all__ = ["Resolution", "how_it_ended"]

SPENT = 1e-3
"""Film thickness over clearance at which a run that gets no further has lost its film."""


class Resolution:
    """Follows the inertia forces of all bodies from step to step."""

    def __init__(
        self, scales: FoundScales, spectral_radius: float, least: float, tuning: Tuning
    ) -> None:
        """Start.

        Args:
            scales: of the motion, which knows the bodies.
            spectral_radius: at infinity, by which a ring decays from step to step.
            least: part of the largest speed that a jump must change within its step to count.
            tuning: numbers.
        """
        self._scales, self._radius = scales, spectral_radius
        self._least = least
        self._allowed = tuning.largest_jump
        self._time = 0.0
        self._before: list[float] = []
        # A stiff film that starts from rest makes the accelerations ring; that is no impact.
        self._started: list[float] = []
        self._ring = 1.0
        self._largest = 0.0
        self._steps = 0
        # size, end and size of the step (s), node, and half the change of speed in the step (m/s)
        self._jumps: list[tuple[float, float, float, int, float]] = []

    def stepped(self, time: float, accelerations: list[float]) -> None:
        """Be told of an accepted step's end (s), or of the start."""
        before, self._before = self._before, accelerations
        start, self._time = self._time, time
        if not before:
            return
        scales = self._scales
        jumps = squares(scales, [a - b for a, b in zip(accelerations, before, strict=True)])
        sizes = squares(scales, accelerations)
        masses = scales.masses
        if not self._started:
            self._started = [2.0 * math.sqrt(square) for square in jumps]
        else:
            self._ring *= self._radius
        self._steps += 1
        for i in range(len(masses)):
            mass = masses[i]
            if mass == math.inf:
                continue
            ringing = self._started[i] * self._ring
            self._largest = max(self._largest, mass * (math.sqrt(sizes[i]) - ringing))
            jump = mass * (math.sqrt(jumps[i]) - ringing)
            if jump > self._allowed * self._largest:
                change = 0.5 * (time - start) * math.sqrt(jumps[i])
                self._jumps.append((jump, time, time - start, i, change))

    def worst(self) -> Unresolved | None:
        """Return the step with the largest change of an inertia force, if it is too large."""
        least = self._least * self._scales.speed
        felt = [found for found in self._jumps if found[-1] > least]
        if self._steps < 2 or not felt:
            return None
        jump, time, step, node, _ = max(felt)
        if jump <= self._allowed * self._largest:
            return None
        return Unresolved(time, step, node, jump / self._largest)


class Watched(Protocol):
    """What is asked of a run monitor; `exu_press.integrate.monitor.Monitor` is one."""

    interrupted: bool
    go_on: bool
    over_budget: bool
    max_steps: int


def how_it_ended(
    problem: Problem,
    monitor: Watched,
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
