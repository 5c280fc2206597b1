"""The line of a guide: how far a body's point lies beside it, and by which coordinates it moves.

A line of the frame is linear in the coordinates. One of another body turns with that: with n across
it, t along it and r from that body's centre to the point, the rates of both displacements are ::

    across = [n, 0, -n, -(r x n)],    along = [t, 0, -t, -(r x t)]

by x, y and angle of the body and of the one with the line. A generalised force f across acts on
both bodies at the one point. The derivatives of both rows are each other's, in the row and the
column of the angle with which the line turns.
"""

import math

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["FixedLine", "GuideLine", "TurningLine"]


class FixedLine:
    """A line of the frame."""

    def __init__(self, along: Array, across: Array | None = None, missed: float = 0.0) -> None:
        """Take a line.

        Args:
            along: (n,), displacement of the body along it by each coordinate.
            across: the same across it, where that is asked for.
            missed: displacement across it where the coordinates are zero, m.
        """
        self._along = along
        self._across = np.zeros_like(along) if across is None else across
        self._missed = missed
        self._even = np.zeros((len(along), len(along)))

    def direction_row(self, q: Array) -> Array:
        """Return the displacement along the line by each coordinate, (n,)."""
        return self._along

    def normal_row(self, q: Array) -> Array:
        """Return the displacement across the line by each coordinate, (n,)."""
        return self._across

    def lateral_displacement(self, q: Array) -> float:
        """Return the displacement across the line, m."""
        return float(self._across @ q) + self._missed

    def turning(self, row: Array) -> Array:
        """Return that the rows do not change."""
        return self._even


class TurningLine:
    """A line of a moving body, for the centre of another one; both with all coordinates."""

    def __init__(self, body: Array, base: Array, point: tuple[float, float], normal: float) -> None:
        """Take a line.

        Args:
            body: x, y and angle of the guided body where its coordinates are zero, (3,).
            base: the same of the body with the line.
            point: of the line, in that body's frame, m.
            normal: angle of its normal in that frame, rad.
        """
        self._apart = body - base
        self._normal = normal + float(base[2])
        self._offset = point[0] * math.cos(normal) + point[1] * math.sin(normal)

    def direction_row(self, q: Array) -> Array:
        """Return the displacement along the line by each coordinate, (6,)."""
        return self._row(q, 0.5 * math.pi)

    def normal_row(self, q: Array) -> Array:
        """Return the displacement across the line by each coordinate, (6,)."""
        return self._row(q, 0.0)

    def lateral_displacement(self, q: Array) -> float:
        """Return the displacement across the line, m."""
        r, angle = self._apart + q[:3] - q[3:], self._normal + q[5]
        return float(r[0] * math.cos(angle) + r[1] * math.sin(angle)) - self._offset

    def tilt(self, q: Array) -> float:
        """Return the angle of the body less that of the line's, rad."""
        return float(self._apart[2] + q[2] - q[5])

    def turning(self, row: Array) -> Array:
        """Return the derivative of one row from the other, as it stands in the module's text.

        That of the normal row takes the direction row, and that of this minus the normal row.
        """
        matrix = np.zeros((6, 6))
        matrix[5], matrix[:, 5] = row, row
        return matrix

    def _row(self, q: Array, turned: float) -> Array:
        r, angle = self._apart + q[:3] - q[3:], self._normal + q[5] + turned
        x, y = math.cos(angle), math.sin(angle)
        return np.array([x, y, 0.0, -x, -y, r[1] * x - r[0] * y])


GuideLine = FixedLine | TurningLine
"""The line of a guide, at coordinates (n,) of the bodies' nodes."""
