"""Rows of sensors and of the solution file at equal distances in time, whatever the steps are."""

import math
from typing import Any

import numpy as np

from exu_press.integrate.problem import State
from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array

__all__ = ["OutputGrid", "between"]

AT_ONCE = 1e-10
"""Distance below which two instants are one for Exudyn's output, s."""


def between(part: float, step: float, start: list[Array], end: list[Array]) -> list[Array]:
    """Return a state within a step.

    Velocities and first-order coordinates follow the cubic through their values and slopes at both
    ends; positions are the integral of velocities, and what that misses of their change is spread
    smoothly; accelerations, forces of constraints and rates lie on lines.

    Args:
        part: of the step, from 0 to 1.
        step: s.
        start: positions, velocities, accelerations, multipliers, first-order coordinates and rates.
        end: likewise.
    """
    s = part
    (q0, v0, a0, _, y0, r0), (q1, v1, a1, _, y1, r1) = start, end
    smooth = s * s * (3.0 - 2.0 * s)
    from_slopes = step * s * (1.0 - s) * (1.0 - s), -step * s * s * (1.0 - s)
    found = [one + s * (other - one) for one, other in zip(start, end, strict=True)]
    found[1] = v0 + smooth * (v1 - v0) + from_slopes[0] * a0 + from_slopes[1] * a1
    found[4] = y0 + smooth * (y1 - y0) + from_slopes[0] * r0 + from_slopes[1] * r1
    of_change = s * s * s * (1.0 - 0.5 * s)
    of_a0 = step * s * s * (0.5 - s * (2.0 / 3.0 - 0.25 * s))
    of_a1 = step * s * s * s * (0.25 * s - 1.0 / 3.0)
    way = step * (s * v0 + of_change * (v1 - v0) + of_a0 * a0 + of_a1 * a1)
    whole = step * (0.5 * (v0 + v1) + step * (a0 - a1) / 12.0)
    found[0] = q0 + way + smooth * (q1 - q0 - whole)
    return found


class OutputGrid:
    """Lets Exudyn write its rows at multiples of the settings' periods.

    Exudyn writes a row at the first step's end behind a multiple. With steps of one size that is
    the multiple itself. With a tolerance rows would be at uneven distances, of which no spectrum
    can be made. So the state within the step is put in the place of its end, and Exudyn finishes a
    step there; then the end is put back.

    Not with clearance joints, whose forces remember where they were last asked.
    """

    def __init__(self, task: Task) -> None:
        """Look at a task."""
        self._task, problem = task, task.problem
        self._active = not task.fixed and problem.joints is None
        self._current = problem.current
        self._periods: list[float] = []
        self._start: list[Array] = []
        self.writing = False

    def begin(self) -> None:
        """Look at the settings, and at the state from which the run starts."""
        mbs: Any = self._task.problem.mbs
        output = mbs.sys["simulationSettings"].solution
        periods = [output.file.writePeriod] if output.file.write else []
        if mbs.systemData.NumberOfSensors():
            periods.append(output.sensors.writePeriod)
        least = max(self._task.smallest, AT_ONCE)  # below it, as with 0.0, every step is a row
        self._periods = [period for period in periods if period > least and self._active]
        if self._periods:
            self._start = _copy(self._current)

    def stepped(self, begin: float, end: float) -> None:
        """Write what lies within an accepted step, s, that ends in the current state."""
        if not self._periods:
            return
        state = _copy(self._current)
        for time in self._times(begin, end):
            self._put(
                time, between((time - begin) / (end - begin), end - begin, self._start, state)
            )
            self.writing = True
            self._task.solver.FinishStep(self._task.problem.mbs, self._settings())
            self.writing = False
            self._put(end, state)
        self._start = state

    def _settings(self) -> Any:
        return self._task.problem.mbs.sys["simulationSettings"]

    def _times(self, begin: float, end: float) -> list[float]:
        """Return the multiples within a step; its end is written by Exudyn itself."""
        found = set()
        for period in self._periods:
            number = math.floor((begin - self._task.start + AT_ONCE) / period) + 1
            while (time := self._task.start + number * period) < end - AT_ONCE:
                found.add(time)
                number += 1
        return sorted(found)

    def _put(self, time: float, state: list[Array]) -> None:
        """Set the current state."""
        current = self._current
        parts = (
            current.positions,
            current.velocities,
            current.accelerations,
            current.multipliers,
            current.first_order,
            current.rates,
        )
        for part, values in zip(parts, state, strict=True):
            part[:] = values
        self._task.problem.data.SetTime(time)


def _copy(state: State) -> list[Array]:
    """Return the parts of a state, in their order."""
    return [
        np.array(part)
        for part in (
            state.positions,
            state.velocities,
            state.accelerations,
            state.multipliers,
            state.first_order,
            state.rates,
        )
    ]
