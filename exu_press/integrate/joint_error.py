"""The error of a clearance joint's eccentricity in one step; compiled like the joints."""

import math

from exu_press.integrate.tuning import Tuning
from exu_press.joints.joint import ClearanceJoint

__all__ = ["JointError"]

Vector = tuple[float, ...]


class JointError:
    """The eccentricity's error of one clearance joint: its way less that of its velocities.

    A journal's position is the integral of its bodies' velocities, and nothing in a film or in free
    flight mends it. The corrected trapezoidal rule gives that integral,
    h (v0 + v1) / 2 - h^2 (change of the mean acceleration) / 12. Where surfaces touch, its part
    across them is an error of the penetration, and held against that too.

    Attributes:
        place: eccentricity where the last accepted step ended, m; empty at first.
        velocity: its rate there, m/s.
        acceleration: mean rate of that in the last step, m/s^2; empty at first.
    """

    def __init__(
        self,
        joint: ClearanceJoint,
        limit: float,
        drift: float,
        rounding: float,
        tuning: Tuning,
    ) -> None:
        """Take a joint and its scales.

        Args:
            joint: whose eccentricity is looked at.
            limit: the error of a step that counts as 1, m.
            drift: the same over the step, m/s, where a film alone lies between the surfaces: it
                keeps what each step leaves, always on the same side, so that errors add up.
            rounding: what Newton's method leaves of positions, m; no error below it counts as 1.
            tuning: numbers.
        """
        self._joint = joint
        self._limit = limit
        self._rounding = rounding
        self._least, self._penetration = tuning.least_penetration, tuning.penetration
        self._drift = drift if joint.reach == math.inf else math.inf
        self.place: Vector = ()
        self.velocity: Vector = ()
        self.acceleration: Vector = ()
        self._tried: tuple[Vector, Vector, Vector] = (), (), ()  # the same, of the step tried

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends where the joint was last asked for its force."""
        now, velocity = self._joint.eccentricity, self._joint.relative_velocity
        if not self.place:
            self._tried = now, velocity, ()
            return 0.0
        place, last, before = self.place, self.velocity, self.acceleration
        mean = [(velocity[i] - last[i]) / step for i in range(len(now))]
        self._tried = now, velocity, tuple(mean)
        half, twelfth = 0.5 * step, step * step / 12.0
        square = along = excess = 0.0
        for i in range(len(now)):
            way = half * (velocity[i] + last[i])
            if before:
                way -= twelfth * (mean[i] - before[i])
            missed = now[i] - place[i] - way
            square += missed * missed
            along += missed * now[i]
            excess += now[i] * now[i]
        error = math.sqrt(square) / max(min(self._limit, self._drift * step), self._rounding)
        distance = math.sqrt(excess)
        depth = distance - self._joint.reach
        if depth > 0.0:
            relative = max(self._least, self._penetration * depth / self._joint.clearance)
            limit = max(relative * self._limit, self._rounding)
            error = max(error, abs(along) / distance / limit)
        return error

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self.place, self.velocity, self.acceleration = self._tried
