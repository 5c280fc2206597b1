"""Outlines of slots."""

import numpy as np

from exu_press.mechanism.guide_motion import guide_path
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import Guide
from exu_press.numerics.arrays import Array

__all__ = ["slot_outline"]

ARC = 25
"""Points of a slot's wall in pictures."""


def slot_outline(mechanism: Mechanism, guide: Guide, angle: Array, half_width: float) -> Array:
    """Return the corners (m, 2) of a slot in the drawing of the body that has it.

    Args:
        mechanism: with the slot.
        guide: the slot.
        angle: (n,) crank angles over which the pin moves, rad.
        half_width: m.
    """
    centre = np.array(guide.centre or (0.0, 0.0))
    arm = guide_path(mechanism, guide, angle) - centre
    along, across = np.array(guide.direction), np.array(guide.normal)
    at, radius = np.array(guide.at), guide.radius
    if radius is None:
        places = (arm - at) @ along
    else:
        places = radius * np.unwrap(np.arctan2(arm @ along, arm @ across))
    low, high = float(places.min()), float(places.max())
    if guide.length is not None:
        low, high = (guide.middle_along + side * guide.length for side in (-0.5, 0.5))
    walls = []
    for side in (1.0, -1.0):
        s = np.linspace(low, high, ARC)[:: int(side)]
        if radius is None:
            walls.append(at + np.outer(s, along) + side * half_width * across)
        else:
            outwards = np.outer(np.cos(s / radius), across) + np.outer(np.sin(s / radius), along)
            walls.append(centre + (radius + side * half_width) * outwards)
    return np.vstack(walls)
