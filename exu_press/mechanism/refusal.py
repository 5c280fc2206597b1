"""The refusal of a drawing that does not move as a mechanism with one degree of freedom does."""

from collections.abc import Mapping

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array

__all__ = ["MotionError"]


class MotionError(InputError):
    """A drawing whose crank cannot turn through a revolution.

    Attributes:
        bodies: names of those that lock, branch or are not held.
        angle: of the crank from the drawing, where that happens, rad.
        poses: every body's (x, y, angle) at the last crank angle that was reached, in m and rad;
            empty where only the drawing itself is known.
    """

    def __init__(
        self,
        message: str,
        bodies: tuple[str, ...],
        angle: float = 0.0,
        poses: Mapping[str, Array] | None = None,
    ) -> None:
        """Say in the message which drawing, which bodies and where."""
        super().__init__(message)
        self.bodies, self.angle, self.poses = bodies, angle, dict(poses or {})
