"""The gears of a system, as constraints between two angles."""

from exudyn.itemInterface import ObjectConnectorCoordinate

from exu_press.mechanism.gears import Gear
from exu_press.model.drive import turned_body
from exu_press.model.system import System

__all__ = ["add_gear"]


def add_gear(system: System, gear: Gear) -> int:
    """Hold the angles of two rigid bodies in their ratio; a flexible crank's is that of its disc.

    The force of the constraint is the torque on the geared body, N m.
    """
    to = turned_body(system) if gear.to == system.mechanism.crank else gear.to
    constraint = ObjectConnectorCoordinate(
        name=f"gear_{gear.name}",
        markerNumbers=[system.coordinate(gear.body, "angle"), system.coordinate(to, "angle")],
        factor1=gear.ratio,
    )
    return int(system.mbs.AddObject(constraint))
