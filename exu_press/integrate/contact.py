"""Exudyn's own contacts: their data variables, such as gaps, at both ends of a step."""

from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.forces import FELT, forces
from exu_press.integrate.problem import Problem
from exu_press.integrate.settings import SWITCHED, Task

__all__ = ["Gaps", "Settling", "fit_data"]

CLOSED = -1e-300
"""A gap that is closed, m, and by which nothing is deformed."""

PART = 0.05
"""Of the largest force at the start, up to which a switch may be left to the next step."""

LATE = 10
"""Steps for which switches are expected not to settle after one in which they have not."""


def fit_data(task: Task) -> bool:
    """Let data variables fit the start; return whether contacts push otherwise than Exudyn assumed.

    Exudyn's accelerations at the start are those of no contact. Surfaces that are pressed together,
    as in a preloaded bearing, would push from the second step on: a jump that no step is short
    enough for.

    Without such forces most contacts compare with what the last iteration found: they mend a wrong
    guess in the first step, and tell by it the speed with which surfaces meet. Some, as of convex
    rolls, compare with the step's start alone, so that a first step with another gap than the
    guessed one would never settle, however short: they deny what they have found themselves.
    """
    data, where = task.problem.data, exu.ConfigurationType
    guess = np.array(data.GetDataCoordinates(where.Current))
    if not len(guess):
        return False
    mbs, assumed = task.problem.mbs, forces(task)
    for _ in range(2):
        denied = task.solver.PostNewton(mbs, mbs.sys["simulationSettings"])
    pushing = forces(task)
    otherwise = bool(np.linalg.norm(pushing - assumed) > FELT * np.linalg.norm(pushing))
    if otherwise or denied > SWITCHED:
        data.SetDataCoordinates(data.GetDataCoordinates(where.Current), where.StartOfStep)
    else:
        data.SetDataCoordinates(guess, where.Current)
    return otherwise


def _moving_force(task: Task) -> float:
    """Return the largest force that moves a point at the start, N.

    Mass times acceleration, and momentum over a hundredth of the run: what flies needs none yet.
    """
    problem, duration = task.problem, task.end - task.start
    task.solver.ComputeMassMatrix(problem.mbs)
    masses = np.diag(task.solver.GetSystemMassMatrix())
    state = problem.current
    moving = masses * (np.abs(state.accelerations) + 100.0 / duration * np.abs(state.velocities))
    points = [moving[node.start : node.start + node.displacements] for node in problem.nodes]
    return max((float(part.max(initial=0.0)) for part in points), default=0.0)


class Settling:
    """Switches that do not settle in the iterations which the settings give a step.

    Friction without a zone about rest changes its sign from iteration to iteration and from step to
    step, in steps of any size. Exudyn goes on with what the last iteration leaves where the
    settings have `ignoreMaxIterations`, as they do unless told, and what it leaves is off by no
    more than a switch is. So is such a step here: its error is that of a switch, and so are those
    of the steps around it, whose accelerations jump to and fro.
    """

    def __init__(self, task: Task) -> None:
        """Take a task."""
        self._task = task
        self._iteration: Any = task.solver.it
        self._ignored, self._most = task.unsettled, task.iterations
        self._switches: Any = task.switches if task.problem.switching else None
        self._no_shorter, self._shorter = task.no_shorter, True  # whether steps may be shortened
        self._late = 0  # steps to come in which it is expected
        self.switched = 0

    def begins_again(self) -> bool:
        """Return whether the run is to begin again, as its start's forces ask for another limit.

        Exudyn iterates on a contact that has opened or closed where its force is off by more than
        so many newtons, whatever its size: a ball of a gram was held by half a newton.
        """
        if self._switches is None:
            return False
        least = PART * _moving_force(self._task)
        if not 0.0 < least < self._switches.iterationTolerance:
            return False
        self._switches.iterationTolerance = least
        return True

    @property
    def _last(self) -> bool:
        """Return whether the iteration just done is the last one that the step is given."""
        return self._ignored and bool(self._iteration.discontinuousIteration + 1 >= self._most)

    @property
    def never(self) -> bool:
        """Return whether switches do not settle, in this step or of late."""
        return self._late > 0 or self._last

    def judged(self, accepted: bool, step: float) -> None:
        """Be told whether an iteration's step (s) is accepted.

        Exudyn would take the last one anyway. That is no longer the last one where it counts one
        less.
        """
        shorter = not accepted or step > self._no_shorter
        if shorter != self._shorter and self._switches is not None:
            self._shorter = self._switches.useRecommendedStepSize = shorter
        if self._last:
            self._late = LATE
            if not accepted:
                self._iteration.discontinuousIteration -= 1

    def accept(self) -> None:
        """Be told that Exudyn has taken the step."""
        if self._switches is None:
            return
        iterations = self._iteration.discontinuousIteration
        if iterations > 1:
            self.switched += 1
        if self._late:
            self._late = LATE if iterations > 2 else self._late - 1


class Gaps:
    """Gaps on which steps end exactly.

    A contact recommends the step that ends where its gap closes; without acceleration it does so to
    the last digit. Exudyn's contacts of spheres do not push at a gap of 0.0, as it is not negative,
    and do not find it open, as it is not positive either: the next step would go through the
    contact without a force, however deep. So such a gap counts as closed. Where the surfaces part,
    the iterations of the next step find that.
    """

    def __init__(self, problem: Problem) -> None:
        """Take the contacts of a system."""
        places = [
            data[0]
            for number, kind in enumerate(problem.kinds)
            if kind.startswith("Contact") and (data := problem.data.GetObjectLTGData(number))
        ]
        self._places = np.array(places, dtype=int)
        self._now, self._before = problem.current.data, problem.start.data

    def close(self) -> None:
        """Close the gaps that the step which led to the current state has made 0.0."""
        places = self._places
        if len(places) and not self._now[places].all():
            self._now[places[(self._now[places] == 0.0) & (self._before[places] > 0.0)]] = CLOSED
