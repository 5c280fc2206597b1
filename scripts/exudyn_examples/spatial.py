"""Mechanisms in space."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
from exudyn.utilities import (
    InertiaCuboid,
    InertiaCylinder,
    InertiaMassPoint,
    RotationMatrixY,
    RotationMatrixZ,
)

from exudyn_examples.example import GRAVITY

__all__ = [
    "bricard",
    "convex_roll",
    "flyball_governor",
    "four_bar_3d",
    "heavy_top",
    "kinematic_tree",
    "rods_on_a_spring",
    "rolling_disc",
    "rotor",
    "spring",
]

DOWN = [0.0, -GRAVITY, 0.0]


def four_bar_3d(mbs, redundant=False):
    """A parallelogram of three bars, pushed aside by gravity; its last joint without redundancy."""
    links = [([0.0, 0.5, 0.0], 0.5), ([0.6, 1.0, 0.0], 0.0), ([1.2, 0.5, 0.0], -0.5)]
    ground, bodies = mbs.CreateGround(), []
    for place, angle in links:
        length = 1.2 if angle == 0.0 else 1.0
        bodies.append(
            mbs.CreateRigidBody(
                inertia=InertiaCuboid(density=5000.0, sideLengths=[length, 0.1, 0.1]),
                referencePosition=place,
                referenceRotationMatrix=RotationMatrixZ(angle * np.pi),
                gravity=[0.5, -GRAVITY, 0.0],
            )
        )
    pairs = zip([ground, *bodies], [*bodies, ground], strict=True)
    places = [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.2, 1.0, 0.0], [1.2, 0.0, 0.0]
    for i, (pair, place) in enumerate(zip(pairs, places, strict=True)):
        free = [1, 1, 1, 1, 1, 0] if i < 3 or redundant else [1, 1, 0, 0, 0, 0]
        mbs.CreateGenericJoint(itemNumbers=list(pair), position=place, constrainedAxes=free)


def bricard(mbs):
    """Bricard's mechanism: five rods and six revolute joints, one constraint too many."""
    places = [[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]]
    turns = [
        np.eye(3),
        RotationMatrixZ(-0.5 * np.pi),
        RotationMatrixY(-0.5 * np.pi),
        RotationMatrixZ(np.pi),
        RotationMatrixZ(0.5 * np.pi),
    ]
    inertia = InertiaCuboid(density=100.0, sideLengths=[1.0, 0.1, 0.1]).Translated([0.5, 0, 0])
    ground = before = mbs.CreateGround()
    x, y, z = np.eye(3)
    for place, turn, axis in zip(places, [*turns, None], [y, z, x, y, z, x], strict=True):
        if turn is None:
            mbs.CreateGenericJoint(
                itemNumbers=[before, ground], position=place, constrainedAxes=[1, 1, 1, 0, 1, 1]
            )
            return
        rod = mbs.CreateRigidBody(
            inertia=inertia, referencePosition=place, referenceRotationMatrix=turn, gravity=DOWN
        )
        mbs.CreateRevoluteJoint(itemNumbers=[before, rod], position=place, axis=axis)
        before = rod


def rods_on_a_spring(mbs, count, forces=0):
    """A chain of rods that starts level and turning, its end on a spring, perhaps with a function
    of its own."""
    ground = before = mbs.CreateGround()
    length = 0.2
    for i in range(count):
        rod = mbs.CreateRigidBody(
            inertia=InertiaCuboid(density=1000.0, sideLengths=[length, 0.03, 0.05]),
            referencePosition=[length * (i + 0.5), 0.0, 0.0],
            initialVelocity=[0.0, 0.3 * (i + 0.5), 0.0],
            initialAngularVelocity=[0.0, 0.0, 0.3 / length],
            gravity=[0.0, 0.0, -GRAVITY],
        )
        mbs.CreateSphericalJoint(itemNumbers=[before, rod], position=[length * i, 0.0, 0.0])
        before = rod
    mbs.CreateCartesianSpringDamper(
        itemNumbers=[ground, before],
        localPosition0=[length * count, 0.0, -0.3],
        localPosition1=[0.5 * length, 0.0, 0.0],
        stiffness=[300.0] * 3,
        damping=[0.17] * 3,
        springForceUserFunction=forces,
    )


def spring(mbs, time, item, moved, speeds, stiffness, damping, offset):
    """The forces of a Cartesian spring and damper, as a function in Python."""
    return [stiffness[i] * moved[i] + damping[i] * speeds[i] for i in range(3)]


def flyball_governor(mbs, node_type=exu.NodeType.RotationEulerParameters):
    """The IFToMM library's stiff flyball governor: two balls on rods, held by stiff springs."""
    tilt, arm, offset = np.deg2rad(30.0), 1.0, 0.05
    speed = 0.16 * 2.0 * np.pi * np.array([0.0, 0.0, 1.0])
    rod = InertiaCuboid(density=3000.0, sideLengths=[arm, 0.01, 0.01])
    rod += InertiaMassPoint(mass=5.0).Translated([0.5 * arm, 0.0, 0.0])
    centre = rod.com[0]
    rod = rod.Translated([-centre, 0.0, 0.0])
    out = offset + (0.5 * arm + centre) * np.cos(tilt)
    up = 1.0 - (0.5 * arm + centre) * np.sin(tilt)
    ground = mbs.CreateGround()

    def body(inertia, place, turn):
        return mbs.CreateRigidBody(
            inertia=inertia,
            referencePosition=place,
            referenceRotationMatrix=turn,
            initialVelocity=np.cross(speed, place),
            initialAngularVelocity=speed,
            gravity=[0.0, 0.0, -GRAVITY],
            nodeType=node_type,
        )

    shaft = body(
        InertiaCuboid(density=3000.0, sideLengths=[0.01, 0.01, 1.0]), [0, 0, 0.5], np.eye(3)
    )
    slider = body(
        InertiaCuboid(density=3000.0, sideLengths=[0.1, 0.1, 0.1]), [0, 0, 0.5], np.eye(3)
    )
    mbs.CreateRevoluteJoint(itemNumbers=[ground, shaft], position=[0, 0, 0], axis=[0, 0, 1])
    mbs.CreatePrismaticJoint(itemNumbers=[shaft, slider], position=[0, 0, 0.5], axis=[0, 0, 1])
    for side in (1.0, -1.0):
        turn = RotationMatrixZ(0.0 if side > 0.0 else np.pi) @ RotationMatrixY(tilt)
        ball = body(rod, [side * out, 0.0, up], turn)
        mbs.CreateRevoluteJoint(
            itemNumbers=[shaft, ball], position=[side * offset, 0.0, 1.0], axis=[0, 1, 0]
        )
        mbs.CreateSpringDamper(
            itemNumbers=[slider, ball],
            localPosition0=[side * 0.05, 0.0, 0.0],
            localPosition1=[-centre, 0.0, 0.0],
            referenceLength=0.5,
            stiffness=8e5,
            damping=4e4,
        )


def rotor(mbs, node_type=exu.NodeType.RotationEulerParameters, torque=2.0):
    """A rigid, unbalanced rotor on springs that a torque runs up through its resonance."""
    mass, radius, width, stiffness, eccentricity = 2.0, 0.75, 0.2, 800.0, 1.48e-3
    natural = np.sqrt(2.0 * stiffness / mass)
    damping = 2.0 * natural * 0.002 * mass
    ground = mbs.CreateGround()
    disc = mbs.CreateRigidBody(
        inertia=InertiaCylinder(
            density=mass / (np.pi * radius**2 * width), length=width, outerRadius=radius, axis=0
        ),
        referencePosition=[0.0, eccentricity, 0.0],
        nodeType=node_type,
    )
    for side in (-0.5, 0.5):
        held = [stiffness if side < 0.0 else 0.0, stiffness, stiffness]
        mbs.CreateCartesianSpringDamper(
            itemNumbers=[ground, disc],
            localPosition0=[side, 0.0, 0.0],
            localPosition1=[side, -eccentricity, 0.0],
            stiffness=held,
            damping=[damping * k / stiffness for k in held],
        )
    mbs.CreateTorque(itemNumber=disc, loadVector=[torque, 0.0, 0.0])


def heavy_top(mbs, node_type=exu.NodeType.RotationEulerParameters):
    """The heavy top of the Lie-group literature, on a spherical joint."""
    inertia = exu.utilities.RigidBodyInertia(
        mass=15.0, inertiaTensor=np.diag([0.234375, 0.46875, 0.234375]), com=[0.0, 0.0, 0.0]
    )
    spin = np.array([0.0, 150.0, -4.61538])
    ground = mbs.CreateGround()
    top = mbs.CreateRigidBody(
        inertia=inertia,
        referencePosition=[0.0, 1.0, 0.0],
        initialVelocity=np.cross(spin, [0.0, 1.0, 0.0]),
        initialAngularVelocity=spin,
        gravity=[0.0, 0.0, -GRAVITY],
        nodeType=node_type,
    )
    mbs.CreateSphericalJoint(itemNumbers=[ground, top], position=[0.0, 0.0, 0.0])


def kinematic_tree(mbs):
    """An arm in coordinates of its joints, whose second one slides on a spring; it holds a ball."""
    length, links = 0.8, 3
    link = InertiaCuboid(density=1000.0, sideLengths=[length, 0.05, 0.05])
    link = link.Translated([0.5 * length, 0.0, 0.0])
    turns, inertias = exu.Matrix3DList(), exu.Matrix3DList()
    offsets, centres = exu.Vector3DList(), exu.Vector3DList()
    for i in range(links):
        turns.Append(np.eye(3))
        inertias.Append(link.InertiaCOM())
        offsets.Append([length if i else 0.0, 0.0, 0.0])
        centres.Append(link.COM())
    rest = [0.0] * links
    node = mbs.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=rest,
            initialCoordinates=rest,
            initialCoordinates_t=rest,
            numberOfODE2Coordinates=links,
        )
    )
    joint = exu.JointType
    arm = mbs.AddObject(
        items.ObjectKinematicTree(
            nodeNumber=node,
            jointTypes=[joint.RevoluteZ, joint.PrismaticX, joint.RevoluteZ],
            linkParents=np.arange(links) - 1,
            jointTransformations=turns,
            jointOffsets=offsets,
            linkInertiasCOM=inertias,
            linkCOMs=centres,
            linkMasses=[link.Mass()] * links,
            gravity=DOWN,
            jointPositionOffsetVector=rest,
            jointVelocityOffsetVector=rest,
            jointPControlVector=[0.0, 500.0, 0.0],
            jointDControlVector=[0.0, 5.0, 0.0],
        )
    )
    ball = mbs.CreateRigidBody(
        referencePosition=[links * length, -0.2, 0.0],
        inertia=exu.utilities.InertiaSphere(mass=1.0, radius=0.05),
        gravity=DOWN,
    )
    ends = [
        mbs.AddMarker(
            items.MarkerKinematicTreeRigid(
                objectNumber=arm, linkNumber=links - 1, localPosition=[length, 0.0, 0.0]
            )
        ),
        mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ball, localPosition=[0.0, 0.2, 0.0])),
    ]
    mbs.AddObject(items.ObjectJointSpherical(markerNumbers=ends, constrainedAxes=[1, 1, 1]))


def rolling_disc(mbs):
    """A disc that rolls without slip and wobbles: a nonholonomic constraint."""
    radius = 0.2
    speed = 3.0 * 2.0 * np.pi
    disc = mbs.CreateRigidBody(
        inertia=InertiaCylinder(density=5000.0, length=0.02, outerRadius=radius, axis=0),
        referencePosition=[1.0, 0.0, radius],
        initialAngularVelocity=[-speed, 10.0, 0.0],
        initialVelocity=np.cross([-speed, 10.0, 0.0], [0.0, 0.0, radius]),
        gravity=[0.0, 0.0, -GRAVITY],
    )
    mbs.CreateRollingDisc(
        bodyNumbers=[mbs.CreateGround(), disc],
        axisVector=[1, 0, 0],
        discRadius=radius,
        axisPosition=[0, 0, 0],
    )


def convex_roll(mbs):
    """A spinning barrel that falls on a plane with friction, on Exudyn's ObjectContactConvexRoll.

    Its gap is guessed to be nothing, as in Exudyn's example, though it is a millimetre.
    """
    length, hull = 0.1, [-3.6, 0.0, 1.65e-2]
    turn = RotationMatrixY(np.pi / 16.0)
    roll = mbs.CreateRigidBody(
        inertia=InertiaCylinder(density=7800.0, length=length, outerRadius=3e-3, axis=0),
        referencePosition=[0.0, 0.0, 1.2 * hull[-1]],
        referenceRotationMatrix=turn,
        initialAngularVelocity=list(turn @ np.array([-100.0, 0.0, 0.0])),
        gravity=[0.0, 0.0, -GRAVITY],
    )
    gap = mbs.AddNode(
        items.NodeGenericData(initialCoordinates=[0.0] * 3, numberOfDataCoordinates=3)
    )
    mbs.AddObject(
        items.ObjectContactConvexRoll(
            markerNumbers=[
                mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body))
                for body in (mbs.CreateGround(), roll)
            ],
            nodeNumber=gap,
            contactStiffness=1e3,
            contactDamping=1.0,
            dynamicFriction=0.9,
            frictionProportionalZone=1e-2,
            rollLength=length,
            coefficientsHull=hull,
        )
    )
