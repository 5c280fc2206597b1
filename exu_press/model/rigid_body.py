"""Rigid bodies as Exudyn items, with the coordinates that ideal guides and pivots leave them.

A body in an ideal guide has its displacement alone, one on an ideal pivot of the frame its angle.
The forces of these guides and pivots follow from equilibrium, in `result/equilibrium.py`.
"""

import math
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    Node1D,
    NodeRigidBody2D,
    ObjectMass1D,
    ObjectRigidBody2D,
    ObjectRotationalMass1D,
)

from exu_press.mechanism import Body, Motion, Point
from exu_press.numerics.arrays import Array

__all__ = ["PivotedBody", "RigidBody", "SlidingBody"]

COORDINATES = ("x", "y", "angle")


class RigidBody:
    """A body with all three coordinates.

    Attributes:
        coordinates: those of "x", "y" and "angle" that the node has, in its order.
        reference: x, y and angle (m, m, rad) from which they count.
        node: number of Exudyn's node.
        number: of Exudyn's object.
        frame_angle: angle of the body's frame in that of Exudyn's object, rad.
    """

    coordinates: tuple[str, ...] = COORDINATES
    frame_angle = 0.0

    def __init__(
        self, mbs: exu.MainSystem, body: Body, start: Motion, reference: Array | None = None
    ) -> None:
        """Add the body to a system.

        Args:
            mbs: not yet assembled.
            body: with its inertia about the centre of mass.
            start: its first pose and velocity are the initial values of the coordinates.
            reference: x, y and angle from which displacements count and at which springs are
                relaxed; by default those of the start.
        """
        self.reference: Array = start.position[0] if reference is None else reference
        columns = [COORDINATES.index(coordinate) for coordinate in self.coordinates]
        node = (NodeRigidBody2D if len(columns) == len(COORDINATES) else Node1D)(
            name=body.name,
            referenceCoordinates=self.reference[columns].tolist(),
            initialCoordinates=(start.position[0] - self.reference)[columns].tolist(),
            initialVelocities=start.velocity[0, columns].tolist(),
        )
        self.node = int(mbs.AddNode(node))
        self.number = int(mbs.AddObject(self._item(body)))

    def _item(self, body: Body) -> Any:
        return ObjectRigidBody2D(
            name=body.name, nodeNumber=self.node, mass=body.mass, inertia=body.inertia
        )

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame, whose origin is the centre of mass, in the item's."""
        return point

    def graphics_point(self, point: Point) -> Point:
        """Return a point of the body's frame in the frame of the item's graphics."""
        return self.local(point)

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """Return the motion of the centre of mass, by displacements (n, coordinates) and rates."""
        return Motion(self.reference + q, q_t, q_tt)


class SlidingBody(RigidBody):
    """A body in an ideal guide along x or y: its displacement is the only coordinate."""

    def __init__(
        self,
        mbs: exu.MainSystem,
        body: Body,
        start: Motion,
        direction: Point,
        reference: Array | None = None,
    ) -> None:
        """Add the body; arguments as of `RigidBody`, and the guide's direction, along x or y."""
        column = 1 if direction[0] == 0.0 else 0
        self.coordinates = (COORDINATES[column],)
        self._along = np.eye(3)[column]
        super().__init__(mbs, body, start, reference)
        self.frame_angle = float(self.reference[2] - math.atan2(self._along[1], self._along[0]))

    def _item(self, body: Body) -> Any:
        (x, y, _), along = self.reference, self._along
        return ObjectMass1D(
            name=body.name,
            nodeNumber=self.node,
            mass=body.mass,
            referencePosition=[x * along[1], y * along[0], 0.0],
            referenceRotation=[
                [along[0], -along[1], 0.0],  # turns the x axis, along which the mass moves
                [along[1], along[0], 0.0],
                [0.0, 0.0, 1.0],
            ],
        )

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame in that of Exudyn's item, whose x is the guide's."""
        c, s = math.cos(self.reference[2]), math.sin(self.reference[2])
        x, y = c * point[0] - s * point[1], s * point[0] + c * point[1]
        a, b, _ = self._along.tolist()
        return a * x + b * y, a * y - b * x

    def graphics_point(self, point: Point) -> Point:
        """Return the point: Exudyn translates the graphics of sliding masses without rotation."""
        return point

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """Return the motion as `RigidBody.motion`."""
        shift, *rates = ((self._along[:, None] * level[:, 0]).T for level in (q, q_t, q_tt))
        return Motion(self.reference + shift, *rates)


class PivotedBody(RigidBody):
    """A body on an ideal pivot of the frame: its angle is the only coordinate."""

    coordinates: tuple[str, ...] = ("angle",)

    def __init__(
        self,
        mbs: exu.MainSystem,
        body: Body,
        start: Motion,
        pivot: Point,
        point: Point,
        reference: Array | None = None,
    ) -> None:
        """Add the body; arguments as of `RigidBody`, and the pivot in global and body frame, m."""
        self._pivot, self._point = pivot, point
        super().__init__(mbs, body, start, reference)

    def _item(self, body: Body) -> Any:
        x, y = self._point
        return ObjectRotationalMass1D(
            name=body.name,
            nodeNumber=self.node,
            inertia=body.inertia + body.mass * (x**2 + y**2),
            referencePosition=[*self._pivot, 0.0],
        )

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame in that of Exudyn's item, which is the pivot's."""
        return point[0] - self._point[0], point[1] - self._point[1]

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """Return the motion as `RigidBody.motion`."""
        position, *rates = (np.zeros((3, len(q))).T for _ in range(3))
        position += [*self._pivot, self.reference[2]]
        for columns, level in zip((position, *rates), (q, q_t, q_tt), strict=True):
            columns[:, 2] += level[:, 0]
        return Motion(position, *rates).point_motion(self.local((0.0, 0.0)))
