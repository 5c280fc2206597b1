"""Mechanisms in the plane."""

import itertools

import exudyn.utilities as items
import numpy as np

from exudyn_examples.example import GRAVITY

__all__ = [
    "double_pendulum",
    "driven_crank",
    "four_bar",
    "iftomm_pendulum",
    "mass_points",
    "rods",
    "slider_crank",
    "truss",
]


def bar(mbs, start, end, mass, velocity=(0.0, 0.0, 0.0)):
    """A uniform bar between two points of the drawing: its body and half its length."""
    (x0, y0), (x1, y1) = start, end
    half, angle = 0.5 * np.hypot(x1 - x0, y1 - y0), np.arctan2(y1 - y0, x1 - x0)
    node = mbs.AddNode(
        items.NodeRigidBody2D(
            referenceCoordinates=[0.5 * (x0 + x1), 0.5 * (y0 + y1), angle],
            initialVelocities=list(velocity),
        )
    )
    inertia = mass * (2.0 * half) ** 2 / 12.0
    body = mbs.AddObject(items.ObjectRigidBody2D(nodeNumber=node, mass=mass, inertia=inertia))
    centre = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=centre, loadVector=[0.0, -GRAVITY, 0.0]))
    return body, half, node


def pin(mbs, one, at_one, other, at_other):
    """A revolute joint between points of two bodies."""
    markers = [
        mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[*at, 0.0]))
        for body, at in ((one, at_one), (other, at_other))
    ]
    return mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))


def torque(mbs, body, size):
    marker = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body))
    mbs.AddLoad(items.LoadTorqueVector(markerNumber=marker, loadVector=[0.0, 0.0, size]))


def slider_crank(mbs):
    """A crank under a torque, its connecting rod and a slider on the x-axis."""
    ground = mbs.AddObject(items.ObjectGround())
    crank, a, _ = bar(mbs, (0.0, 0.0), (0.4, 0.3), 2.0)
    reach = 0.4 + np.sqrt(1.0 - 0.09)
    rod, b, _ = bar(mbs, (0.4, 0.3), (reach, 0.0), 4.0)
    node = mbs.AddNode(items.NodePoint2D(referenceCoordinates=[reach, 0.0]))
    slider = mbs.AddObject(items.ObjectMassPoint2D(nodeNumber=node, mass=1.0))
    pin(mbs, ground, (0.0, 0.0), crank, (-a, 0.0))
    pin(mbs, crank, (a, 0.0), rod, (-b, 0.0))
    markers = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=place))
        for body, place in ((rod, [b, 0.0, 0.0]), (slider, [0.0, 0.0, 0.0]))
    ]
    mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))
    still = mbs.AddNode(items.NodePointGround())
    markers = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=coordinate))
        for number, coordinate in ((still, 0), (node, 1))
    ]
    mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=markers))
    torque(mbs, crank, 10.0)


def four_bar(mbs):
    """The four-bar linkage of `your_own_model.py`, from rest, under a torque at its crank."""
    ground = mbs.AddObject(items.ObjectGround())
    places = (0.0, 0.0), (0.0, 0.1), (0.25, 0.25), (0.3, 0.0)
    bars = [bar(mbs, places[i], places[i + 1], 1.0) for i in range(3)]
    pin(mbs, ground, places[0], bars[0][0], (-bars[0][1], 0.0))
    for (one, a, _), (other, b, _) in itertools.pairwise(bars):
        pin(mbs, one, (a, 0.0), other, (-b, 0.0))
    pin(mbs, bars[2][0], (bars[2][1], 0.0), ground, places[3])
    torque(mbs, bars[0][0], 0.1)


def driven_crank(mbs):
    """The four-bar whose crank follows a motion that is given at position level."""
    four_bar(mbs)
    still = mbs.AddNode(items.NodePointGround())
    markers = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=coordinate))
        for number, coordinate in ((still, 0), (0, 2))
    ]

    def angle(mbs, time, item, offset):
        return 1.0 - np.cos(5.0 * time)

    mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=markers, offsetUserFunction=angle))


def iftomm_pendulum(mbs):
    """The planar simple pendulum of the IFToMM library: a point mass held at a distance."""
    ground = mbs.AddObject(items.ObjectGround())
    node = mbs.AddNode(items.NodePoint2D(referenceCoordinates=[-1.0, 0.0]))
    mass = mbs.AddObject(items.ObjectMassPoint2D(nodeNumber=node, mass=1.0))
    markers = [
        mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=ground)),
        mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node)),
    ]
    mbs.AddObject(items.ObjectConnectorDistance(markerNumbers=markers, distance=1.0))
    mbs.AddLoad(items.LoadForceVector(markerNumber=markers[1], loadVector=[0.0, -GRAVITY, 0.0]))
    assert mass


def rods(mbs, masses):
    """Rods of a metre that hang on each other, let go while horizontal.

    Returns the ground, and the bodies, nodes and joints of the rods.
    """
    ground = mbs.AddObject(items.ObjectGround())
    before, at, bodies, nodes, joints = ground, 0.0, [], [], []
    for i, mass in enumerate(masses):
        rod, half, node = bar(mbs, (i, 0.0), (i + 1.0, 0.0), mass)
        joints.append(pin(mbs, before, (at, 0.0), rod, (-half, 0.0)))
        bodies.append(rod)
        nodes.append(node)
        before, at = rod, half
    return ground, bodies, nodes, joints


def truss(mbs, rise):
    """Two bars of a metre that hold each other, with their middle joint that much above the ends.

    Nothing moves; nearly in a line, a last digit of the joints moves the middle far.
    """
    ground, along = mbs.AddObject(items.ObjectGround()), np.sqrt(1.0 - rise**2)
    places = (0.0, 0.0), (along, rise), (2.0 * along, 0.0)
    (one, a, _), (other, b, _) = (bar(mbs, places[i], places[i + 1], 1.0) for i in range(2))
    pin(mbs, ground, places[0], one, (-a, 0.0))
    pin(mbs, one, (a, 0.0), other, (-b, 0.0))
    pin(mbs, other, (b, 0.0), ground, places[2])


def double_pendulum(mbs):
    """Two rods that hang on each other, let go while horizontal."""
    rods(mbs, (1.0, 1.0))


def mass_points(mbs):
    """A double pendulum of two masses in one object, whose constraints a user function gives."""
    length, mass = 0.8, 2.5
    nodes = [
        mbs.AddNode(items.NodePoint2D(referenceCoordinates=[x, 0.0])) for x in (length, 2 * length)
    ]
    both = mbs.AddObject(items.ObjectGenericODE2(nodeNumbers=nodes, massMatrix=mass * np.eye(4)))
    for node in nodes:
        marker = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=node))
        mbs.AddLoad(
            items.LoadForceVector(markerNumber=marker, loadVector=[0.0, -mass * GRAVITY, 0.0])
        )

    def violated(mbs, time, item, q, q_t, velocity_level):
        """Positions only, as in Exudyn's example."""
        return [np.hypot(q[0], q[1]) - length, np.hypot(q[2] - q[0], q[3] - q[1]) - length]

    def directions(mbs, time, item, q, q_t, velocity_level):
        one = np.array(q[:2]) / np.hypot(q[0], q[1])
        other = np.array([q[2] - q[0], q[3] - q[1]]) / np.hypot(q[2] - q[0], q[3] - q[1])
        return np.array([[*one, 0.0, 0.0], [*-other, *other]])

    still = mbs.AddNode(items.NodePointGround())
    mbs.AddObject(
        items.ObjectConnectorCoordinateVector(
            markerNumbers=[
                mbs.AddMarker(items.MarkerNodeCoordinates(nodeNumber=still)),
                mbs.AddMarker(items.MarkerObjectODE2Coordinates(objectNumber=both)),
            ],
            scalingMarker0=np.zeros((2, 4)),  # two constraints
            constraintUserFunction=violated,
            jacobianUserFunction=directions,
        )
    )
