"""What turns the crank, and holds flexible bodies in space."""

from exu_press.mechanism import Body
from exu_press.model.bodies import in_frame
from exu_press.model.system import System
from exu_press.rigid import PivotedBody

__all__ = ["DRIVE", "add_drive", "hold_flexible_bodies"]

DRIVE = "drive"
"""Name of the disc that turns a flexible crank at its flange."""


def add_drive(system: System) -> int:
    """Turn the crank at constant speed, by a constraint on its angular velocity."""
    turned = DRIVE if system.flexible else system.mechanism.crank
    return system.hold(turned, "angle", velocityLevel=True, offset=system.scene.angular_speed)


def hold_flexible_bodies(system: System) -> dict[str, int]:
    """Hold crank and linkage in space; the crank is driven at its flange by a disc.

    Returns:
        name of a main bearing -> object number.
    """
    from exu_press.flexible import hold_crank, hold_linkage

    name = system.mechanism.crank
    shaft = in_frame(system, name, (0.0, 0.0))
    start = system.ideal[name].at((-shaft[0], -shaft[1]))
    disc = PivotedBody(system.mbs, Body(DRIVE, 1.0, 1.0), start, (0.0, 0.0), (0.0, 0.0))
    system.take_in(DRIVE, disc)
    slide = system.marker("slide", (0.0, 0.0))
    hold_linkage(system.mbs, slide, system.flexible["linkage"])
    disc_marker = system.marker(DRIVE, (0.0, 0.0))
    return hold_crank(system.mbs, system.ground, system.flexible[name], disc_marker)
