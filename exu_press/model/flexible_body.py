"""Flexible bodies in an Exudyn system, with the points where joints, guides and loads act.

Modes come from fe_models.
"""

from dataclasses import dataclass, replace

import exudyn as exu
import numpy as np
from exudyn.rigidBodyUtilities import (
    EulerParameters2G,
    EulerParameters2RotationMatrix,
    RotationMatrixZ,
)

from exu_press.mechanism import Guide, Motion
from exu_press.model.placed_part import PlacedPart
from exu_press.model.system import System
from exu_press.numerics.arrays import Array
from fe_models import FlexibleBody, add_flexible_body

__all__ = [
    "DRIVEN",
    "FrameStart",
    "add_part",
    "fit_to_guide",
    "guide_points",
    "shift_start",
    "start_from_state",
    "undeformed_start",
]

DRIVEN = ("driven", "driven rim")
"""Points that move with the driven face of the crank: on the shaft's axis, and beside it."""


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


def undeformed_start(start: Motion) -> FrameStart:
    """Return the start of a frame from its motion (x, y, angle) in the plane, one instant."""
    (x, y, angle), (u, v, omega) = start.position[0], start.velocity[0]
    return FrameStart(
        position=np.array([x, y, 0.0]),
        rotation=np.asarray(RotationMatrixZ(angle)),
        velocity=np.array([u, v, 0.0]),
        angular_velocity=np.array([0.0, 0.0, omega]),
    )


def shift_start(start: FrameStart, body: Motion, change: Motion) -> FrameStart:
    """Return a start with the whole body moved.

    Args:
        start: of the unmoved body.
        body: motion of a point of the unmoved body in the plane, one instant.
        change: of the point's position (x, y, angle) and velocity.
    """
    (x, y, _), (u, v, _) = body.position[0], body.velocity[0]
    dx, dy, turn = change.position[0]
    du, dv, omega = change.velocity[0]
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


def start_from_state(
    mbs: exu.MainSystem, body: FlexibleBody, q: Array, q_t: Array, modes: Array, modes_t: Array
) -> FrameStart:
    """Return the start of a frame from the body's state in another system.

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


def add_part(system: System, name: str, start: FrameStart) -> FlexibleBody:
    """Add a body's part in its start, with the points where joints, guides and loads act."""
    placed, mechanism = system.parts[name], system.mechanism
    points = {}
    for joint in mechanism.joints:
        for body, point in mechanism.ends(joint):
            for face, moved in placed.joint_points(joint.name) if body == name else ():
                points[moved] = face, placed.joint_centre(joint, face, point)
    for load_name, load in system.applied_loads.items():
        for face, moved in placed.load_points(load_name) if load.body == name else ():
            height = float(placed.reduced.interface(face).centre[2])
            points[moved] = face, (*placed.to_solid(load.point), height)
    carriers = {guide_points(guide): face for guide, face in placed.carriers.items()}
    for names, face in (carriers | ({DRIVEN: placed.drive} if placed.drive else {})).items():
        interface = placed.reduced.interface(face)
        u, v, z = (float(value) for value in interface.centre)
        if names == DRIVEN:
            u, v = placed.to_solid(mechanism.body(name).local(mechanism.shaft.at))
        for moved, arm in zip(names, (0.0, interface.arm), strict=True):
            points[moved] = face, (u + arm, v, z)
    return add_flexible_body(
        system.mbs,
        placed.reduced,
        position=start.position.tolist(),
        rotation=start.rotation,
        velocity=start.velocity.tolist(),
        angular_velocity=start.angular_velocity.tolist(),
        initial_modes=start.modes,
        initial_modes_t=start.modes_t,
        gravity=(0.0, -system.scene.gravity, 0.0),
        damping_ratio=placed.damping_ratio,
        points=points,
        name=name,
    )


def guide_points(guide: str) -> tuple[str, str]:
    """Return the names of the points that move with a slot's or a moving guide's face."""
    return f"guide {guide}", f"guide {guide} rim"


def fit_to_guide(
    start: FrameStart, placed: PlacedPart, guide: Guide, holds: tuple[bool, bool], pose: Array
) -> FrameStart:
    """Return a start that satisfies an ideal guide's constraints on a body.

    In the ideal start ball joints may hold the body instead, which move with flexible bodies.

    Args:
        start: deformed.
        placed: part of the body.
        guide: of the body.
        holds: whether the guide holds the displacement along its normal, and the angle.
        pose: x, y (m) and angle (rad) in the ideal mechanism's start.
    """
    if start.modes is None or start.modes_t is None:
        return start
    centre, modes = placed.carried_point((placed.guide,), (0.0, 0.0))
    bending = placed.reduced.interface(placed.guide).rotation[2]
    omega = start.angular_velocity.copy()
    rotation = start.rotation
    if holds[1]:
        angle = np.arctan2(rotation[1, 0], rotation[0, 0]) + placed.angle + bending @ start.modes
        rotation = RotationMatrixZ(float(pose[2] - angle)) @ rotation
        omega[2] = -float(bending @ start.modes_t)
    position, velocity = start.position, start.velocity
    if holds[0]:
        normal = np.array([*guide.normal, 0.0])
        arm = rotation @ (centre + modes @ start.modes)
        rate = velocity + np.cross(omega, arm) + rotation @ (modes @ start.modes_t)
        position = position - normal * (normal @ (position + arm - [pose[0], pose[1], 0.0]))
        velocity = velocity - normal * (normal @ rate)
    return replace(
        start,
        position=position,
        rotation=np.asarray(rotation),
        velocity=velocity,
        angular_velocity=omega,
    )
