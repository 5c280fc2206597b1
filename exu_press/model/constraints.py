"""The constraints of a system: ideal joints, gears, and the drive of its crank."""

import math
from collections.abc import Callable
from typing import Any

import exudyn as exu
from exudyn.itemInterface import (
    MarkerBodyRigid,
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateSpringDamper,
    ObjectJointGeneric,
    ObjectJointRevolute2D,
    ObjectJointSpherical,
)
from exudyn.rigidBodyUtilities import RotationMatrixZ

from exu_press.errors import InputError
from exu_press.mechanism import GROUND, Gear, Joint, Point
from exu_press.mechanism.independent_constraints import SingleAxis
from exu_press.mechanism.parts import DRIVE, FLYWHEEL
from exu_press.model.system import System

__all__ = [
    "CrankAngle",
    "add_drive",
    "add_gear",
    "add_ideal_joint",
    "crank_angle_of",
    "hold_direction",
    "turned_body",
]

CrankAngle = Callable[[], tuple[float, float]]
"""Angle, rad, and angular velocity, rad/s, of the driven body in the current state."""


def add_ideal_joint(system: System, joint: Joint) -> None:
    """Add a revolute joint, or a constraint in the single direction that is not redundant."""
    axis = system.constraints.single_axis.get(joint.name)
    if axis is not None:
        _add_single_axis(system, joint, axis)
        return
    markers = [system.joint_marker(joint, *end) for end in system.mechanism.ends(joint)]
    revolute = ObjectJointRevolute2D(name=joint.name, markerNumbers=markers)
    system.record(joint.name, "force", system.mbs.AddObject(revolute))


def _add_single_axis(system: System, joint: Joint, axis: SingleAxis) -> None:
    """Constrain a joint's two bodies in one direction, which turns with one of them."""
    journal, bearing = system.mechanism.ends(joint)
    (body, point), end = (journal, bearing) if axis.body == joint.journal else (bearing, journal)
    flexible = [name for name in (body, end[0]) if name in system.flexible]
    if flexible:
        _add_flexible_single_axis(system, joint, axis, flexible[0])
        return
    marker = system.joint_marker(joint, *end)
    hold_direction(system, joint.name, (body, point), axis.angle, marker)


def hold_direction(
    system: System, name: str, end: tuple[str, Point], angle: float, marker_of_point: int
) -> None:
    """Hold a point of a body on a line of another rigid one.

    The recorded force, along the normal, is that on the body with the line.

    Args:
        system: with both bodies.
        name: of the constraint.
        end: body with the line, or the frame, and a point of the line in the body's frame.
        angle: of the line's normal in that frame, rad.
        marker_of_point: number of the marker of the point that is held.
    """
    body, local = end
    if body != GROUND:
        local, angle = system.rigid[body].local(local), angle + system.frame_angle(body)
    frame = exu.HT().Set(RotationMatrixZ(angle), [*local, 0.0])
    marker = MarkerBodyRigid(bodyNumber=system.bodies[body], localHT=frame)
    constraint = ObjectJointGeneric(
        name=name,
        markerNumbers=[system.mbs.AddMarker(marker), marker_of_point],
        constrainedAxes=[1, 0, 0, 0, 0, 0],
    )
    number = system.mbs.AddObject(constraint)
    system.record(name, "force", number, exu.OutputVariableType.ForceLocal)


def _add_flexible_single_axis(
    system: System, joint: Joint, axis: SingleAxis, flexible: str
) -> None:
    """Constrain a flexible body's joint in one direction, where a guide keeps that along x or y."""
    guided = {guide.body for guide in system.mechanism.guides if guide.is_rail}
    angle = axis.angle
    if axis.body != GROUND:
        angle += float(system.ideal[axis.body].position[0, 2])
    axes = [round(abs(c), 9) for c in (math.cos(angle), math.sin(angle))]
    if axis.body not in {*guided, GROUND} or sorted(axes) != [0.0, 1.0]:
        raise InputError(
            f"bodies.{flexible}: one constraint of joints.{joint.name} is redundant; allowed is a "
            "rigid body there, such a joint with clearance, or one between guides along x or y"
        )
    markers = [system.joint_marker(joint, *end) for end in system.mechanism.ends(joint)]
    constraint = ObjectJointSpherical(
        name=joint.name, markerNumbers=markers, constrainedAxes=[*map(int, axes), 0]
    )
    system.record(joint.name, "force", system.mbs.AddObject(constraint))


def add_drive(system: System) -> None:
    """Drive the crank: by a constraint on its angular velocity, or by a motor's torque.

    Exudyn differentiates the torque of the motor's connector numerically for Newton's method.
    """
    scene, turned = system.scene, turned_body(system)
    if scene.drive is None:
        number = system.hold(turned, "angle", velocityLevel=True, offset=scene.angular_speed)
        system.record("drive", "force", number)
        return
    law = scene.drive.torque.law(scene.speed_rpm)

    def negative_torque(
        mbs: Any, t: float, item: int, angle: float, speed: float, k: float, d: float, zero: float
    ) -> float:
        return -law(speed)[0]

    function: Any = negative_torque
    motor = ObjectConnectorCoordinateSpringDamper(
        markerNumbers=[
            system.still,
            system.coordinate(FLYWHEEL if FLYWHEEL in system.rigid else turned, "angle"),
        ],
        springForceUserFunction=function,
    )
    system.record("drive", "force", system.mbs.AddObject(motor))


def add_gear(system: System, gear: Gear) -> None:
    """Hold the angles of two rigid bodies in their ratio; a flexible crank's is that of its disc.

    The force of the constraint is the torque on the geared body, N m.
    """
    to = turned_body(system) if gear.to == system.mechanism.crank else gear.to
    constraint = ObjectConnectorCoordinate(
        markerNumbers=[system.coordinate(gear.body, "angle"), system.coordinate(to, "angle")],
        factor1=gear.ratio,
    )
    system.record(f"gear_{gear.name}", "torque", system.mbs.AddObject(constraint))


def turned_body(system: System) -> str:
    """Return the rigid body that the drive turns: the crank, or a flexible crank's disc."""
    crank = system.mechanism.crank
    return DRIVE if crank in system.flexible else crank


def crank_angle_of(system: System) -> CrankAngle:
    """Return the function of the crank's angle from the mechanism's zero and its velocity."""
    data: Any = system.mbs.systemData
    turned, current = system.rigid[turned_body(system)], exu.ConfigurationType.Current
    column = turned.coordinates.index("angle")
    zero = float(turned.reference[2]) - system.mechanism.body(system.mechanism.crank).angle
    index: list[int] = []  # among all coordinates: not known before the system is assembled

    def angle() -> tuple[float, float]:
        if not index:
            index.append(system.mbs.GetNodeODE2Index(turned.node) + column)
        q = data.GetODE2Coordinates(current, False)[index[0]]
        return zero + float(q), float(data.GetODE2Coordinates_t(current, False)[index[0]])

    return angle
