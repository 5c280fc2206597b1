"""Flexible bodies in an Exudyn system, and their constraints in space.

NGSolve's modes come from fe_models: from its cache, or made there on first use. In the plane the
joints are those of rigid bodies; what the plane holds of itself is held here: a body that rests in
the frame by two faces along its axis by these, any other one by the mean of its motion.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    ObjectConnectorCoordinate,
    ObjectConnectorDistance,
    ObjectJointRevolute2D,
    ObjectJointSpherical,
)
from exudyn.rigidBodyUtilities import (
    EulerParameters2G,
    EulerParameters2RotationMatrix,
    RotationMatrixZ,
)

from exu_press.errors import InputError
from exu_press.joints.ends import FlexiblePoint
from exu_press.mechanism import GROUND, Guide, Joint, Mechanism, Motion, Point
from exu_press.model.placed_part import PlacedPart
from exu_press.numerics.arrays import Array
from exu_press.scene.applied_load import AppliedLoad
from fe_models import FlexibleBody, add_flexible_body

__all__ = [
    "FrameStart",
    "add_part",
    "deformed",
    "fitted_to_guide",
    "guide_end",
    "guided_motion",
    "hold_driven",
    "hold_pivot",
    "hold_upright",
    "joint_end",
    "load_point",
    "point_name",
    "undeformed",
]

DRIVEN = ("driven", "driven rim")
"""Points of the crank that move with the face that is driven: on the shaft's axis, and beside."""

OUT_OF_PLANE = (2, 4, 5)
"""Among a frame's coordinates: the height, and the Euler parameters of both tilts."""


@dataclass(frozen=True)
class FrameStart:
    """The start of a flexible body: its frame, and the modal coordinates if it is deformed.

    Attributes:
        position: of the frame's origin, (3,), m.
        rotation: from the body to the global frame, (3, 3).
        velocity: (3,), m/s.
        angular_velocity: global components, (3,), rad/s.
        modes: (n,), kg^0.5 m.
        modes_t: (n,), their rates.
    """

    position: Array
    rotation: Array
    velocity: Array
    angular_velocity: Array
    modes: Array | None = None
    modes_t: Array | None = None


def undeformed(start: Motion) -> FrameStart:
    """Return the start of a frame from its motion (x, y, angle) in the plane, one instant."""
    (x, y, angle), (u, v, omega) = start.position[0], start.velocity[0]
    return FrameStart(
        position=np.array([x, y, 0.0]),
        rotation=np.asarray(RotationMatrixZ(angle)),
        velocity=np.array([u, v, 0.0]),
        angular_velocity=np.array([0.0, 0.0, omega]),
    )


def shifted(start: FrameStart, body: Motion, away: Motion) -> FrameStart:
    """Return a start with the whole body moved.

    Args:
        start: before.
        body: motion of a point of the body in the plane before, one instant.
        away: changes of its position (x, y, angle) and velocity.
    """
    (x, y, _), (u, v, _) = body.position[0], body.velocity[0]
    dx, dy, turn = away.position[0]
    du, dv, omega = away.velocity[0]
    arm = start.position - np.array([x, y, 0.0])
    rate = start.velocity - np.array([u, v, 0.0])
    axis, rotation = np.array([0.0, 0.0, 1.0]), np.asarray(RotationMatrixZ(float(turn)))
    arm = rotation @ arm
    return replace(
        start,
        position=arm + np.array([x + dx, y + dy, 0.0]),
        rotation=rotation @ start.rotation,
        velocity=rotation @ rate + omega * np.cross(axis, arm) + np.array([u + du, v + dv, 0.0]),
        angular_velocity=start.angular_velocity + omega * axis,
    )


def deformed(
    mbs: exu.MainSystem, body: FlexibleBody, q: Array, q_t: Array, modes: Array, modes_t: Array
) -> FrameStart:
    """Return the start of a frame from a state of the body in another system.

    Args:
        mbs: that system.
        body: in it.
        q: (7,) displacements of the frame's coordinates, Euler parameters.
        q_t: (7,) their rates.
        modes: (n,) modal coordinates.
        modes_t: (n,) their rates.
    """
    pose = np.asarray(mbs.GetNodeParameter(body.node_rigid, "referenceCoordinates")) + q
    return FrameStart(
        position=pose[:3],
        rotation=np.asarray(EulerParameters2RotationMatrix(pose[3:])),
        velocity=q_t[:3],
        angular_velocity=np.asarray(EulerParameters2G(pose[3:])) @ q_t[3:],
        modes=modes,
        modes_t=modes_t,
    )


def add_part(
    mbs: exu.MainSystem,
    name: str,
    part: PlacedPart,
    start: FrameStart,
    mechanism: Mechanism,
    loads: Mapping[str, AppliedLoad],
    gravity: float,
) -> FlexibleBody:
    """Add a part, its points where the drawing has the joints and loads act.

    Args:
        mbs: the system.
        name: of the body.
        part: in its place.
        start: of the solid's frame and the modes.
        mechanism: for the joints.
        loads: of all bodies.
        gravity: downwards, m/s^2.
    """
    points = {}
    for joint in mechanism.joints:
        for body, point in mechanism.ends(joint):
            for number, face in enumerate(part.faces[joint.name] if body == name else ()):
                place = *part.place(point), _height(part, joint, face)
                points[point_name(joint, number)] = face, place
    for load_name, load in loads.items():
        for number, face in enumerate(part.loads[load_name] if load.body == name else ()):
            along = float(part.reduced.interface(face).centre[2])
            points[load_point(load_name, number)] = face, (*part.place(load.point), along)
    if part.drive:
        driven = part.reduced.interface(part.drive)
        x, y = part.place(mechanism.body(name).local(mechanism.shaft.at))
        for driven_point, arm in zip(DRIVEN, (0.0, driven.arm), strict=True):
            points[driven_point] = part.drive, (x + arm, y, float(driven.centre[2]))
    return add_flexible_body(
        mbs,
        part.reduced,
        position=start.position.tolist(),
        rotation=start.rotation,
        velocity=start.velocity.tolist(),
        angular_velocity=start.angular_velocity.tolist(),
        initial_modes=start.modes,
        initial_modes_t=start.modes_t,
        gravity=(0.0, -gravity, 0.0),
        damping_ratio=part.damping_ratio,
        points=points,
        name=name,
    )


def _height(part: PlacedPart, joint: Joint, face: str) -> float:
    """Return how high over the plane a joint holds a face, m; balls lie in the plane."""
    return 0.0 if joint.spherical else float(part.reduced.interface(face).centre[2])


def point_name(joint: Joint, number: int = 0) -> str:
    """Return the name of the point where a body's joint holds one of its faces."""
    return joint.name if number == 0 else f"{joint.name} {number + 1}"


def load_point(load: str, number: int = 0) -> str:
    """Return the name of the point where a load presses one of the faces that carry it."""
    return f"load {load} {number + 1}"


def joint_end(body: FlexibleBody, part: PlacedPart, joint: Joint, point: Point) -> Any:
    """Return an end of a clearance joint: the interface's motion, at the point (x, y).

    Raises:
        InputError: the joint holds several faces.
    """
    face, *others = part.faces[joint.name]
    if others:
        raise InputError(
            f"joints.{joint.name}: holds {1 + len(others)} faces of the flexible {body.part.name}; "
            "allowed is 'ideal'"
        )
    interface = body.part.interface(face)
    centre = np.array([*part.place(point), _height(part, joint, face)])
    if body.node_modes is None:
        return body.object_number, centre
    return FlexiblePoint(body.object_number, centre, interface.translation, interface.rotation)


def hold_pivot(
    mbs: exu.MainSystem, ground: int, body: FlexibleBody, part: PlacedPart, joint: Joint
) -> dict[str, int]:
    """Rest a body in the frame by the faces of an ideal joint; return the object numbers.

    Args:
        mbs: the system.
        ground: object number of the frame.
        body: flexible.
        part: of the body.
        joint: with the frame.
    """
    faces = part.faces[joint.name]
    held = {}
    for number, face in enumerate(faces):
        along = float(body.part.interface(face).centre[2])
        seat = mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground, localPosition=[*joint.at, along]))
        ends = [body.add_point_marker(mbs, point_name(joint, number)), seat]
        name = joint.name if len(faces) == 1 else f"{joint.name}_{number + 1}"
        lengthwise = int(len(faces) > 1 and number == 0)
        held[name] = int(
            mbs.AddObject(
                ObjectJointSpherical(
                    name=name,
                    markerNumbers=ends if joint.bearing == GROUND else ends[::-1],
                    constrainedAxes=[1, 1, lengthwise],
                )
            )
        )
    return held


def hold_driven(mbs: exu.MainSystem, disc: int, body: FlexibleBody, part: PlacedPart) -> None:
    """Turn a body by its driven face about its axis alone, as a disc turns that it carries there.

    A link along the tangent passes a force on, whose opposite goes through the disc's pin: the face
    feels a couple. A joint between frames would do the same with twice as many equations, and with
    a marker that has three nodes.

    Args:
        mbs: the system.
        disc: object number of the disc, which has next to no mass.
        body: flexible.
        part: of the body.
    """
    middle, rim = (np.array(body.places[point]) for point in DRIVEN)
    height = [0.0, 0.0, float(middle[2])]
    arm = RotationMatrixZ(-part.angle) @ (rim - middle)
    end = height + arm + np.cross((0.0, 0.0, 1.0), arm)
    pin, link = (
        [
            mbs.AddMarker(MarkerBodyRigid(bodyNumber=disc, localPosition=place)),
            body.add_point_marker(mbs, point),
        ]
        for point, place in zip(DRIVEN, (height, end.tolist()), strict=True)
    )
    mbs.AddObject(ObjectJointRevolute2D(markerNumbers=pin))
    length = float(np.linalg.norm(arm))
    mbs.AddObject(ObjectConnectorDistance(markerNumbers=link, distance=length))


def fitted_to_guide(
    start: FrameStart, part: PlacedPart, guide: Guide, held: tuple[bool, bool], pose: Array
) -> FrameStart:
    """Return the start that fits an ideal guide's constraints on a body.

    Where all joints are ideal others may hold it: ball joints, which give way with their bodies.

    Args:
        start: deformed.
        part: of the body.
        guide: of the body.
        held: whether the guide holds the displacement across it, and the angle.
        pose: x, y (m) and angle (rad) of the ideal mechanism's start.
    """
    if start.modes is None or start.modes_t is None:
        return start
    place, modes = part.carried((part.guide,), (0.0, 0.0))
    bent = part.reduced.interface(part.guide).rotation[2]
    omega = start.angular_velocity.copy()
    rotation = start.rotation
    if held[1]:
        angle = np.arctan2(rotation[1, 0], rotation[0, 0]) + part.angle + bent @ start.modes
        rotation = RotationMatrixZ(float(pose[2] - angle)) @ rotation
        omega[2] = -float(bent @ start.modes_t)
    position, velocity = start.position, start.velocity
    if held[0]:
        across = np.array([*guide.normal, 0.0])
        arm = rotation @ (place + modes @ start.modes)
        rate = velocity + np.cross(omega, arm) + rotation @ (modes @ start.modes_t)
        position = position - across * (across @ (position + arm - [pose[0], pose[1], 0.0]))
        velocity = velocity - across * (across @ rate)
    return replace(
        start,
        position=position,
        rotation=np.asarray(rotation),
        velocity=velocity,
        angular_velocity=omega,
    )


def guide_end(body: FlexibleBody, part: PlacedPart, point: Point) -> Any:
    """Return an end for guideways with clearance: a point carried by the faces in its guide."""
    place, modes = part.carried((part.guide,), point)
    if body.node_modes is None:
        return body.object_number, place
    rotation = part.reduced.interface(part.guide).rotation
    return FlexiblePoint(body.object_number, place, modes, rotation)


def guided_motion(mbs: exu.MainSystem, body: FlexibleBody, part: PlacedPart) -> tuple[Array, Array]:
    """Return the guided motion of a body, linear in its coordinates: x, y (m), angle (rad).

    It is the mean motion of the faces that lie in the guide, where the body has its centre of mass.
    In a guide a body hardly turns: the error goes with the square of its tilt.

    Returns:
        Its values where the coordinates have their reference values, (3,), and what displacements
        of the frame's coordinates and of the modes change them by, (3, coordinates).
    """
    pose = np.asarray(mbs.GetNodeParameter(body.node_rigid, "referenceCoordinates"))
    rotation = np.asarray(EulerParameters2RotationMatrix(pose[3:]))
    place, modes = part.carried((part.guide,), (0.0, 0.0))
    arm = rotation @ place
    turning = 2.0 * np.array([-pose[6], 0.0, 0.0, pose[3]])
    rows = np.zeros((3, len(pose) + part.reduced.mode_count))
    rows[:2, :2] = np.eye(2)
    rows[:, 3:7] = np.outer((-arm[1], arm[0], 1.0), turning)
    rows[:2, 7:] = (rotation @ modes)[:2]
    rows[2, 7:] = part.reduced.interface(part.guide).rotation[2]
    angle = 2.0 * np.arctan2(pose[6], pose[3]) + part.angle
    return np.array([pose[0] + arm[0], pose[1] + arm[1], angle]), rows


def hold_upright(
    mbs: exu.MainSystem, still: int, body: FlexibleBody, part: PlacedPart, pivot: Joint | None
) -> None:
    """Keep a body in the plane, unless the two faces of a pivot do.

    It is the frame that is kept there, the mean of the body's motion: its coordinates are held,
    which costs least. Out of the plane a body that is not symmetric to it bends about that mean.

    Args:
        mbs: the system.
        still: marker on a coordinate of the frame of the press.
        body: flexible.
        part: of the body.
        pivot: its ideal joint with the frame, if it has one.
    """
    if pivot is not None and len(part.faces[pivot.name]) > 1:
        return
    for coordinate in OUT_OF_PLANE:
        held = MarkerNodeCoordinate(nodeNumber=body.node_rigid, coordinate=coordinate)
        markers = [still, mbs.AddMarker(held)]
        mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers))
