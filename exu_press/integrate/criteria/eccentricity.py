"""Eccentricities and penetrations of clearance joints."""

import math

from exu_press.joints.joint import ClearanceJoint

__all__ = ["JointError"]

LEAST_PENETRATION = 1e-3
"""Over the clearance, up to which a penetration counts as this."""


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
        penetration: float,
    ) -> None:
        """Take a joint and its scales.

        Args:
            joint: whose eccentricity is looked at.
            limit: the error of a step that counts as 1, m.
            drift: the same over the step, m/s, where a film alone lies between the surfaces: it
                keeps what each step leaves, always on the same side, so that errors add up.
            rounding: of positions, as it alternates, m; no error below it counts as 1.
            penetration: its allowed error, over itself, as a part of the same of an
                eccentricity, over the clearance.
        """
        self._joint = joint
        self._penetration = penetration
        self._limit = limit
        self._rounding = rounding
        self._drift = drift if joint.contact_onset == math.inf else math.inf

    def error(self, step: float, left: float = 0.0) -> float:
        """Return the error of a step (s) that ends where the joint was last asked for its force.

        Args:
            step: s.
            left: position error that its constraints leave, m.
        """
        joint, rounding = self._joint, max(self._rounding, left)
        place = joint.eccentricity
        missed, along = joint.path.missed(place, joint.relative_velocity, step)
        error = missed / max(min(self._limit, self._drift * step), rounding)
        depth = math.hypot(*place) - joint.contact_onset
        if depth > 0.0:
            relative = max(LEAST_PENETRATION, self._penetration * depth / joint.clearance)
            error = max(error, abs(along) / max(relative * self._limit, rounding))
        return error
