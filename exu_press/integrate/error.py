"""The error of one step over the allowed one: the largest of its criteria.

Each criterion is a class of `exu_press.integrate.criteria`. With the step h, accelerations a, their
rate j_n = (a_n - a_(n-1)) / h, the scale of speeds V, eccentricities e and the clearance c::

    velocities                         h^2 |j_n - j_(n-1)|        over share V      VelocityError
    velocities as prescribed           h^2 |j_n| / 12             over tol V        Prescribed...
    eccentricities                     e less the integral of e_t over share c      Eccentricity...
    penetrations                       the same across surfaces   over a part of it Eccentricity...
    forces of films that turn          |F| (turned angle)^2 / 8   over tol |F|      FilmForceError

and, by `solve_dynamic(criteria=)`, of a scene's springs `InterpolatedForceError`.

The local error of this second-order method goes with h^3, and a run needs about tolerance^(-1/2)
steps. So that the error of the whole run follows the tolerance, the share of one step is
tolerance^(3/2), with clearance joints a hundredth of the tolerance at least.
"""

import math
from collections.abc import Callable, Sequence
from typing import Protocol

from exu_press.integrate.criteria.eccentricity import EccentricityError
from exu_press.integrate.criteria.velocity import PrescribedVelocityError, VelocityError
from exu_press.integrate.newton_filter import NewtonFilter
from exu_press.integrate.task import Task
from exu_press.joints.joint import ClearanceJoint

__all__ = ["Criteria", "Criterion", "StepError", "default_criteria"]


class Criterion(Protocol):
    """A local error of a step over its limit.

    A criterion of a clearance joint may have it as its attribute `joint`.
    """

    def restart(self) -> None:
        """Begin with the current state, as at the start of a run."""

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state; 1 is the limit.

        It goes with the cube of the step, or as its controller expects.
        """

    def accept_step(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""


Criteria = Callable[[Task], Sequence[Criterion]]
"""Makes the criteria of a task whose scales are known."""


def default_criteria(task: Task) -> list[Criterion]:
    """Return the criteria of a task, with clearance joints or without."""
    system, tuning, tolerance = task.system, task.tuning, task.tolerance
    newton_filter, share = NewtonFilter(task), math.pow(tolerance, 1.5)
    if system.joints is None:
        return [VelocityError(task, newton_filter, share), PrescribedVelocityError(task)]
    from exu_press.integrate.criteria.film_force import FilmForceError

    share = max(share, tuning.least_share * tolerance)
    of_bodies, penetration = share, tuning.penetration
    if system.modes and tuning.modal_mass > 0.0:
        of_bodies, penetration = tuning.vibrating * tolerance, tuning.vibrating_penetration
    joints = system.joints.joints
    return [
        VelocityError(task, newton_filter, of_bodies),
        *(EccentricityError(task, joint, newton_filter, share, penetration) for joint in joints),
        *(FilmForceError(task, joint) for joint in joints if joint.lubricated),
    ]


class StepError:
    """The error of the step just tried; 1 is what one step may have."""

    def __init__(self, task: Task, criteria: Criteria = default_criteria) -> None:
        """Estimate the errors of a task by criteria."""
        self._task, self._scales, self._make = task, task.scales, criteria
        self._criteria: Sequence[Criterion] = ()
        self._limited: list[int] = []  # tries in which each criterion's error was the largest

    def begin(self) -> None:
        """Begin with the current state, in which the run's scales are known."""
        self._criteria = self._make(self._task)
        self._limited = [0 for _ in self._criteria]
        self.restart()

    def restart(self) -> None:
        """Begin with the current state, as at the start."""
        for criterion in self._criteria:
            criterion.restart()

    def __call__(self, step: float) -> float:
        """Return the error of the step (s) that ends in the current state."""
        largest, number = 0.0, 0
        for i in range(len(self._criteria)):
            error = self._criteria[i].error(step)
            if error != error:  # no number: the step is to be repeated
                return error
            if error > largest:
                largest, number = error, i
        self._limited[number] += 1
        return largest

    def of_discontinuity(self, step: float) -> float:
        """Return the error if accelerations jump within the step (s) that ends in this state.

        However short the step, it is then of first order; at most half of the jump times the step,
        which is held against the tolerance itself as jumps are few.
        """
        scales, system = self._scales, self._task.system
        jump = scales.norm((system.current.accelerations - system.start.accelerations).tolist())
        allowed = self._task.tolerance * scales.speed
        return 0.5 * step * jump / allowed if allowed > 0.0 else 0.0

    def accept_step(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""
        for criterion in self._criteria:
            criterion.accept_step()
        state = self._task.system.current
        if self._scales.updates:
            self._scales.update(state.velocities.tolist(), state.accelerations.tolist())

    def limiting_joint(self) -> ClearanceJoint | None:
        """Return the joint that limits most steps, if joints together limit half of them.

        The two ends of a guide, or two pins, share them: each may have less than half.
        """
        counts: list[tuple[int, ClearanceJoint]] = []
        for criterion, count in zip(self._criteria, self._limited, strict=True):
            joint: ClearanceJoint | None = getattr(criterion, "joint", None)
            if joint is not None:
                counts.append((count, joint))
        if not counts or 2 * sum(count for count, _ in counts) < sum(self._limited):
            return None
        return max(counts, key=lambda pair: pair[0])[1]
