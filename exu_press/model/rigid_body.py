"""Rigid bodies as Exudyn items, with no more coordinates than their ideal joints leave them.

A body in an ideal guide that keeps it upright moves up and down; one on an ideal pivot of the frame
turns about it. No constraint holds the rest, so that its force comes from equilibrium, in
`result/equilibrium.py`.
"""

import math

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


class RigidBody:
    """A body that its joints alone hold.

    Attributes:
        coordinates: which of "x", "y" and "angle" are coordinates of the node, in their order.
        reference: x, y and angle (m, m, rad) from which they count.
        node: Exudyn's number.
        number: of Exudyn's object.
        turned: angle of the body's frame in that of Exudyn's object, rad.
    """

    coordinates: tuple[str, ...] = ("x", "y", "angle")
    turned = 0.0

    def __init__(
        self, mbs: exu.MainSystem, body: Body, start: Motion, reference: Array | None = None
    ) -> None:
        """Add the body to a system.

        Args:
            mbs: not yet assembled.
            body: its inertia is that about the centre of mass.
            start: its first pose and velocity are the body's.
            reference: x, y and angle from which displacements count and where springs are relaxed;
                that of the start unless given.
        """
        self.reference: Array = start.position[0] if reference is None else reference
        node = NodeRigidBody2D(
            name=body.name,
            referenceCoordinates=self.reference,
            initialCoordinates=start.position[0] - self.reference,
            initialVelocities=start.velocity[0],
        )
        self.node = int(mbs.AddNode(node))
        item = ObjectRigidBody2D(
            name=body.name, nodeNumber=self.node, mass=body.mass, inertia=body.inertia
        )
        self.number = int(mbs.AddObject(item))

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame, in its centre of mass, in that of Exudyn's item."""
        return point

    def drawn(self, point: Point) -> Point:
        """Return a point of the body's frame in that in which Exudyn draws the item's graphics."""
        return self.local(point)

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """Return the centre of mass and the angle by displacements, rates and accelerations.

        Args:
            q: (n, coordinates) from the reference.
            q_t: same shape.
            q_tt: same shape.
        """
        return Motion(self.reference + q, q_t, q_tt)


class SlidingBody(RigidBody):
    """A body that an ideal guide along x or y keeps upright; it has its displacement alone."""

    def __init__(
        self,
        mbs: exu.MainSystem,
        body: Body,
        start: Motion,
        direction: Point,
        reference: Array | None = None,
    ) -> None:
        """Take what `RigidBody` takes; pose and velocity along the guide are used.

        Args:
            mbs: not yet assembled.
            body: its inertia does not matter.
            start: of the motion.
            direction: (0, 1), (1, 0) or minus one of these.
            reference: as `RigidBody`.
        """
        self.reference = start.position[0] if reference is None else reference
        column = 1 if direction[0] == 0.0 else 0
        self.coordinates = (("x", "y")[column],)
        self._along = np.eye(3)[column]
        along = self._along[:2]
        x, y, angle = self.reference
        self.turned = float(angle - math.atan2(along[1], along[0]))
        node = Node1D(
            name=body.name,
            referenceCoordinates=[self.reference[column]],
            initialCoordinates=[start.position[0, column] - self.reference[column]],
            initialVelocities=[start.velocity[0, column]],
        )
        self.node = int(mbs.AddNode(node))
        item = ObjectMass1D(
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
        self.number = int(mbs.AddObject(item))

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame in that of Exudyn's item, whose x is the guide's."""
        c, s = math.cos(self.reference[2]), math.sin(self.reference[2])
        x, y = c * point[0] - s * point[1], s * point[0] + c * point[1]
        a, b, _ = self._along.tolist()
        return a * x + b * y, a * y - b * x

    def drawn(self, point: Point) -> Point:
        """Return the point itself: Exudyn moves the graphics of sliding masses, and turns none."""
        return point

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """Return the motion as `RigidBody.motion`."""
        moved, *rates = ((self._along[:, None] * part[:, 0]).T for part in (q, q_t, q_tt))
        return Motion(self.reference + moved, *rates)


class PivotedBody(RigidBody):
    """A body on an ideal pivot of the frame: only its angle is a coordinate."""

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
        """Take what `RigidBody` takes; the angle's pose and velocity are used.

        Args:
            mbs: not yet assembled.
            body: its inertia is that about the centre of mass.
            start: of the motion.
            pivot: in the global frame, m.
            point: the pivot in the body's frame, m.
            reference: as `RigidBody`.
        """
        self._pivot, self._point = pivot, point
        self.reference = start.position[0] if reference is None else reference
        angle = float(self.reference[2])
        node = Node1D(
            name=body.name,
            referenceCoordinates=[angle],
            initialCoordinates=[start.position[0, 2] - angle],
            initialVelocities=[start.velocity[0, 2]],
        )
        self.node = int(mbs.AddNode(node))
        item = ObjectRotationalMass1D(
            name=body.name,
            nodeNumber=self.node,
            inertia=body.inertia + body.mass * (point[0] ** 2 + point[1] ** 2),
            referencePosition=[*pivot, 0.0],
        )
        self.number = int(mbs.AddObject(item))

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame in that of Exudyn's item, which is the pivot's."""
        return point[0] - self._point[0], point[1] - self._point[1]

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """Return the motion as `RigidBody.motion`."""
        place, *rates = (np.zeros((3, len(q))).T for _ in range(3))
        place += [*self._pivot, self.reference[2]]
        for columns, part in zip((place, *rates), (q, q_t, q_tt), strict=True):
            columns[:, 2] += part[:, 0]
        return Motion(place, *rates).at(self.local((0.0, 0.0)))
