"""The error of a clearance joint's eccentricity in one step; compiled like the joints."""

import math

from exu_press.integrate.tuning import Tuning
from exu_press.joints.joint import ClearanceJoint

__all__ = ["JointError"]


class JointError:
    """The eccentricity's error of one clearance joint: its way less that of its velocities.

    See `exu_press.joints.path`. Where surfaces touch, its part across them is an error of the
    penetration, and held against that too.
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

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends where the joint was last asked for its force."""
        joint = self._joint
        place = joint.eccentricity
        missed, along = joint.path.missed(place, joint.relative_velocity, step)
        error = missed / max(min(self._limit, self._drift * step), self._rounding)
        depth = math.hypot(*place) - joint.reach
        if depth > 0.0:
            relative = max(self._least, self._penetration * depth / joint.clearance)
            error = max(error, abs(along) / max(relative * self._limit, self._rounding))
        return error
