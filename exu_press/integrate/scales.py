"""Scales of errors: given, or found from the motion as it goes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.integrate.problem import Node, Problem
from exu_press.numerics.arrays import Array

__all__ = ["ErrorScales", "FoundScales", "weights"]

FORGOTTEN = 10.0
"""Times in which first accelerations make a speed, after which a part 1/e of it is left to expect:
a constant acceleration has made a sixth of it when that is as much."""

MOVES = 1e-18
"""Part of the kinetic energy that first accelerations will make of coordinates that are no
displacements, above which these move."""

LAST_DIGIT = 1e-17
"""Part of a system's length that it moves by in a hundredth of the run, where the motion of the
whole run is one of last digits."""

OF_FORCES = 0.1
"""Rounding that forces alone feel, over that of constraints."""

LEAST_ENERGY = 1e-4
"""Part of the largest kinetic energy that each node has at least as a scale: of a rotor that
another one is about to set in motion, no step was small enough for its own."""


@dataclass(frozen=True)
class ErrorScales:
    """Scales of errors; None is found from the motion as it goes.

    Attributes:
        speed: of the bodies, m/s; found: the largest so far.
        force: Newton's method balances forces to a part of it, N; found: what accelerates all
            bodies together, at most so far.
        step: usual size of the longest steps, s; errors that films keep may add up to the tolerance
            within some of them. Found: the largest step.
        gravity: acceleration whose forces bodies bear at rest, m/s^2; 0 where it is not known.
    """

    speed: float | None = None
    force: float | None = None
    step: float | None = None
    gravity: float = 0.0


class FoundScales:
    """The scales of a run so far.

    A system at rest has no speed yet: what its first accelerations make of it within a hundredth of
    the run or less counts instead, or on their way through the widest clearance. It fades in a
    tenth of that time: a vibration may have turned back by then, with a fraction of it. In an
    equilibrium first accelerations are rounded forces over masses: what has moved no faster than
    rounded positions do in the first step is still.

    Three angles of a body, about x, then y, then z, turn it by alpha'^2 + beta'^2 + gamma'^2 +
    2 sin(beta) alpha' gamma': where its second angle is near 90 degrees, the other two are fast,
    and all but cancel.

    Attributes:
        speed: m/s.
        force: N.
        inertias: of the coordinates, kg where they are displacements.
        length: of the coordinates whose last digits are rounded, m.
        fixed: whether nothing is to be learnt from the motion.
        gravity: as given, m/s^2.
        rest: speed up to which the system is still, m/s; 0.0 where that is not known.
        rounded: whether what moves no faster was found to be rounding.
        masses: of the nodes, kg, infinite where excluded from the norm; where the system gives
            none, the node's largest kinetic energy over half the square of `speed`, and a
            ten-thousandth of the largest one's at least.
    """

    def __init__(
        self,
        given: ErrorScales,
        problem: Problem,
        longest: float,
        first: float = math.inf,
        stir: float = 0.0,
        floor: float = 0.0,
    ) -> None:
        """Take what is given; the rest is found from `begin` on.

        Args:
            given: scales.
            problem: to be solved.
            longest: step, s, or a hundredth of the run.
            first: step, s.
            stir: accelerations due to rounded positions, times the step's square, over the
                length.
            floor: the least scale of speeds, m/s.
        """
        self._given, self._problem, self._longest = given, problem, longest
        self.gravity = given.gravity
        self._first, self._stir, self._shaken = first, stir, 1.0
        self.rest, self.rounded = 0.0, False
        self.length = problem.length
        self.masses: list[float] = []
        self._ends = [node.start + node.size for node in problem.nodes]
        # nodes with three angles, and each node's inertia times the sine of its second angle
        self._angles = [i for i, node in enumerate(problem.nodes) if node.rotations == 3]
        self._coupled = [0.0 for _ in problem.nodes]
        self.inertias: list[float] = []
        self._own: list[bool] = []
        self._energies: list[float] = []  # twice the largest kinetic energy of each node so far
        self._expected: list[float] = []  # the same, which first accelerations will make of it
        self._expecting = False  # whether one of these is above what was reached
        self._ahead = longest  # time within which they will be, s
        self.speed = self._least = max(given.speed or 0.0, floor)
        self.force = given.force or 0.0
        self.fixed = False

    def begin(self, mass_matrix: Any) -> None:
        """Look at the state from which the run starts, and the mass matrix, (n, n)."""
        problem = self._problem
        self.inertias, masses = weights(problem.nodes, mass_matrix)
        self.masses = masses
        self._turn()
        self._own = [mass == 0.0 for mass in masses]
        self._energies = [0.0 for _ in masses]
        self._expected = [0.0 for _ in masses]
        positions = (problem.current.positions + problem.reference).tolist()
        known = max(self.length, self.norm(positions))
        self.length = known or 1.0  # where all is zero
        if known and True not in self._own:
            self.rest = self._stir * known / self._first
        given = self._given.speed, self._given.force
        self.fixed = not self._angles and True not in self._own and None not in given
        if self.fixed:
            return
        velocities = problem.current.velocities.tolist()
        accelerations = problem.current.accelerations.tolist()
        largest, time = self.norm(accelerations), self._longest
        if problem.joints is not None and largest > 0.0:
            time = min(time, math.sqrt(4.0 * problem.joints.widest / largest))
        self._expect(accelerations, time)
        self.update(velocities, accelerations)
        if not known and self.speed > 0.0:  # as far as it gets in ten runs of a hundred steps
            self.length = min(1.0, 1e3 * self.speed * self._longest)
        if self.rest and self.speed > 0.0:
            self.rounded = self.speed * self._longest <= LAST_DIGIT * self.length
        if self.rest and given == (None, None):
            weighed = math.hypot(*(mass for mass in masses if mass < math.inf))
            self.force = max(self.force, weighed * self._stir * known / self._longest**2)

    def lightest(self) -> float:
        """Return how much less a force moves the lightest coordinate as much as the heaviest.

        By sqrt(J m) of each, as a force F on it gives the body F / sqrt(J m) in the kinetic norm.
        """
        found = [
            math.sqrt(inertia * mass)
            for node, mass, own in zip(self._problem.nodes, self.masses, self._own, strict=True)
            if not own and mass < math.inf
            for inertia in self.inertias[node.start : node.start + node.size]
            if inertia > 0.0
        ]
        return min(found) / max(found) if found else 1.0

    @property
    def alternating(self) -> float:
        """Return what rounded positions make of accelerations, times the step's square, m."""
        return self._stir * self.length * self._shaken

    def shake(self, change: Array, *, impacts: bool) -> None:
        """Be told by how much positions change, (n,), where constraints that round are off by one.

        Where it is much, as in loops of links near their dead centres, so does rounding. Where none
        does, forces feel it alone; those of impacts feel it all.
        """
        size = self.norm(change.tolist())
        self._shaken = max(1.0, size) if size > 0.0 or impacts else OF_FORCES

    @property
    def resting(self) -> bool:
        """Return whether it moves by less than a billionth of its length in the longest step."""
        return self._rests(self.speed)

    def _rests(self, speed: float) -> bool:
        return speed * self._longest <= 1e-9 * self.length

    @property
    def unseen(self) -> bool:
        """Return whether something has moved, but by no more than what rounding moves."""
        return self.rounded and 0.0 < self.speed <= self.rest

    def still(self, velocities: list[float]) -> bool:
        """Return whether nothing has moved yet, in a state either, but what rounding moves."""
        return self.speed <= self.rest and self.norm(velocities) <= self.rest

    def set_out(self, velocities: list[float], accelerations: list[float]) -> None:
        """Be told of a state that a step was tried to, in which a system may have left its rest."""
        self._expect(accelerations, self._longest)
        self.update(velocities, accelerations)

    def _turn(self) -> None:
        """Look at the second angles of bodies that have three."""
        problem = self._problem
        for number in self._angles:
            place = self._ends[number] - 2
            angle = float(problem.current.positions[place] + problem.reference[place])
            self._coupled[number] = self.inertias[place] * math.sin(angle)

    def _expect(self, accelerations: list[float], time: float) -> None:
        """Let the speeds count that accelerations make within a time, s, and less and less."""
        speeds = [time * value for value in accelerations]
        energies = self._sums(speeds, speeds)
        self._expected = [max(energies[i], self._expected[i]) for i in range(len(energies))]
        self._expecting, self._ahead = True, time

    def update(
        self, velocities: list[float], accelerations: list[float], step: float = 0.0
    ) -> None:
        """Be told of a state, at the end of a step (s)."""
        if self.fixed:
            return
        self._turn()
        energies, masses = self._sums(velocities, velocities), self.masses
        speed_2 = expected_2 = 0.0
        moves = False
        for i in range(len(masses)):
            if energies[i] > self._energies[i]:
                self._energies[i] = energies[i]
            if self._own[i]:
                moves = moves or self._energies[i] > MOVES * self._expected[i]
            else:
                speed_2 = max(speed_2, self._energies[i] / masses[i])
                expected_2 = max(expected_2, self._expected[i] / masses[i])
        if self._expecting and (moves or not self._rests(math.sqrt(speed_2))):
            left = math.exp(-2.0 * FORGOTTEN * step / self._ahead)
            self._expected = [left * energy for energy in self._expected]
            both = zip(self._expected, self._energies, strict=True)
            self._expecting = any(expected > reached for expected, reached in both)
        speed_2 = max(speed_2, expected_2)
        if self._given.speed is None:
            self.speed = max(self._least, math.sqrt(speed_2))
            if self.speed == 0.0 and True in self._own:
                self.speed = 1.0  # nothing is displaced: any speed will do, energies count
        square = self.speed * self.speed
        if True in self._own:
            least = LEAST_ENERGY * max(*self._energies, *self._expected)
            for i in range(len(masses)):
                if self._own[i]:
                    largest = max(self._energies[i], self._expected[i], least)
                    masses[i] = largest / square if square > 0.0 else 0.0
        if self._given.force is None:
            squares = 0.0
            for i in range(len(accelerations)):
                force = self.inertias[i] * accelerations[i]
                squares += force * force
            self.force = max(self.force, math.sqrt(squares))

    def norm(self, vector: list[float]) -> float:
        """Return the largest kinetic norm of a body; what is excluded from it may be no number."""
        inertias, masses, ends = self.inertias, self.masses, self._ends
        coupled = self._coupled
        largest = 0.0
        i = 0
        for k in range(len(ends)):  # each step asks for five: `squares` takes twice as long
            total = 0.0
            while i < ends[k]:
                total += inertias[i] * vector[i] * vector[i]
                i += 1
            if coupled[k] != 0.0:
                total += 2.0 * coupled[k] * vector[i - 3] * vector[i - 1]
            mass = masses[k]
            if mass > 0.0 and total > largest * mass:
                largest = total / mass
        return math.sqrt(largest)

    def squares(self, vector: list[float]) -> list[float]:
        """Return the squares of each body's kinetic norm of a vector over all coordinates."""
        squares, masses = self._sums(vector, vector), self.masses
        for i in range(len(squares)):
            mass = masses[i]
            squares[i] = squares[i] / mass if mass > 0.0 else 0.0
        return squares

    def along(self, vector: list[float], velocities: list[float]) -> float:
        """Return the largest part of a vector along a body's velocity, in the kinetic norm."""
        products, squares = self._sums(vector, velocities), self.squares(velocities)
        largest = 0.0
        for product, mass, square in zip(products, self.masses, squares, strict=True):
            if 0.0 < mass < math.inf and square > 0.0:
                largest = max(largest, abs(product) / (mass * math.sqrt(square)))
        return largest

    def _sums(self, one: list[float], other: list[float]) -> list[float]:
        """Return the sum of inertia times both vectors' values over each node's coordinates."""
        found: list[float] = []
        inertias, coupled = self.inertias, self._coupled
        i = 0
        for k, end in enumerate(self._ends):
            total = 0.0
            while i < end:
                total += inertias[i] * one[i] * other[i]
                i += 1
            if coupled[k] != 0.0:
                total += coupled[k] * (one[i - 3] * other[i - 1] + one[i - 1] * other[i - 3])
            found.append(total)
        return found


def weights(nodes: Sequence[Node], mass_matrix: Any) -> tuple[list[float], list[float]]:
    """Return each coordinate's inertia and each node's mass, 0.0 where that is to be found.

    Euler parameters count with the mean of their four inertias, which no rotation changes; three
    angles likewise.

    Args:
        nodes: of the system, in the order of their coordinates.
        mass_matrix: (n, n).
    """
    inertias = np.array(np.diag(mass_matrix), dtype=float) if nodes else np.zeros(0)
    masses: dict[int, float] = {}
    for node in nodes:
        first, last = node.start, node.start + node.size
        if node.rotations:
            turning = slice(last - node.rotations, last)
            inertias[turning] = inertias[turning].mean()
        mass = node.mass
        if mass is None:
            mass = float(inertias[first : first + node.displacements].max(initial=0.0))
            if not inertias[first:last].any():
                mass = math.inf
        masses[node.number] = mass
    for node in nodes:
        if node.mass is None and node.carrier is not None:
            masses[node.number] = masses[node.carrier]
    return inertias.tolist(), [masses[node.number] for node in nodes]
