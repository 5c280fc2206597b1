"""Pitch circles of gears as seen from the front: drawn, not measured."""

import numpy as np

from exu_press.mechanism.gears import Gear
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import Point
from exu_press.numerics.arrays import Array

__all__ = ["pitch_circles"]

BELT = 0.6
"""Sum of both radii over the distance of the shafts, where a belt turns them alike."""

ANGLE = np.linspace(0.0, 2.0 * np.pi, 73)


def pitch_circles(mechanism: Mechanism) -> list[Array]:
    """Return closed outlines (n, 2), m, of gears between two shafts in the frame.

    Two wheels roll on each other where their bodies turn against each other; where they turn alike
    a belt surrounds them. Gears of bodies that have no shaft in the frame are not drawn.
    """
    outlines = []
    for gear in mechanism.gears:
        shafts = [_shaft(mechanism, body) for body in (gear.to, gear.body)]
        if None not in shafts:
            outlines += _outlines(gear, np.array(shafts, dtype=float))
    return outlines


def _shaft(mechanism: Mechanism, body: str) -> Point | None:
    return next((joint.at for joint in mechanism.joints_of(body) if joint.on_frame), None)


def _outlines(gear: Gear, shafts: Array) -> list[Array]:
    """Return the outlines of a gear between two shafts (2, 2), the one that it turns last."""
    share = np.array([abs(gear.ratio), 1.0]) / (1.0 + abs(gear.ratio))
    radii = share * np.hypot(*(shafts[1] - shafts[0])) * (BELT if gear.ratio > 0.0 else 1.0)
    outwards = np.column_stack([np.cos(ANGLE), np.sin(ANGLE)])
    circles = [shaft + radius * outwards for shaft, radius in zip(shafts, radii, strict=True)]
    if gear.ratio < 0.0:
        return circles
    outermost = np.argmax([(circle * outwards).sum(axis=1) for circle in circles], axis=0)
    belt = np.array(circles)[outermost, np.arange(len(ANGLE))]
    return [np.vstack([belt, belt[:1]])]
