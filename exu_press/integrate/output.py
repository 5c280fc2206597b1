"""Rows of sensors and of the solution file at equal distances in time, whatever the steps are."""

import math
from typing import Any

import numpy as np

from exu_press.integrate.places import Places
from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array

__all__ = ["OutputGrid", "within"]

AT_ONCE = 1e-10
"""Distance below which two instants are one for Exudyn's output, s."""


def within(part: float, step: float) -> tuple[list[float], list[float], list[float]]:
    """Return the weights of a step's ends in the state at an instant within it.

    Velocities and first-order coordinates follow the cubic through their values and slopes at both
    ends; positions are the integral of velocities, and what that misses of their change is spread
    smoothly; accelerations, forces of constraints and rates lie on lines.

    Args:
        part: of the step, from 0 to 1.
        step: s.

    Returns:
        row by row: of positions, velocities and accelerations at the start, then at the end, in the
        same three, (3, 6); of forces of constraints, (1, 2); of first-order coordinates and rates,
        (2, 4).
    """
    s, rest = part, 1.0 - part
    smooth = s * s * (3.0 - 2.0 * s)
    of_v1 = step * (s * s * s * (1.0 - 0.5 * s) - 0.5 * smooth)
    of_a0 = step * step * (s * s * (0.5 - s * (2.0 / 3.0 - 0.25 * s)) - smooth / 12.0)
    of_a1 = step * step * (s * s * s * (0.25 * s - 1.0 / 3.0) + smooth / 12.0)
    way = step * (s - smooth) - of_v1
    slope0, slope1 = step * s * rest * rest, -step * s * s * rest
    motion = [1.0 - smooth, way, of_a0, smooth, of_v1, of_a1]
    motion += [0.0, 1.0 - smooth, slope0, 0.0, smooth, slope1]
    motion += [0.0, 0.0, rest, 0.0, 0.0, s]
    return motion, [rest, s], [1.0 - smooth, slope0, smooth, slope1, 0.0, rest, 0.0, s]


class OutputGrid:
    """Lets Exudyn write its rows at multiples of the settings' periods.

    Exudyn writes a row at the first step's end behind a multiple. With steps of one size that is
    the multiple itself. With a tolerance rows would be at uneven distances, of which no spectrum
    can be made. So the state within the step is put in the place of its end, and Exudyn finishes a
    step there; then the end is put back.

    Not with clearance joints, whose forces remember where they were last asked.
    """

    def __init__(self, task: Task, places: Places) -> None:
        """Look at a task, and at the places of its joints on cables."""
        self._task, self._places, problem = task, places, task.problem
        self._active = not task.fixed and problem.joints is None
        now = problem.current
        self._state: list[list[Array]] = [
            [now.positions, now.velocities, now.accelerations],
            [now.multipliers],
            [now.first_order, now.rates],
        ]
        # at both ends of a step, a row each: a group of parts at the start, then at the end
        self._ends: list[Array] = []
        self._filled = [i for i, parts in enumerate(self._state) if len(parts[0])]
        self._periods: list[float] = []
        self._numbers: list[int] = []  # of the next multiple of each
        self._next = math.inf  # of these, the first instant, s
        self._settings: Any = None
        self.writing = False

    def begin(self) -> None:
        """Look at the settings, and at the state from which the run starts."""
        mbs: Any = self._task.problem.mbs
        self._settings = mbs.sys["simulationSettings"]
        output = self._settings.solution
        periods = [output.file.writePeriod] if output.file.write else []
        if mbs.systemData.NumberOfSensors():
            periods.append(output.sensors.writePeriod)
        least = max(self._task.smallest, AT_ONCE)  # below it, as with 0.0, every step is a row
        self._periods = [period for period in periods if period > least and self._active]
        self._numbers = [1 for _ in self._periods]
        if self._periods:
            self._next = self._task.start + min(self._periods)
            self._ends = [np.tile(np.array(parts), (2, 1)) for parts in self._state]

    def stepped(self, begin: float, end: float) -> None:
        """Write the rows within an accepted step, s, that ends in the current state."""
        if end <= self._next - AT_ONCE:
            return
        times = self._times(end)
        if times:
            self._fill(at_end=True)
            self._write(times, begin, end)

    def next_step(self, end: float) -> None:
        """Be told of the latest end, s, of the step that begins in the current state."""
        if end > self._next - AT_ONCE:
            self._fill(at_end=False)

    def _write(self, times: list[float], begin: float, end: float) -> None:
        """Write rows at some instants within a step, s."""
        parts = [(time - begin) / (end - begin) for time in times]
        weights: tuple[list[float], ...] = [], [], []
        for part in parts:
            for flat, more in zip(weights, within(part, end - begin), strict=True):
                flat += more
        rows: list[Array] = []  # (instants times quantities, coordinates), for each group
        for i in self._filled:
            ends = self._ends[i]
            rows.append(np.dot(np.array(weights[i]).reshape(-1, len(ends)), ends))
        self.writing = True
        for number in range(len(times)):
            self._places.within(parts[number])
            self._put(times[number], rows, number)
            self._task.solver.FinishStep(self._task.problem.mbs, self._settings)
        self.writing = False
        self._places.within(1.0)
        self._put(end, [self._ends[i] for i in self._filled], 1)

    def _fill(self, *, at_end: bool) -> None:
        """Keep the current state as that at the end of a step, or at the start of the next one."""
        for i in self._filled:
            ends, parts = self._ends[i], self._state[i]
            first = len(parts) if at_end else 0
            for k in range(len(parts)):
                ends[first + k] = parts[k]

    def _times(self, end: float) -> list[float]:
        """Return the multiples before a step's end, which Exudyn writes itself."""
        found: list[float] = []
        for i, period in enumerate(self._periods):
            time = self._task.start + self._numbers[i] * period
            while time < end + AT_ONCE:
                if time < end - AT_ONCE:
                    found.append(time)
                self._numbers[i] += 1
                time = self._task.start + self._numbers[i] * period
            self._next = time if i == 0 else min(self._next, time)
        return sorted(set(found)) if len(self._periods) > 1 else found

    def _put(self, time: float, rows: list[Array], number: int) -> None:
        """Set the current state to one of several, each with as many rows as there are parts."""
        for j in range(len(self._filled)):
            parts = self._state[self._filled[j]]
            first = number * len(parts)
            for k in range(len(parts)):
                parts[k][:] = rows[j][first + k]
        self._task.problem.data.SetTime(time)
