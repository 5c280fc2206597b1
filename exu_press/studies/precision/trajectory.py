"""The result of every solver: the slider's motion and one joint."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from exu_press.numerics.arrays import Array
from exu_press.result import Result

__all__ = ["Trajectory", "trajectory_of"]


@dataclass(frozen=True)
class Trajectory:
    """The slider's motion at a solver's own instants, and the joint that is looked at.

    Attributes:
        time: (n,), s, increasing.
        position: (n,), m.
        velocity: (n,), m/s.
        acceleration: (n,), m/s^2.
        force: (n,) magnitude of the force in the joint, N; None without a clearance joint.
        penetration: (n,) eccentricity less clearance, m; None where no surfaces can touch.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    force: Array | None = None
    penetration: Array | None = None

    def at(self, instants: Array) -> tuple[Array, Array]:
        """Return position and velocity at other instants, (m,), by cubic Hermite polynomials."""
        position = CubicHermiteSpline(self.time, self.position, self.velocity)
        velocity = CubicHermiteSpline(self.time, self.velocity, self.acceleration)
        return np.asarray(position(instants)), np.asarray(velocity(instants))

    def until(self, end: float) -> "Trajectory":
        """Return the part before an instant, s."""
        kept = self.time <= end * (1.0 + 1e-12)
        return Trajectory(
            self.time[kept],
            self.position[kept],
            self.velocity[kept],
            self.acceleration[kept],
            None if self.force is None else self.force[kept],
            None if self.penetration is None else self.penetration[kept],
        )


def trajectory_of(result: Result) -> Trajectory:
    """Return the trajectory in a result; the joint is its first dry one, else its first one."""
    names = result.clearance_joints
    dry = [name for name in names if result.joints[name].kind == "dry"]
    force = penetration = None
    if names:
        joint = result.joints[(dry or list(names))[0]]
        force = np.linalg.norm(joint.force, axis=1)
        penetration = -joint.gap if dry else None
    return Trajectory(
        result.time,
        result["slider_position"],
        result["slider_velocity"],
        result["slider_acceleration"],
        force,
        penetration,
    )
