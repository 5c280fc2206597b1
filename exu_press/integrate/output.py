"""Rows of sensors and of the solution file at equal distances in time, whatever the steps are."""

import math
from typing import Any

import numpy as np

from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array

__all__ = ["OutputGrid", "between"]

AT_ONCE = 1e-10
"""Distance below which two instants are one for Exudyn's output, s."""


def between(parts: list[float], step: float, start: list[Array], end: list[Array]) -> list[Array]:
    """Return states within a step, a row for each instant.

    Velocities and first-order coordinates follow the cubic through their values and slopes at both
    ends; positions are the integral of velocities, and what that misses of their change is spread
    smoothly; accelerations, forces of constraints and rates lie on lines.

    Args:
        parts: of the step, from 0 to 1.
        step: s.
        start: positions, velocities, accelerations, multipliers, first-order coordinates and rates.
        end: likewise.
    """
    (q0, v0, a0, f0, y0, r0), (q1, v1, a1, f1, y1, r1) = start, end
    places: list[list[float]] = []
    values: list[list[float]] = []
    slopes: list[list[float]] = []
    for s in parts:
        smooth = s * s * (3.0 - 2.0 * s)
        of_v1 = step * (s * s * s * (1.0 - 0.5 * s) - 0.5 * smooth)
        of_a0 = step * step * (s * s * (0.5 - s * (2.0 / 3.0 - 0.25 * s)) - smooth / 12.0)
        of_a1 = step * step * (s * s * s * (0.25 * s - 1.0 / 3.0) + smooth / 12.0)
        way = step * (s - smooth) - of_v1
        by_slopes = step * s * (1.0 - s) * (1.0 - s), -step * s * s * (1.0 - s)
        places.append([1.0 - smooth, smooth, way, of_v1, of_a0, of_a1])
        values.append([0.0, 0.0, 1.0 - smooth, smooth, *by_slopes])
        slopes.append([0.0, 0.0, 0.0, 0.0, 1.0 - s, s])
    count = len(parts)
    line = np.array(slopes)[:, 4:]
    found = np.array(places + values + slopes) @ np.array([q0, q1, v0, v1, a0, a1])
    rates = np.array(values)[:, 2:] @ np.array([y0, y1, r0, r1])
    forces = line @ np.array([f0, f1])
    of_bodies = [found[:count], found[count : 2 * count], found[2 * count :]]
    return [*of_bodies, forces, rates, line @ np.array([r0, r1])]


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
        now = problem.current
        of_bodies = now.positions, now.velocities, now.accelerations, now.multipliers
        self._current = (*of_bodies, now.first_order, now.rates)
        self._filled = [i for i, part in enumerate(self._current) if len(part)]
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
            self._start = [part.copy() for part in self._current]

    def stepped(self, begin: float, end: float) -> None:
        """Write the rows within an accepted step, s, that ends in the current state."""
        if not self._periods:
            return
        state, times = [part.copy() for part in self._current], self._times(begin, end)
        if times:
            mbs, step = self._task.problem.mbs, end - begin
            settings = mbs.sys["simulationSettings"]
            parts = [(time - begin) / step for time in times]
            rows = between(parts, step, self._start, state)
            self.writing = True
            for number, time in enumerate(times):
                self._put(time, [part[number] for part in rows])
                self._task.solver.FinishStep(mbs, settings)
            self.writing = False
            self._put(end, state)
        self._start = state

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
        for i in self._filled:
            self._current[i][:] = state[i]
        self._task.problem.data.SetTime(time)
