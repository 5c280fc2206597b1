"""Points of a drawing from lengths, with compasses: where links of given lengths meet."""

import math

from exu_press.errors import InputError
from exu_press.mechanism.parts import Point

__all__ = ["meet", "middle", "onto"]


def middle(a: Point, b: Point) -> Point:
    """Return the point half-way between two."""
    return 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])


def onto(name: str, end: Point, length: float, x: float, side: int) -> Point:
    """Return the end of a link on the vertical at x; side -1 is below the other end, +1 above.

    Raises:
        InputError: the link, `name`, is too short.
    """
    aside = x - end[0]
    if length <= abs(aside):
        raise InputError(f"{name} = {length:g}: needs > {abs(aside):g} m at crank angle 0 deg")
    return x, end[1] + side * math.sqrt(length**2 - aside**2)


def meet(name: str, a: Point, length_a: float, b: Point, length_b: float, side: int) -> Point:
    """Return where links from a and b meet; side +1 is to the left of the line from a to b.

    Raises:
        InputError: they do not.
    """
    base_x, base_y = b[0] - a[0], b[1] - a[1]
    far = math.hypot(base_x, base_y)
    if not abs(length_a - length_b) < far < length_a + length_b:
        raise InputError(
            f"{name} = {length_a:g}, {length_b:g}: must span {far:g} m at crank angle 0 deg"
        )
    along = (length_a**2 - length_b**2 + far**2) / (2.0 * far)
    aside = side * math.sqrt(length_a**2 - along**2)
    c, s = base_x / far, base_y / far
    return a[0] + along * c - aside * s, a[1] + along * s + aside * c
