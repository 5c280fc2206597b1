"""The drive of the crank, and the support of flexible bodies in space."""

from collections.abc import Callable, Mapping
from typing import Any

import exudyn as exu
from exudyn.itemInterface import (
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateSpringDamper,
)

from exu_press.mechanism import Body, Gear, Motion
from exu_press.mechanism.parts import DRIVE, FLYWHEEL
from exu_press.model.rigid_body import RigidBody
from exu_press.model.system import System

__all__ = [
    "CrankAngle",
    "add_drive",
    "add_gear",
    "crank_angle_of",
    "hold_flexible_bodies",
    "turned_body",
]

CrankAngle = Callable[[], tuple[float, float]]
"""Angle, rad, and angular velocity, rad/s, of the driven body in the current state."""

DISC_MASS = 1e-3
"""Mass of the disc on a flexible crank, kg: negligible, but not zero."""

CARRIER_INERTIA = 1e-5
"""Mass and inertia of a disc that moves with a face, over those of its body: likewise."""


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


def hold_flexible_bodies(system: System, start: Mapping[str, Motion]) -> None:
    """Hold flexible bodies in the plane and on pivots of the frame.

    A disc drives a flexible crank, and one moves with each face in a slot or a moving guide.

    Args:
        system: with all bodies in it.
        start: name -> motion at the start, where it is not the ideal mechanism's.
    """
    from exu_press.model.flexible_body import (
        guide_points,
        hold_on_face,
        hold_pivot,
        hold_upright,
    )

    mbs = system.mbs
    for name, body in system.flexible.items():
        placed = system.parts[name]
        if name == system.mechanism.crank:
            _add_disc(system, start.get(DRIVE))
            hold_on_face(mbs, system.bodies[DRIVE], body, placed)
        for guide in placed.carriers:
            carrier, points = system.carriers[guide, name], guide_points(guide)
            _add_carrier(system, carrier, name, start.get(carrier))
            at = placed.to_body(body.point_positions[points[0]])
            hold_on_face(mbs, system.bodies[carrier], body, placed, points, at)
        pivot = system.constraints.pivots.get(name)
        hold_upright(mbs, system.still, body, placed, pivot)
        if pivot is not None:
            for joint, number in hold_pivot(mbs, system.ground, body, placed, pivot).items():
                system.record(joint, "force", number)


def _add_disc(system: System, start: Motion | None) -> None:
    """Add the disc that turns a flexible crank, on the shaft's axis unless the start is moved."""
    crank = system.mechanism.body(system.mechanism.crank)
    relaxed = system.ideal[crank.name].point_motion(crank.local(system.mechanism.shaft.at))
    motor = system.scene.drive
    inertia = 1.0 if motor is None else motor.on_crank
    disc = Body(DRIVE, DISC_MASS, inertia)
    system.add_rigid(
        DRIVE, RigidBody(system.mbs, disc, start or relaxed, reference=relaxed.position[0])
    )


def _add_carrier(system: System, carrier: str, body: str, start: Motion | None) -> None:
    """Add the disc that moves with a face of a flexible body; its frame is the body's."""
    relaxed = system.ideal[body]
    solid = system.parts[body]
    disc = Body(carrier, CARRIER_INERTIA * solid.reduced.mass, CARRIER_INERTIA * solid.inertia)
    system.add_rigid(
        carrier, RigidBody(system.mbs, disc, start or relaxed, reference=relaxed.position[0])
    )
