"""The path of a journal: the part of its rate's integral that a step's change misses.

A journal's position is the integral of its bodies' velocities, and nothing in a contact's damping,
a film or free flight mends what an integration misses of it. The corrected trapezoidal rule gives
that integral to the fourth order,

    h (v0 + v1) / 2 - h^2 (change of the mean acceleration) / 12,

one order better than generalized-alpha's own positions. Where surfaces touch, what was missed
across them is taken out of the penetration that the contact law responds to, as long as the contact
lasts (local extrapolation: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I,
II.4). A damped contact remembers its penetration for milliseconds and ends it with an impact that
amplifies its error a thousandfold.

The correction acts a step late. A contact with next to no damping would be set vibrating by that:
steps h amplify a vibration of the angular frequency omega by up to 8 % each at omega h = 2. So the
correction fades with the contact's own memory, the damping over the stiffness of its force: with
the factor exp(-h / memory) generalized-alpha damps every vibration, at all steps and dampings
(tests/joints/test_path.py).
"""

import math
from dataclasses import dataclass
from typing import Any

__all__ = ["Path"]

Vector = tuple[float, ...]

SMALL_DRIFT = 0.1
"""Part of a penetration up to which a step's error is known well enough to be taken out."""


@dataclass
class Path:
    """Eccentricity and its rates where the last accepted step ended.

    Attributes:
        drift: by how much the penetration is larger than its rate's integral, m.
        eccentricity: m; empty at first.
        velocity: its rate, m/s.
        acceleration: mean rate of that in the last step, m/s^2; empty at first.
    """

    drift: float = 0.0
    eccentricity: Vector = ()
    velocity: Vector = ()
    acceleration: Vector = ()

    def memory(self) -> list[Any]:
        """Return its memory."""
        vectors = self.eccentricity, self.velocity, self.acceleration
        return [self.drift, *(list(vector) for vector in vectors)]

    def recall(self, memory: list[Any]) -> None:
        """Take over another's memory."""
        self.drift = memory[0]
        self.eccentricity, self.velocity = tuple(memory[1]), tuple(memory[2])
        self.acceleration = tuple(memory[3])

    def quadrature_error(
        self, eccentricity: Vector, velocity: Vector, step: float
    ) -> tuple[float, float]:
        """Return the error of a step's (s) change of eccentricity: its size and radial part, m."""
        half, twelfth = 0.5 * step, step / 12.0
        start, last, acceleration = self.eccentricity, self.velocity, self.acceleration
        square = along = distance = 0.0
        for i in range(len(start)):
            change = half * (velocity[i] + last[i])
            if acceleration:
                change -= twelfth * (velocity[i] - last[i] - step * acceleration[i])
            error = eccentricity[i] - start[i] - change
            square += error * error
            along += error * eccentricity[i]
            distance += eccentricity[i] * eccentricity[i]
        return math.sqrt(square), along / math.sqrt(distance) if distance > 0.0 else 0.0

    def go_on(
        self, eccentricity: Vector, velocity: Vector, step: float, depth: float, memory: float
    ) -> None:
        """Take a step as done.

        Args:
            eccentricity: at its end, m.
            velocity: rate of the eccentricity, m/s.
            step: s.
            depth: penetration, m; none where it is not positive.
            memory: time in which the contact forgets a penetration, its damping over its
                stiffness, s.
        """
        if depth <= 0.0 or memory <= 0.0:
            self.drift = 0.0
        elif self.acceleration:
            error = self.quadrature_error(eccentricity, velocity, step)[1]
            drift = math.exp(-step / memory) * (self.drift + error)
            if abs(drift) < SMALL_DRIFT * depth:
                self.drift = drift
        if self.eccentricity and step > 0.0:
            self.acceleration = tuple(
                [(velocity[i] - self.velocity[i]) / step for i in range(len(eccentricity))]
            )
        self.eccentricity, self.velocity = eccentricity, velocity
