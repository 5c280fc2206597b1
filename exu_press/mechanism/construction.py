"""Construction of a drawing's points from lengths of links, as with compasses."""

import math

from exu_press.errors import InputError
from exu_press.mechanism.parts import Point

__all__ = ["intersect_links", "midpoint", "point_on_vertical"]


def midpoint(a: Point, b: Point) -> Point:
    """Return the midpoint of two points."""
    return 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])


def point_on_vertical(name: str, end: Point, length: float, x: float, side: int) -> Point:
    """Return the second end of a link, on the vertical at x; side -1 is below the first, +1 above.

    Raises:
        InputError: the link, `name`, is too short.
    """
    distance = abs(x - end[0])
    if length <= distance:
        raise InputError(f"{name} = {length:g}: needs > {distance:g} m at crank angle 0 deg")
    return x, end[1] + side * math.sqrt(length**2 - distance**2)


def intersect_links(
    name: str, a: Point, length_a: float, b: Point, length_b: float, side: int
) -> Point:
    """Return the joint of links from a and b; side +1 is to the left of the line from a to b.

    Raises:
        InputError: they do not meet.
    """
    base_x, base_y = b[0] - a[0], b[1] - a[1]
    base = math.hypot(base_x, base_y)
    if not abs(length_a - length_b) < base < length_a + length_b:
        raise InputError(
            f"{name} = {length_a:g}, {length_b:g}: must span {base:g} m at crank angle 0 deg"
        )
    along = (length_a**2 - length_b**2 + base**2) / (2.0 * base)
    across = side * math.sqrt(length_a**2 - along**2)
    c, s = base_x / base, base_y / base
    return a[0] + along * c - across * s, a[1] + along * s + across * c
