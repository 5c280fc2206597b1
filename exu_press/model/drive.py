"""What turns the crank, and holds flexible bodies in space."""

from exu_press.mechanism import Body
from exu_press.model.system import System
from exu_press.rigid import PivotedBody

__all__ = ["DRIVE", "add_drive", "hold_flexible_bodies", "turned_body"]

DRIVE = "drive"
"""Name of the disc that turns a flexible crank."""


def add_drive(system: System) -> int:
    """Turn the crank at constant speed, by a constraint on its angular velocity."""
    turned = turned_body(system)
    return system.hold(turned, "angle", velocityLevel=True, offset=system.scene.angular_speed)


def turned_body(system: System) -> str:
    """Return the rigid body that the drive turns: the crank, or the disc of a flexible one."""
    crank = system.mechanism.crank
    return DRIVE if crank in system.flexible else crank


def hold_flexible_bodies(system: System) -> dict[str, int]:
    """Hold flexible bodies in space; a flexible crank is driven by a disc.

    Returns:
        name of a joint with the frame, numbered where it holds several faces -> object number.
    """
    from exu_press.flexible import hold_driven, hold_pivot, hold_upright

    mbs = system.mbs
    held: dict[str, int] = {}
    for name, body in system.flexible.items():
        part = system.parts[name]
        if name == system.mechanism.crank:
            _add_disc(system)
            hold_driven(mbs, system.bodies[DRIVE], body, part)
        hold_upright(mbs, system.ground, body)
        pivot = system.holding.pivoted.get(name)
        if pivot is not None:
            held |= hold_pivot(mbs, system.ground, body, part, pivot)
    return held


def _add_disc(system: System) -> None:
    """Add the disc that turns a flexible crank, on the shaft's axis."""
    crank = system.mechanism.body(system.mechanism.crank)
    shaft = system.mechanism.shaft
    start = system.ideal[crank.name].at(crank.local(shaft.at))
    disc = PivotedBody(system.mbs, Body(DRIVE, 1.0, 1.0), start, shaft.at, (0.0, 0.0))
    system.take_in(DRIVE, disc)
