"""Local error of eccentricities and penetrations of clearance joints."""

import math

from exu_press.integrate.newton_filter import NewtonFilter
from exu_press.integrate.task import Task
from exu_press.joints.joint import ClearanceJoint

__all__ = ["EccentricityError"]


class EccentricityError:
    """Change of a joint's eccentricity less the integral of its rate, over its limit.

    See `exu_press.joints.path`. Where surfaces touch, its component along the eccentricity is an
    error of the penetration, and held against that too. A film alone keeps what each step leaves,
    always on the same side, so that errors add up: the limit goes with the step there.

    Attributes:
        joint: whose eccentricity it is.
    """

    def __init__(
        self,
        task: Task,
        joint: ClearanceJoint,
        newton_filter: NewtonFilter,
        allowed: float,
        penetration: float,
    ) -> None:
        """Take a joint; allowed is an error in one step over the clearance.

        That of a penetration over itself is a part of it.
        """
        tuning = task.tuning
        self.joint, self._scales, self._filter = joint, task.scales, newton_filter
        self._penetration, self._least = penetration, tuning.least_penetration
        self._limit = allowed * joint.clearance  # m
        per_time = task.tolerance / (tuning.kept_steps * task.usual)
        alone = joint.contact_onset == math.inf
        self._drift = per_time * joint.clearance if alone else math.inf  # m/s

    def restart(self) -> None:
        """Begin with the current state; the joint remembers its path itself."""

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends where the joint was last asked for its force."""
        error = self._relative_error(step, self._scales.roundoff)
        if error > 1.0:
            roundoff = self._filter.roundoff_of_constraints()
            error = self._relative_error(step, max(self._scales.roundoff, roundoff))
        return error

    def accept_step(self) -> None:
        """Do nothing: the joint remembers its path itself."""

    def _relative_error(self, step: float, roundoff: float) -> float:
        """Return the error of a step (s) where no error below a roundoff, m, counts as 1."""
        joint = self.joint
        eccentricity = joint.eccentricity
        missed, along = joint.path.quadrature_error(eccentricity, joint.relative_velocity, step)
        error = missed / max(min(self._limit, self._drift * step), roundoff)
        depth = math.hypot(*eccentricity) - joint.contact_onset
        if depth > 0.0:
            relative = max(self._least, self._penetration * depth / joint.clearance)
            error = max(error, abs(along) / max(relative * self._limit, roundoff))
        return error
