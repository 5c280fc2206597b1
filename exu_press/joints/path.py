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
"""

import math
from typing import Any

__all__ = ["Path"]

Vector = tuple[float, ...]

FADING = 0.1
"""s, in which a drift falls to 1/e: contacts of the press last 60 ms, and errors always to one side
would add up, in one that lasts a hundred revolutions, to a tenth of the penetration."""

SMALL_DRIFT = 0.1
"""Part of a penetration up to which a step's error is known well enough to be taken out."""


class Path:
    """Eccentricity and its rates where the last accepted step ended.

    Attributes:
        drift: by how much the penetration is larger than its rate's integral, m.
        eccentricity: m; empty at first.
        velocity: its rate, m/s.
        acceleration: mean rate of that in the last step, m/s^2; empty at first.
    """

    def __init__(self) -> None:
        self.drift = 0.0
        self.eccentricity: Vector = ()
        self.velocity: Vector = ()
        self.acceleration: Vector = ()

    def memory(self) -> list[Any]:
        """Return its memory."""
        parts = self.eccentricity, self.velocity, self.acceleration
        return [self.drift, *(list(part) for part in parts)]

    def recall(self, memory: list[Any]) -> None:
        """Take over another's memory."""
        self.drift = memory[0]
        self.eccentricity, self.velocity = tuple(memory[1]), tuple(memory[2])
        self.acceleration = tuple(memory[3])

    def missed(self, eccentricity: Vector, velocity: Vector, step: float) -> tuple[float, float]:
        """Return the error of a step's (s) change of eccentricity, and its part along it, m."""
        half, twelfth = 0.5 * step, step / 12.0
        start, last, before = self.eccentricity, self.velocity, self.acceleration
        square = along = distance = 0.0
        for i in range(len(start)):
            change = half * (velocity[i] + last[i])
            if before:
                change -= twelfth * (velocity[i] - last[i] - step * before[i])
            missed = eccentricity[i] - start[i] - change
            square += missed * missed
            along += missed * eccentricity[i]
            distance += eccentricity[i] * eccentricity[i]
        return math.sqrt(square), along / math.sqrt(distance) if distance > 0.0 else 0.0

    def go_on(self, eccentricity: Vector, velocity: Vector, step: float, depth: float) -> None:
        """Take a step (s) as done that ends at an eccentricity, this deep (m) in contact."""
        if depth <= 0.0:
            self.drift = 0.0
        elif self.acceleration:
            drift = math.exp(-step / FADING) * self.drift
            drift += self.missed(eccentricity, velocity, step)[1]
            if abs(drift) < SMALL_DRIFT * depth:
                self.drift = drift
        if self.eccentricity and step > 0.0:
            self.acceleration = tuple(
                [(velocity[i] - self.velocity[i]) / step for i in range(len(eccentricity))]
            )
        self.eccentricity, self.velocity = eccentricity, velocity
