"""Slots: the ends that their pins may not reach, and their outlines."""

import math
from collections.abc import Mapping

import numpy as np

from exu_press.mechanism.guide_motion import Drawing, guide_path, motion_in_guide
from exu_press.mechanism.kinematics import MotionError
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import Guide
from exu_press.numerics.arrays import Array

__all__ = ["check_slot_ends", "slot_outline"]

ARC = 25
"""Points of a slot's wall in pictures."""


def check_slot_ends(mechanism: Drawing, angle: Array, motions: Mapping[str, Motion]) -> None:
    """Raise MotionError for the first crank angle, rad, (n,), at which a pin is at its slot's end.

    Args:
        mechanism: with slots.
        angle: (n,) crank angles from the drawing's, rad.
        motions: of its bodies there.
    """
    for guide in mechanism.guides:
        if guide.at is None or guide.length is None:
            continue
        position = motion_in_guide(mechanism, guide, motions)[0][:, :2] - np.array(guide.at)
        beside = position @ np.array(guide.direction) - _middle(guide)
        beyond = np.flatnonzero(np.abs(beside) > 0.5 * guide.length)
        if len(beyond):
            first = int(beyond[0])
            raise MotionError(
                f"{mechanism.name}: the pin of {guide.body} reaches an end of {guide.key} at crank "
                f"angle {math.degrees(angle[first]) % 360.0:.4g} deg; it needs a length of "
                f"{2.0 * np.abs(beside).max():.4g} m, and has {guide.length:g} m",
                (guide.body,),
                float(angle[first]),
                {name: motion.position[first] for name, motion in motions.items()},
            )


def slot_outline(mechanism: Drawing, guide: Guide, angle: Array, half_width: float) -> Array:
    """Return the corners (m, 2) of a slot in the drawing of the body that has it.

    Args:
        mechanism: with the slot.
        guide: the slot.
        angle: (n,) crank angles over which the pin moves, rad.
        half_width: m.
    """
    assert guide.at is not None
    centre = np.array(guide.centre or (0.0, 0.0))
    arm = guide_path(mechanism, guide, angle) - centre
    along, across = np.array(guide.direction), np.array(guide.normal)
    at, radius = np.array(guide.at), math.dist(guide.at, guide.centre or guide.at)
    if guide.centre is None:
        places = (arm - at) @ along
    else:
        places = radius * np.unwrap(np.arctan2(arm @ along, arm @ across))
    low, high = float(places.min()), float(places.max())
    if guide.length is not None:
        middle = _middle(guide)
        low, high = min(low, middle - 0.5 * guide.length), max(high, middle + 0.5 * guide.length)
    walls = []
    for side in (1.0, -1.0):
        s = np.linspace(low, high, ARC)[:: int(side)]
        if guide.centre is None:
            walls.append(at + np.outer(s, along) + side * half_width * across)
        else:
            size = radius + side * half_width
            turned = s / radius
            walls.append(
                centre + size * (np.outer(np.cos(turned), across) + np.outer(np.sin(turned), along))
            )
    return np.vstack(walls)


def _middle(guide: Guide) -> float:
    """Return the place of a slot's middle along it from the pin of the drawing, m."""
    assert guide.at is not None
    if guide.middle is None:
        return 0.0
    if guide.centre is None:
        return float((np.array(guide.middle) - np.array(guide.at)) @ np.array(guide.direction))
    x, y = np.array(guide.middle) - np.array(guide.centre)
    along, across = guide.direction, guide.normal
    turned = math.atan2(x * along[0] + y * along[1], x * across[0] + y * across[1])
    return math.dist(guide.at, guide.centre) * turned
