"""Rows of the constraints' Jacobian: by displacements (x, y, angle) of all bodies."""

import math
from collections.abc import Mapping

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Guide, Joint
from exu_press.numerics.arrays import Array

__all__ = ["ConstraintRows"]


class ConstraintRows:
    """The rows at one position; n is three times the number of bodies.

    Displacements are relative to the mechanism's size, so that they compare with rotations.
    """

    def __init__(self, mechanism: Mechanism, angles: Mapping[str, float]) -> None:
        """Take the angles of the bodies, rad."""
        self._mechanism, self._angles = mechanism, angles
        self._first = {body.name: 3 * i for i, body in enumerate(mechanism.bodies)}
        self.size = 3 * len(mechanism.bodies)

    def of_joint(self, joint: Joint) -> Array:
        """Return the two rows of a joint, (2, n)."""
        rows = np.zeros((2, self.size))
        for sign, (body, (x, y)) in zip((1.0, -1.0), self._mechanism.ends(joint), strict=True):
            if body != GROUND:
                c, s = math.cos(self._angles[body]), math.sin(self._angles[body])
                first = self._first[body]
                rows[:, first : first + 2] = sign * np.eye(2)
                arm = np.array([c * x - s * y, s * x + c * y]) / self._mechanism.size
                rows[:, first + 2] = sign * np.array([-arm[1], arm[0]])
        return rows

    def across(self, guide: Guide) -> Array:
        """Return the row of what a guide holds across its direction, (n,)."""
        row = np.zeros(self.size)
        first = self._first[guide.body]
        row[first : first + 2] = guide.across
        return row

    def angle(self, body: str) -> Array:
        """Return the row of a body's angle, (n,)."""
        row = np.zeros(self.size)
        row[self._first[body] + 2] = 1.0
        return row
