"""Scales of errors: given, or the largest values of the motion so far."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.integrate.system import Node, System

__all__ = ["ErrorScales", "RunningScales", "kinetic_weights"]


@dataclass(frozen=True)
class ErrorScales:
    """Scales of errors; None is the largest value of the motion so far.

    Attributes:
        speed: of the bodies, m/s.
        force: Newton's method balances forces to a part of it, N; else the force that accelerates
            all bodies together.
        step: usual size of the longest steps, s; errors that films keep may add up to the tolerance
            within some of them. Else the largest step.
        gravity: acceleration whose forces bodies bear at rest, m/s^2; 0 where it is not known.
    """

    speed: float | None = None
    force: float | None = None
    step: float | None = None
    gravity: float = 0.0


class RunningScales:
    """The scales of a run so far, and the kinetic norm.

    The kinetic norm of a body's displacements dx and rotations dphi is sqrt(|dx|^2 + (J/m) dphi^2),
    of a system the largest one of its bodies. At rest the speed counts that first accelerations
    make within the longest step, or on their way through the widest clearance.

    Attributes:
        speed: m/s.
        force: N.
        inertias: of the coordinates, kg where they are displacements.
        masses: of the nodes, kg, infinite where excluded from the norm.
        ends: of the nodes' coordinates.
        length: of the coordinates whose last digits are rounded, m.
        gravity: m/s^2, as in `ErrorScales`.
        roundoff: error of positions that rounded positions of the step before make, m.
        updates: whether the scales follow the motion.
        roundoff_speed: up to which the system is at rest in its first step, m/s.
    """

    def __init__(
        self,
        scales: ErrorScales,
        system: System,
        longest: float,
        first: float = math.inf,
        rounding: float = 0.0,
    ) -> None:
        """Take the given scales, the longest and the first step, s.

        Rounding is that of accelerations due to positions, times the step's square, over the
        length.
        """
        self._prescribed, self._system, self._longest = scales, system, longest
        self._first, self._rounding = first, rounding
        self.gravity, self.length = scales.gravity, system.length
        self.roundoff = self.roundoff_speed = 0.0
        self.masses: list[float] = []
        self.inertias: list[float] = []
        self.ends = [node.start + node.size for node in system.nodes]
        self.speed = scales.speed or 0.0
        self.force = scales.force or 0.0
        self.updates = scales.speed is None or scales.force is None

    def begin(self, mass_matrix: Any) -> None:
        """Look at the state from which the run starts, and the mass matrix, (n, n)."""
        system, state = self._system, self._system.current
        self.inertias, self.masses = kinetic_weights(system.nodes, mass_matrix, self.length)
        positions = (state.positions + system.reference).tolist()
        self.length = max(self.length, self.norm(positions)) or 1.0  # where all is zero
        self.roundoff = self._rounding * self.length
        self.roundoff_speed = self.roundoff / self._first
        if not self.updates:
            return
        accelerations = state.accelerations.tolist()
        largest, time = self.norm(accelerations), self._longest
        if system.joints is not None and largest > 0.0:
            time = min(time, math.sqrt(4.0 * system.joints.widest / largest))
        self.update([time * value for value in accelerations], accelerations)
        self.update(state.velocities.tolist(), accelerations)

    def update(self, velocities: list[float], accelerations: list[float]) -> None:
        """Take over the velocities and accelerations of a state where they are the largest."""
        if self._prescribed.speed is None:
            self.speed = max(self.speed, self.norm(velocities))
        if self._prescribed.force is None:
            forces = [i * a for i, a in zip(self.inertias, accelerations, strict=True)]
            self.force = max(self.force, math.hypot(*forces))

    def norm(self, vector: list[float]) -> float:
        """Return the largest kinetic norm of a body; what is excluded from it may be no number."""
        inertias, masses, ends = self.inertias, self.masses, self.ends
        largest = 0.0
        i = 0
        for k in range(len(ends)):
            total = 0.0
            while i < ends[k]:
                total += inertias[i] * vector[i] * vector[i]
                i += 1
            mass = masses[k]
            if mass > 0.0 and total > largest * mass:
                largest = total / mass
        return math.sqrt(largest)


def kinetic_weights(
    nodes: Sequence[Node], mass_matrix: Any, length: float = 1.0
) -> tuple[list[float], list[float]]:
    """Return each coordinate's inertia and each node's mass.

    Euler parameters count with the mean of their four inertias, which no rotation changes; three
    angles likewise. Coordinates without displacements count as displacements at a radius of the
    system's length; those without inertia are excluded.
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
            if mass == 0.0:
                mass = float(inertias[first:last].max(initial=0.0)) / (length or 1.0) ** 2
        masses[node.number] = mass or math.inf
    for node in nodes:
        if node.mass is None and node.carrier is not None:
            masses[node.number] = masses[node.carrier]
    return inertias.tolist(), [masses[node.number] for node in nodes]
