"""Kinds of constraints between two bodies in the plane: residual, Jacobian and rate of their rows.

A constraint is Phi(q) = 0, with q the coordinates x, y and angle of all bodies. Its rate gamma is
the part of its second time derivative that has no accelerations [1]_::

    d^2 Phi / dt^2 = J q'' + gamma(q, q')

Points are complex numbers x + i y, so that a rotation is a product. Fields of one kind may be
numbers, or arrays (m,) of m constraints.

References
----------
.. [1] E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn & Bacon 1989,
   chapter 3.
"""

from typing import Any, NamedTuple

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Coincidence", "Gradient", "PointOnLine", "Poses", "RotationRatio"]

Number = Any
"""A number, or an array of them."""

Gradient = tuple[Number, Number, Number]
"""A body's index, a row's derivatives d/dx + i d/dy by its centre, and that by its angle."""


class Poses:
    """Bodies at coordinates (..., 3 n), moving at rates of the same shape; the frame is the last.

    Attributes:
        z: centres, (..., n + 1).
        turn: exp(i angle).
        angle: rad.
        z_t: velocities of the centres.
        omega: angular velocities.
    """

    def __init__(self, q: Array, q_t: Array | None = None) -> None:
        """Take coordinates, and their rates where velocities are asked for."""
        self.z, self.angle = _of_bodies(q)
        self.turn = np.exp(1j * self.angle)
        if q_t is not None:
            self.z_t, self.omega = _of_bodies(q_t)

    def arm(self, body: Number, point: Number) -> Number:
        """Return the vector from a body's centre to a point of its frame."""
        return self.turn[..., body] * point

    def point(self, body: Number, point: Number) -> Number:
        """Return the position of a point of a body."""
        return self.z[..., body] + self.arm(body, point)

    def gap(self, pair: "Coincidence | PointOnLine") -> Number:
        """Return the vector from the base's point of a constraint to the body's."""
        return self.point(pair.body, pair.point) - self.point(pair.base, pair.base_point)

    def velocity(self, body: Number, point: Number) -> Number:
        """Return the velocity of a point of a body."""
        return self.z_t[..., body] + 1j * self.omega[..., body] * self.arm(body, point)

    def centripetal(self, body: Number, point: Number) -> Number:
        """Return a point's acceleration where centre and rotation of the body have none."""
        return -(self.omega[..., body] ** 2) * self.arm(body, point)


def _of_bodies(q: Array) -> tuple[Number, Array]:
    """Return the centres and angles of bodies and frame."""
    q = np.concatenate([q, np.zeros((*q.shape[:-1], 3))], axis=-1)
    return q[..., 0::3] + 1j * q[..., 1::3], q[..., 2::3]


class Coincidence(NamedTuple):
    """Points of two bodies coincide: a revolute joint, x and y of journal minus bearing."""

    body: Number
    point: Number
    base: Number
    base_point: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi of both rows."""
        gap = poses.gap(self)
        return [gap.real, gap.imag]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the rows of J."""
        arm, base_arm = poses.arm(self.body, self.point), poses.arm(self.base, self.base_point)
        return [
            [(self.body, 1.0, -arm.imag), (self.base, -1.0, base_arm.imag)],
            [(self.body, 1j, arm.real), (self.base, -1j, -base_arm.real)],
        ]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma of both rows."""
        gamma = poses.centripetal(self.body, self.point)
        gamma = gamma - poses.centripetal(self.base, self.base_point)
        return [gamma.real, gamma.imag]


class PointOnLine(NamedTuple):
    """A point of a body stays on a line of another: a guide or a slot, by its unit normal."""

    body: Number
    point: Number
    base: Number
    base_point: Number
    normal: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi, the distance along the normal."""
        return [(self._normal(poses).conj() * poses.gap(self)).real]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the row of J."""
        normal, arm = self._normal(poses), poses.arm(self.body, self.point)
        from_base = poses.point(self.body, self.point) - poses.z[..., self.base]
        return [
            [
                (self.body, normal, -(normal.conj() * arm).imag),
                (self.base, -normal, (normal.conj() * from_base).imag),
            ]
        ]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma, with the second derivative of the turning normal."""
        omega = poses.omega[..., self.base]
        rate = poses.velocity(self.body, self.point) - poses.velocity(self.base, self.base_point)
        gamma = poses.centripetal(self.body, self.point)
        gamma = gamma - poses.centripetal(self.base, self.base_point)
        gamma = gamma - omega**2 * poses.gap(self) - 2j * omega * rate
        return [(self._normal(poses).conj() * gamma).real]

    def _normal(self, poses: Poses) -> Number:
        return poses.arm(self.base, self.normal)


class RotationRatio(NamedTuple):
    """A body turns a ratio times as far as another: on a guide with the frame, or as gears do.

    `offset` is angle - ratio * (angle of the base) in the drawing.
    """

    body: Number
    base: Number
    ratio: Number
    offset: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi."""
        return [
            poses.angle[..., self.body] - self.ratio * poses.angle[..., self.base] - self.offset
        ]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the row of J."""
        return [[(self.body, 0.0, 1.0), (self.base, 0.0, -self.ratio)]]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma, which is zero."""
        return [np.zeros_like(poses.angle[..., self.body])]
