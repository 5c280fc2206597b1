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
    """Add a revolute joint, or a constraint in the one direction that nothing else holds."""
    half = system.constraints.single_axis.get(joint.name)
    if half is not None:
        return _hold_half(system, joint, half)
    markers = [system.joint_marker(joint, *end) for end in system.mechanism.ends(joint)]
    revolute = ObjectJointRevolute2D(name=joint.name, markerNumbers=markers)
    return int(system.mbs.AddObject(revolute))


def _hold_half(system: System, joint: Joint, half: SingleAxis) -> int:
    """Hold a joint's two bodies together in one direction, which turns with one of them."""
    journal, bearing = system.mechanism.ends(joint)
    (body, point), end = (journal, bearing) if half.body == joint.journal else (bearing, journal)
    loose = [name for name in (body, end[0]) if name in system.flexible]
    if loose:
        return _hold_along(system, joint, half, loose[0])
    local, angle = point, half.angle
    if body != GROUND:
        local, angle = system.rigid[body].local(point), angle + system.rigid[body].turned
    frame = exu.HT().Set(RotationMatrixZ(angle), [*local, 0.0])
    marker = MarkerBodyRigid(bodyNumber=system.bodies[body], localHT=frame)
    along = system.mbs.AddMarker(marker)
    held = ObjectJointGeneric(
        name=joint.name,
        markerNumbers=[along, system.joint_marker(joint, *end)],
        constrainedAxes=[1, 0, 0, 0, 0, 0],
    )
    number = int(system.mbs.AddObject(held))
    system.local_forces.add(number)
    return number


def _hold_along(system: System, joint: Joint, half: SingleAxis, flexible: str) -> int:
    """Hold a flexible body's joint in the one direction, where a guide keeps that along x or y."""
    guided = {guide.body for guide in system.mechanism.guides}
    angle = half.angle
    if half.body != GROUND:
        angle += float(system.ideal[half.body].position[0, 2])
    axes = [round(abs(c), 9) for c in (math.cos(angle), math.sin(angle))]
    if half.body not in {*guided, GROUND} or sorted(axes) != [0.0, 1.0]:
        raise InputError(
            f"bodies.{flexible}: one constraint of joints.{joint.name} is redundant; allowed is a "
            "rigid body there, such a joint with clearance, or one between guides along x or y"
        )
    markers = [system.joint_marker(joint, *end) for end in system.mechanism.ends(joint)]
    held = ObjectJointSpherical(
        name=joint.name, markerNumbers=markers, constrainedAxes=[*map(int, axes), 0]
    )
    return int(system.mbs.AddObject(held))
