"""What turns the crank, and holds flexible bodies in space."""

from collections.abc import Mapping

from exudyn.itemInterface import LoadCoordinate, ObjectConnectorCoordinateSpringDamper

from exu_press.mechanism import Body, Motion
from exu_press.mechanism.parts import DRIVE
from exu_press.model.system import System
from exu_press.rigid import RigidBody

__all__ = ["add_drive", "hold_flexible_bodies", "turned_body"]

DISC_MASS = 1e-3
"""kg: what turns a flexible crank, on which it rests, weighs nothing; but masses are positive."""


def add_drive(system: System) -> int:
    """Turn the crank: by a constraint on its angular velocity, or by a motor's torque.

    The motor's torque is linear in the speed: that at rest, less what a damper takes.
    """
    scene, turned = system.scene, turned_body(system)
    if scene.drive is None:
        return system.hold(turned, "angle", velocityLevel=True, offset=scene.angular_speed)
    angle = system.coordinate(turned, "angle")
    torque = scene.drive.torque_at_rest
    system.mbs.AddLoad(LoadCoordinate(markerNumber=angle, load=torque))
    damper = ObjectConnectorCoordinateSpringDamper(
        markerNumbers=[system.still, angle], damping=scene.drive.damping(scene.speed_rpm)
    )
    return int(system.mbs.AddObject(damper))


def turned_body(system: System) -> str:
    """Return the rigid body that the drive turns: the crank, or the disc of a flexible one."""
    crank = system.mechanism.crank
    return DRIVE if crank in system.flexible else crank


def hold_flexible_bodies(system: System, start: Mapping[str, Motion]) -> dict[str, int]:
    """Hold flexible bodies in space; a flexible crank is driven by a disc.

    Args:
        system: with all bodies in it.
        start: name -> motion at the start, where it is not the ideal mechanism's.

    Returns:
        name of a joint with the frame, numbered where it holds several faces -> object number.
    """
    from exu_press.flexible import hold_driven, hold_pivot, hold_upright

    mbs = system.mbs
    held: dict[str, int] = {}
    for name, body in system.flexible.items():
        part = system.parts[name]
        if name == system.mechanism.crank:
            _add_disc(system, start.get(DRIVE))
            hold_driven(mbs, system.bodies[DRIVE], body, part)
        pivot = system.holding.pivoted.get(name)
        hold_upright(mbs, system.still, body, part, pivot)
        if pivot is not None:
            held |= hold_pivot(mbs, system.ground, body, part, pivot)
    return held


def _add_disc(system: System, start: Motion | None) -> None:
    """Add the disc that turns a flexible crank, on the shaft's axis unless that has moved."""
    crank = system.mechanism.body(system.mechanism.crank)
    relaxed = system.ideal[crank.name].at(crank.local(system.mechanism.shaft.at))
    motor = system.scene.drive
    inertia = 1.0 if motor is None else motor.inertia
    disc = Body(DRIVE, DISC_MASS, inertia)
    system.take_in(
        DRIVE, RigidBody(system.mbs, disc, start or relaxed, reference=relaxed.position[0])
    )
