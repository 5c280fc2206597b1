"""Exudyn's own contacts: their data variables, such as gaps, at both ends of a step."""

import exudyn as exu
import numpy as np

from exu_press.integrate.problem import Problem
from exu_press.integrate.settings import SWITCHED, Task

__all__ = ["Gaps", "fit_data"]

CLOSED = -1e-300
"""A gap that is closed, m, and by which nothing is deformed."""


def fit_data(task: Task) -> None:
    """Let data variables fit the start, where contact or friction would never give up a guess.

    Most contacts of Exudyn's compare with what the last iteration found: they mend a wrong guess in
    the first step, and tell by it the speed with which surfaces meet. Some, as of convex rolls,
    compare with the step's start alone, so that a first step with another gap than the guessed one
    would never settle, however short: they deny what they have found themselves.
    """
    data, where = task.problem.data, exu.ConfigurationType
    guess = np.array(data.GetDataCoordinates(where.Current))
    if not len(guess):
        return
    mbs = task.problem.mbs
    for _ in range(2):
        denied = task.solver.PostNewton(mbs, mbs.sys["simulationSettings"])
    if denied > SWITCHED:
        data.SetDataCoordinates(data.GetDataCoordinates(where.Current), where.StartOfStep)
    else:
        data.SetDataCoordinates(guess, where.Current)


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
