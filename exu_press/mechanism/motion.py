"""Position, velocity and acceleration of a point or a body over instants."""

from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Motion"]


@dataclass(frozen=True)
class Motion:
    """Position, velocity and acceleration over n instants, each of shape (n, 2) or (n, 3).

    Points have (x, y) in m; bodies have (x, y, angle), with the angle in rad. Those of a run lie
    column by column in memory, as they are read.
    """

    position: Array
    velocity: Array
    acceleration: Array

    def __getitem__(self, columns: slice) -> "Motion":
        """Return the motion of some columns: body[:2] is the body's centre."""
        return Motion(*(level[:, columns] for level in self._levels))

    def point_motion(self, point: tuple[float, float]) -> "Motion":
        """Return the motion (x, y, angle) of a point of the body's frame, m."""
        angle, omega, alpha = (level[:, 2] for level in self._levels)
        x, y = point
        cos, sin = np.cos(angle), np.sin(angle)
        arm_x, arm_y = cos * x - sin * y, sin * x + cos * y
        square = omega**2
        position, velocity, acceleration = (np.array(level, order="F") for level in self._levels)
        position[:, 0] += arm_x
        position[:, 1] += arm_y
        velocity[:, 0] -= omega * arm_y
        velocity[:, 1] += omega * arm_x
        acceleration[:, 0] -= alpha * arm_y
        acceleration[:, 0] -= square * arm_x
        acceleration[:, 1] += alpha * arm_x
        acceleration[:, 1] -= square * arm_y
        return Motion(position, velocity, acceleration)

    @property
    def _levels(self) -> tuple[Array, Array, Array]:
        return self.position, self.velocity, self.acceleration
