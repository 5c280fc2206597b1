"""The turn of velocities to one side until the run ends, by which errors of speeds grow."""

import math
from typing import Any

import numpy as np

from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import FoundScales
from exu_press.numerics.arrays import Array

__all__ = ["Turning"]

LOOK_EVERY = 8
"""Steps after which turning velocities are looked at, as that takes half as long as a step."""


class Turning:
    """The angle by which a body's velocity turns to one side, as a crank's, until the run ends.

    What a speed is off by makes the place be off by more and more, unless the motion comes back, as
    a vibration does. After a turn by an angle, in radians, the velocity there is off by so many
    times the error of the speed. So speeds may be off by less, if velocities are to turn by more
    than a radian yet; what is off across the velocity turns with it, and adds up to nothing.

    The angle so far is that between velocity and acceleration over time, with its sign, in the
    kinetic norm; each instant counts with the square of the largest speed then, as what nearly
    rests has no direction; nothing below the tolerance counts, as it cannot be off by more. The
    velocities of Euler parameters turn by half of what the body does.
    """

    def __init__(
        self,
        problem: Problem,
        scales: FoundScales,
        duration: float,
        foreseen: float,
        tolerance: float = 0.0,
    ) -> None:
        """Follow the bodies of a system.

        Args:
            problem: to be solved.
            scales: of the motion.
            duration: of the run, s.
            foreseen: over the time so far, for how long the motion is believed to go on likewise.
            tolerance: of the run.
        """
        self._tolerance = tolerance
        self._state, self._scales = problem.current, scales
        self._duration, self._foreseen = duration, foreseen
        points = [(i, node) for i, node in enumerate(problem.nodes) if node.displacements]
        sizes = [node.size if node.quaternion else node.displacements for _, node in points]
        count, most = len(points), max(sizes, default=0)
        self._nodes = np.array([i for i, _ in points], dtype=int)
        self._places = np.zeros((count, most), dtype=int)  # of coordinates
        self._roots = np.zeros((count, most))  # of inertias
        for i, (_, node) in enumerate(points):
            places = range(node.start, node.start + sizes[i])
            self._places[i, : sizes[i]] = places
            self._roots[i, : sizes[i]] = [math.sqrt(scales.inertias[k]) for k in places]
        self._turned = np.zeros((count, most, most))  # times squares of speeds
        self._masses: list[float] = []
        self._weights = self._roots  # of coordinates, with these masses
        self._squares = 0.0  # of speeds, over time
        self._time = self._looked = 0.0
        self._steps = 0
        self._angle = 0.0

    def _largest(self, values: Array, axes: Any) -> float:
        """Return the largest sum of squares over some axes; NumPy's methods take twice as long."""
        return float(np.maximum.reduce(np.add.reduce(np.square(values), axes)))

    def stepped(self, step: float) -> float:
        """Return the angle still to come, rad, after an accepted step (s)."""
        self._time += step
        self._steps += 1
        if len(self._nodes) and not self._steps % LOOK_EVERY:
            self._angle = self._look(self._time - self._looked)
            self._looked = self._time
        return self._angle

    def _look(self, span: float) -> float:
        """Return the angle still to come, rad, after a span of time (s) with these velocities."""
        masses = self._scales.masses
        if masses != self._masses:  # as where they are found from the motion
            self._masses = list(masses)
            mass = np.array(masses)[self._nodes]
            self._weights = self._roots / np.sqrt(np.where(mass > 0.0, mass, math.inf))[:, None]
        speeds = self._weights * self._state.velocities[self._places]
        changes = self._weights * self._state.accelerations[self._places]
        least = self._tolerance * self._scales.speed
        self._squares += span * max(self._largest(speeds, 1), least * least)
        if self._squares == 0.0:
            return 0.0
        products = span * speeds[:, :, None] * changes[:, None, :]
        self._turned += products - products.transpose(0, 2, 1)
        turned = math.sqrt(0.5 * self._largest(self._turned, (1, 2)))
        rest = min(self._duration - self._time, self._foreseen * self._time)
        return max(0.0, rest) * turned / self._squares
