"""The support of flexible bodies: by pivots, in the plane, and by discs that move with faces.

In the plane the joints are those of rigid bodies. Out of the plane a body on a pivot of the frame
with two faces is held by these, any other one by its mean motion.
"""

from collections.abc import Mapping

import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    ObjectConnectorCoordinate,
    ObjectConnectorDistance,
    ObjectJointRevolute2D,
    ObjectJointSpherical,
)
from exudyn.rigidBodyUtilities import RotationMatrixZ

from exu_press.mechanism import GROUND, Body, Joint, Motion, Point
from exu_press.mechanism.parts import DRIVE
from exu_press.model.flexible_body import DRIVEN, guide_points
from exu_press.model.rigid_body import RigidBody
from exu_press.model.system import System

__all__ = ["hold_flexible_bodies"]

OUT_OF_PLANE = (2, 4, 5)
"""Among a frame's coordinates: the height, and the Euler parameters of both tilts."""

DISC_MASS = 1e-3
"""Mass of the disc on a flexible crank, kg: negligible, but not zero."""

CARRIER_INERTIA = 1e-5
"""Mass and inertia of a disc that moves with a face, over those of its body: likewise."""


def hold_flexible_bodies(system: System, start: Mapping[str, Motion]) -> None:
    """Hold flexible bodies in the plane and on pivots of the frame.

    A disc drives a flexible crank, and one moves with each face in a slot or a moving guide.
    """
    for name, body in system.flexible.items():
        placed, ideal = system.parts[name], system.ideal[name]
        if name == system.mechanism.crank:
            motor = system.scene.drive
            disc = Body(DRIVE, DISC_MASS, 1.0 if motor is None else motor.on_crank)
            shaft = system.mechanism.body(name).local(system.mechanism.shaft.at)
            _add_disc(system, disc, ideal.point_motion(shaft), start)
            _hold_on_face(system, name, DRIVE)
        for guide in placed.carriers:
            carrier, points = system.carriers[guide, name], guide_points(guide)
            mass, inertia = placed.reduced.mass, placed.inertia
            disc = Body(carrier, CARRIER_INERTIA * mass, CARRIER_INERTIA * inertia)
            _add_disc(system, disc, ideal, start)
            at = placed.to_body(body.point_positions[points[0]])
            _hold_on_face(system, name, carrier, points, at)
        pivot = system.constraints.pivots.get(name)
        if pivot is None or len(placed.faces[pivot.name]) == 1:
            _hold_upright(system, name)
        if pivot is not None:
            _hold_pivot(system, name, pivot)


def _add_disc(system: System, disc: Body, relaxed: Motion, start: Mapping[str, Motion]) -> None:
    """Add a disc, relaxed in a motion; it starts there unless the start is moved."""
    begin = start.get(disc.name, relaxed)
    reference = relaxed.position[0]
    system.add_rigid(disc.name, RigidBody(system.mbs, disc, begin, reference=reference))


def _hold_pivot(system: System, name: str, pivot: Joint) -> None:
    """Hold a body in the frame by the faces of an ideal joint, numbered where there are several."""
    mbs, body, faces = (
        system.mbs,
        system.flexible[name],
        system.parts[name].joint_points(pivot.name),
    )
    for number, (face, moved) in enumerate(faces):
        position = [*pivot.at, float(body.reduced.interface(face).centre[2])]
        seat = mbs.AddMarker(MarkerBodyRigid(bodyNumber=system.ground, localPosition=position))
        ends = [body.add_point_marker(mbs, moved), seat]
        joint = ObjectJointSpherical(
            name=pivot.name if len(faces) == 1 else f"{pivot.name}_{number + 1}",
            markerNumbers=ends if pivot.bearing == GROUND else ends[::-1],
            constrainedAxes=[1, 1, int(len(faces) > 1 and number == 0)],
        )
        system.record(joint.name, "force", mbs.AddObject(joint))


def _hold_on_face(
    system: System,
    name: str,
    disc: str,
    points: tuple[str, str] = DRIVEN,
    at: Point = (0.0, 0.0),
) -> None:
    """Let a disc move in the plane with the mean motion of a body's face.

    A massless link along the tangent transmits a force, and the disc's pin its opposite: a couple
    on the face. A joint between frames would need twice as many equations, and a marker with three
    nodes. The first of the points is on the disc's pin, `at` in the disc's frame, which is turned
    as the body's.
    """
    mbs, body, number = system.mbs, system.flexible[name], system.bodies[disc]
    middle, rim = (np.array(body.point_positions[point]) for point in points)
    pinned = [*at, float(middle[2])]
    arm = RotationMatrixZ(-system.parts[name].angle) @ (rim - middle)
    end = pinned + arm + np.cross((0.0, 0.0, 1.0), arm)
    pin, link = (
        [
            mbs.AddMarker(MarkerBodyRigid(bodyNumber=number, localPosition=position)),
            body.add_point_marker(mbs, point),
        ]
        for point, position in zip(points, (pinned, end.tolist()), strict=True)
    )
    mbs.AddObject(ObjectJointRevolute2D(markerNumbers=pin))
    length = float(np.linalg.norm(arm))
    mbs.AddObject(ObjectConnectorDistance(markerNumbers=link, distance=length))


def _hold_upright(system: System, name: str) -> None:
    """Hold a body in the plane.

    The coordinates of its frame, the mean of its motion, are held, which costs least. A body that
    is not symmetric to the plane bends about that mean.
    """
    mbs, node = system.mbs, system.flexible[name].node_rigid
    for coordinate in OUT_OF_PLANE:
        marker = MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate)
        markers = [system.still, mbs.AddMarker(marker)]
        mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers))
