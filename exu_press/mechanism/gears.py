"""Geared shafts: a body turns an integer number of times as fast as another.

A gear is a constraint between two angles, whatever it is made of: a pair of wheels, a train with
idlers, a toothed belt. So the forces of teeth on the shafts' bearings are not in it; they depend on
radii and pressure angles that a drawing of links does not have.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from exu_press.errors import InputError
from exu_press.schema.checks import demand_known, demand_number

__all__ = ["Gear", "check_gears"]

LARGEST_RATIO = 1000.0
"""More than a train of a press has; angles keep twelve digits up to it."""


@dataclass(frozen=True)
class Gear:
    """Two bodies whose rotations from the drawing have an integer ratio.

    Attributes:
        name: as in the result's channels.
        body: that is geared.
        ratio: of its angular velocity to that of `to`, an integer but 0; negative where they turn
            against each other.
        to: body whose rotation counts; `Mechanism` fills in the crank.
    """

    name: str
    body: str
    ratio: float
    to: str = ""


def check_gears(gears: Sequence[Gear], bodies: Collection[str], crank: str) -> None:
    """Raise InputError for the first gear that cannot be.

    Args:
        gears: whose base is known.
        bodies: names of all bodies.
        crank: name of the driven body.
    """
    for gear in gears:
        where = f"gears.{gear.name}"
        for key, body in (("body", gear.body), ("to", gear.to)):
            demand_known(f"{where}.{key} = {body!r}: unknown", body, bodies)
        if gear.body == gear.to:
            raise InputError(f"{where}: gears {gear.body!r} to itself; allowed are two bodies")
        if gear.body == crank:
            raise InputError(
                f"{where}.body = {crank!r}: is the crank, which the drive turns; allowed is a body "
                "that it turns"
            )
        demand_number(f"{where}.ratio", gear.ratio)
        if not 1.0 <= abs(gear.ratio) <= LARGEST_RATIO or gear.ratio != round(gear.ratio):
            raise InputError(
                f"{where}.ratio = {gear.ratio!r}: allowed is an integer, not 0, of at most "
                f"{LARGEST_RATIO:g}, such as -1 for a shaft that turns against the other one"
            )
