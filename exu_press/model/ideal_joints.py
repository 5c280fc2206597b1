"""The ideal joints of a system, as constraints."""

import math

import exudyn as exu
from exudyn.itemInterface import (
    MarkerBodyRigid,
    ObjectJointGeneric,
    ObjectJointRevolute2D,
    ObjectJointSpherical,
)
from exudyn.rigidBodyUtilities import RotationMatrixZ

from exu_press.errors import InputError
from exu_press.mechanism import GROUND, Joint
from exu_press.mechanism.independent_constraints import SingleAxis
from exu_press.model.system import System

__all__ = ["add_ideal_joint"]


def add_ideal_joint(system: System, joint: Joint) -> int:
    """Add a revolute joint, or a constraint in the single direction that is not redundant."""
    axis = system.constraints.single_axis.get(joint.name)
    if axis is not None:
        return _add_single_axis(system, joint, axis)
    markers = [system.joint_marker(joint, *end) for end in system.mechanism.ends(joint)]
    revolute = ObjectJointRevolute2D(name=joint.name, markerNumbers=markers)
    return int(system.mbs.AddObject(revolute))


def _add_single_axis(system: System, joint: Joint, axis: SingleAxis) -> int:
    """Constrain a joint's two bodies in one direction, which turns with one of them."""
    journal, bearing = system.mechanism.ends(joint)
    (body, point), end = (journal, bearing) if axis.body == joint.journal else (bearing, journal)
    flexible = [name for name in (body, end[0]) if name in system.flexible]
    if flexible:
        return _add_flexible_single_axis(system, joint, axis, flexible[0])
    local, angle = point, axis.angle
    if body != GROUND:
        local, angle = system.rigid[body].local(point), angle + system.rigid[body].frame_angle
    frame = exu.HT().Set(RotationMatrixZ(angle), [*local, 0.0])
    marker = MarkerBodyRigid(bodyNumber=system.bodies[body], localHT=frame)
    constraint = ObjectJointGeneric(
        name=joint.name,
        markerNumbers=[system.mbs.AddMarker(marker), system.joint_marker(joint, *end)],
        constrainedAxes=[1, 0, 0, 0, 0, 0],
    )
    number = int(system.mbs.AddObject(constraint))
    system.local_forces.add(number)
    return number


def _add_flexible_single_axis(system: System, joint: Joint, axis: SingleAxis, flexible: str) -> int:
    """Constrain a flexible body's joint in one direction, where a guide keeps that along x or y."""
    guided = {guide.body for guide in system.mechanism.guides}
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
    return int(system.mbs.AddObject(constraint))
