"""Position, velocity and acceleration of a point or a body over instants."""

from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Motion"]


@dataclass(frozen=True)
class Motion:
    """Position, velocity and acceleration over n instants, each of shape (n, 2) or (n, 3).

    Points have (x, y) in m; bodies have (x, y, angle), with the angle in rad.
    """

    position: Array
    velocity: Array
    acceleration: Array

    def __getitem__(self, columns: slice) -> "Motion":
        """Return the motion of some columns: body[:2] is the body's centre."""
        parts = (self.position, self.velocity, self.acceleration)
        return Motion(*(part[:, columns] for part in parts))

    def at(self, point: tuple[float, float]) -> "Motion":
        """Return the motion (x, y, angle) of a point of the body's frame, m."""
        angle, omega, alpha = (
            part[:, 2] for part in (self.position, self.velocity, self.acceleration)
        )
        x, y = point
        arm = np.column_stack(
            [
                np.cos(angle) * x - np.sin(angle) * y,
                np.sin(angle) * x + np.cos(angle) * y,
                np.zeros_like(angle),
            ]
        )
        across = np.column_stack([-arm[:, 1], arm[:, 0], np.zeros_like(angle)])
        return Motion(
            self.position + arm,
            self.velocity + omega[:, None] * across,
            self.acceleration + alpha[:, None] * across - (omega**2)[:, None] * arm,
        )
