"""The way of a journal: what a step's change of eccentricity misses of its rate's integral.

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

__all__ = ["Path"]

Vector = tuple[float, ...]

SMALL = 0.1
"""Of a penetration, up to which what a step missed of it is known well enough to be taken out."""


class Path:
    """Eccentricity and its rates where the last accepted step ended.

    Attributes:
        drift: by how much the penetration is larger than its rate's integral, m.
        place: eccentricity, m; empty at first.
        velocity: its rate, m/s.
        acceleration: mean rate of that in the last step, m/s^2; empty at first.
    """

    def __init__(self) -> None:
        """Start without a step."""
        self.drift = 0.0
        self.place: Vector = ()
        self.velocity: Vector = ()
        self.acceleration: Vector = ()

    def missed(self, place: Vector, velocity: Vector, step: float) -> tuple[float, float]:
        """Return what a step (s) to a place misses of its way, and of that the part along it, m."""
        half, twelfth = 0.5 * step, step / 12.0
        start, last, before = self.place, self.velocity, self.acceleration
        square = along = distance = 0.0
        for i in range(len(start)):
            way = half * (velocity[i] + last[i])
            if before:
                way -= twelfth * (velocity[i] - last[i] - step * before[i])
            missed = place[i] - start[i] - way
            square += missed * missed
            along += missed * place[i]
            distance += place[i] * place[i]
        return math.sqrt(square), along / math.sqrt(distance) if distance > 0.0 else 0.0

    def go_on(self, place: Vector, velocity: Vector, step: float, depth: float) -> None:
        """Take a step (s) to a place, this deep (m) in contact, as done."""
        if depth <= 0.0:
            self.drift = 0.0
        elif self.acceleration:
            along = self.missed(place, velocity, step)[1]
            if abs(self.drift + along) < SMALL * depth:
                self.drift += along
        if self.place and step > 0.0:
            self.acceleration = tuple(
                [(velocity[i] - self.velocity[i]) / step for i in range(len(place))]
            )
        self.place, self.velocity = place, velocity
