"""The motion of a run at equally distant instants, and how far another one is from it."""

from collections.abc import Callable

import exudyn as exu
import numpy as np

from exu_press.integrate.output import within
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import FoundScales
from exu_press.numerics.arrays import Array

__all__ = ["Motion", "Watch", "velocities_of"]

INSTANTS = 100
"""At so many the motions of two runs are compared."""

AT_ONCE = 1e-9
"""Time between two instants that are one, over the run's."""

Watch = Callable[[float], str]
"""Time, s -> why the motion has come to its end there, or nothing."""


class Motion:
    """Keeps the motion at equally distant instants.

    Attributes:
        times: of the instants, s.
        rows: positions, velocities and first-order coordinates at those that were reached.
    """

    def __init__(self, problem: Problem, settings: exu.SimulationSettings) -> None:
        """Look at a problem that is about to be solved."""
        start, end = settings.timeIntegration.startTime, settings.timeIntegration.endTime
        self.times = np.linspace(start, end, INSTANTS + 1)[1:]
        self.rows: list[Array] = []
        now = problem.current
        self._state = now.positions, now.velocities, now.accelerations, now.first_order, now.rates
        self._problem = problem
        self._before: tuple[float, list[Array]] | None = None
        self._close = AT_ONCE * (end - start)

    def beside(self, watch: Watch) -> Watch:
        """Return a watch that keeps the motion, too."""

        def stepped(time: float) -> str:
            self._stepped(time)
            return watch(time)

        return stepped

    def _stepped(self, time: float) -> None:
        """Keep what lies within the step that ends in the current state at a time, s."""
        end = [np.array(part) for part in self._state]
        while self._before is not None and len(self.rows) < INSTANTS:
            begin, start = self._before
            at = self.times[len(self.rows)]
            if at > time + self._close:
                break
            motion, _, first_order = within(min((at - begin) / (time - begin), 1.0), time - begin)
            both = np.reshape(motion[:12], (2, 6)) @ np.array(start[:3] + end[:3])
            one = np.array(first_order[:4]) @ np.array(start[3:] + end[3:])
            self.rows.append(np.concatenate([*both, one]))
        self._before = time, end

    def apart(self, other: Array, scales: FoundScales) -> Array:
        """Return how far the motion is from another one, relative to the scales, (instants,).

        Args:
            other: rows of its motion, of these instants or the first ones of them.
            scales: of errors.
        """
        problem, count = self._problem, min(len(self.rows), len(other))
        size, found = len(problem.reference), np.zeros(count)
        if not count:
            return found
        one, other = np.array(self.rows[:count]), other[:count]
        if size:
            missed = velocities_of(problem, one) - velocities_of(problem, other)
            starts = [node.start for node in problem.nodes]
            squares = np.add.reduceat(missed**2 * scales.inertias, starts, axis=1)
            masses = np.array(scales.masses)
            heavy = masses > 0.0
            largest = np.max(squares[:, heavy] / masses[heavy], axis=1, initial=0.0)
            found[:] = np.sqrt(largest) / (scales.speed or 1.0)
        first_order = one[:, 2 * size :]
        most = np.abs(first_order).max(axis=0, initial=0.0)
        missed = np.abs(first_order - other[:, 2 * size :]) / np.where(most > 0.0, most, 1.0)
        found[:] = np.maximum(found, missed.max(axis=1, initial=0.0))
        return found


def velocities_of(problem: Problem, rows: Array) -> Array:
    """Return velocities whose squares add up to kinetic energies, (instants, coordinates).

    Three angles, about x, then y, then z, have the angular velocity about the body's own axes
    instead: rates of two motions that are next to each other are far apart where the second angle
    is near 90 degrees.

    Args:
        problem: whose motion it is.
        rows: positions and velocities, and what may follow, (instants, 2 coordinates or more).
    """
    size = len(problem.reference)
    velocities: Array = np.array(rows[:, size : 2 * size])
    for node in problem.nodes:
        if node.rotations == 3:
            turning = slice(node.start + node.size - 3, node.start + node.size)
            _, b, c = (rows[:, turning] + problem.reference[turning]).T
            of_a, of_b, of_c = np.array(velocities[:, turning].T)
            along = np.cos(b) * np.cos(c) * of_a + np.sin(c) * of_b
            across = np.cos(c) * of_b - np.cos(b) * np.sin(c) * of_a
            velocities[:, turning] = np.array([along, across, np.sin(b) * of_a + of_c]).T
    return velocities
