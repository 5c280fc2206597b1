"""The turn of velocities to one side until the run ends, by which errors of speeds grow."""

import math

from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import FoundScales

__all__ = ["Turning"]

LOOK_EVERY = 8
"""Steps after which turning velocities are looked at; in fewer they turn by little."""


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
        # of each point: its number among the nodes, and its coordinates
        self._points: list[tuple[int, range]] = []
        self._roots = [math.sqrt(inertia) for inertia in scales.inertias]
        # of each pair of a point's coordinates: the angle so far, times squares of speeds
        self._turned: list[list[float]] = []
        for i, node in enumerate(problem.nodes):
            if node.displacements:
                size = node.size if node.quaternion else node.displacements
                self._points.append((i, range(node.start, node.start + size)))
                self._turned.append([0.0] * (size * (size - 1) // 2))
        self._squares = 0.0  # of speeds, over time
        self._time = self._looked = 0.0
        self._steps = 0
        self._angle = 0.0

    def stepped(self, step: float) -> float:
        """Return the angle still to come, rad, after an accepted step (s)."""
        self._time += step
        self._steps += 1
        if not self._steps % LOOK_EVERY:
            self._angle = self._look(self._time - self._looked)
            self._looked = self._time
        return self._angle

    def _look(self, span: float) -> float:
        """Return the angle still to come, rad, after a span of time (s) with these velocities."""
        velocities: list[float] = self._state.velocities.tolist()
        accelerations: list[float] = self._state.accelerations.tolist()
        masses, roots = self._scales.masses, self._roots
        fastest = self._tolerance * self._scales.speed
        fastest *= fastest
        turned = 0.0
        for number in range(len(self._points)):
            node, places = self._points[number]
            mass = masses[node]
            if not 0.0 < mass < math.inf:
                continue
            speeds = [roots[i] * velocities[i] for i in places]
            changes = [roots[i] * accelerations[i] for i in places]
            angles, part = self._turned[number], span / mass
            size = len(speeds)
            square = angle = 0.0
            pair = 0
            for j in range(size):
                square += speeds[j] * speeds[j]
                for k in range(j + 1, size):
                    found = angles[pair] + part * (speeds[j] * changes[k] - speeds[k] * changes[j])
                    angles[pair] = found
                    angle += found * found
                    pair += 1
            fastest, turned = max(fastest, square / mass), max(turned, angle)
        self._squares += span * fastest
        if self._squares == 0.0:
            return 0.0
        rest = min(self._duration - self._time, self._foreseen * self._time)
        return max(0.0, rest) * math.sqrt(turned) / self._squares
