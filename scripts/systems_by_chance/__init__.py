"""Kinds of systems by chance: functions that build one in the system of a `Chance`."""

from systems_by_chance.chance import Chance
from systems_by_chance.contact import falling
from systems_by_chance.flexible import beam, cable, rope
from systems_by_chance.lines import control, coordinates, row, stops
from systems_by_chance.planar import actuator, loop, planar
from systems_by_chance.spatial import chain, hanging, mounted, rolling, top, tree

__all__ = ["KINDS", "Chance"]

KINDS = (
    chain,
    hanging,
    planar,
    loop,
    row,
    coordinates,
    cable,
    top,
    tree,
    mounted,
    rolling,
    falling,
    stops,
    control,
    beam,
    rope,
    actuator,
)
