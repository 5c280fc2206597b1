"""Rigid bodies as Exudyn items, with no more coordinates than their ideal joints leave them.

A body in an ideal guide that keeps it upright moves up and down; one on an ideal pivot of the frame
turns about it. No constraint holds the rest, so that its force comes from equilibrium, in
`result/equilibrium.py`.
"""

from typing import ClassVar

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    Node1D,
    NodeRigidBody2D,
    ObjectMass1D,
    ObjectRigidBody2D,
    ObjectRotationalMass1D,
)
from numpy.typing import NDArray

from exu_press.mechanism import Body, Motion, Point

__all__ = ["PivotedBody", "RigidBody", "SlidingBody"]

Array = NDArray[np.float64]

UPWARDS = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
"""Turns the x axis, along which Exudyn's sliding masses move, to the global y."""


class RigidBody:
    """A body that its joints alone hold.

    Attributes:
        coordinates: which of "x", "y" and "angle" are coordinates of the node, in their order.
        node: Exudyn's number.
        number: of Exudyn's object.
    """

    coordinates: ClassVar[tuple[str, ...]] = ("x", "y", "angle")

    def __init__(self, mbs: exu.MainSystem, body: Body, start: Motion) -> None:
        """Add the body to a system, with the first pose and velocity of a motion."""
        self._start: Array = start.position[0]
        node = NodeRigidBody2D(
            name=body.name, referenceCoordinates=self._start, initialVelocities=start.velocity[0]
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
            q: (n, coordinates) since the start.
            q_t: same shape.
            q_tt: same shape.
        """
        return Motion(self._start + q, q_t, q_tt)


class SlidingBody(RigidBody):
    """A body that an ideal guide keeps upright: only its height is a coordinate."""

    coordinates = ("y",)

    def __init__(self, mbs: exu.MainSystem, body: Body, start: Motion) -> None:
        """Add the body to a system, with the first height and velocity of a motion."""
        self._start = start.position[0]
        x, y, _ = self._start
        node = Node1D(
            name=body.name, referenceCoordinates=[y], initialVelocities=[start.velocity[0, 1]]
        )
        self.node = int(mbs.AddNode(node))
        item = ObjectMass1D(
            name=body.name,
            nodeNumber=self.node,
            mass=body.mass,
            referencePosition=[x, 0.0, 0.0],
            referenceRotation=UPWARDS,
        )
        self.number = int(mbs.AddObject(item))

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame in that of Exudyn's item, whose x points upwards."""
        x, y = point
        return y, -x

    def drawn(self, point: Point) -> Point:
        """Return the point itself: Exudyn moves the graphics of sliding masses, and turns none."""
        return point

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """As `RigidBody.motion`."""
        upwards = np.array([0.0, 1.0, 0.0])
        return Motion(self._start + q * upwards, q_t * upwards, q_tt * upwards)


class PivotedBody(RigidBody):
    """A body on an ideal pivot of the frame: only its angle is a coordinate."""

    coordinates = ("angle",)

    def __init__(
        self, mbs: exu.MainSystem, body: Body, start: Motion, pivot: Point, place: Point
    ) -> None:
        """Add the body to a system, with the first angle and spin of a motion.

        Args:
            mbs: not yet assembled.
            body: its inertia is that about the centre of mass.
            start: of the motion.
            pivot: in the global frame, m.
            place: the pivot in the body's frame, m.
        """
        self._pivot, self._place = pivot, place
        self._angle = float(start.position[0, 2])
        node = Node1D(
            name=body.name,
            referenceCoordinates=[self._angle],
            initialVelocities=[start.velocity[0, 2]],
        )
        self.node = int(mbs.AddNode(node))
        item = ObjectRotationalMass1D(
            name=body.name,
            nodeNumber=self.node,
            inertia=body.inertia + body.mass * (place[0] ** 2 + place[1] ** 2),
            referencePosition=[*pivot, 0.0],
        )
        self.number = int(mbs.AddObject(item))

    def local(self, point: Point) -> Point:
        """Return a point of the body's frame in that of Exudyn's item, which is the pivot's."""
        return point[0] - self._place[0], point[1] - self._place[1]

    def motion(self, q: Array, q_t: Array, q_tt: Array) -> Motion:
        """As `RigidBody.motion`."""
        angle, spin, turn = self._angle + q[:, 0], q_t[:, 0], q_tt[:, 0]
        x, y = self.local((0.0, 0.0))
        arm_x, arm_y = (
            np.cos(angle) * x - np.sin(angle) * y,
            np.sin(angle) * x + np.cos(angle) * y,
        )
        return Motion(
            np.column_stack([self._pivot[0] + arm_x, self._pivot[1] + arm_y, angle]),
            np.column_stack([-spin * arm_y, spin * arm_x, spin]),
            np.column_stack(
                [-turn * arm_y - spin**2 * arm_x, turn * arm_x - spin**2 * arm_y, turn]
            ),
        )
