"""Slopes of bent shafts in their bearings."""

from collections.abc import Iterator

import numpy as np

from exu_press.numerics.arrays import lengths
from exu_press.quantities.kind import MOTION
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene, mechanism_of

__all__ = ["SLOPES", "slope_warnings"]

THIN = 0.5
"""Film at an end over that in the middle, below which a parallel journal is no good model."""

SMOOTH = 1e-9
"""Film of smooth surfaces that touch, m: less than any that is."""


def _can_slope(scene: Scene, joint: str) -> bool:
    """Return whether a flexible body holds a journal or its bearing."""
    (described,) = (j for j in mechanism_of(scene).joints if j.name == joint)
    ends = described.journal, described.bearing
    return not described.spherical and any(body in scene.bodies for body in ends)


def _peak_slope(run: Reading, joint: str) -> float | None:
    slope = run.channel(f"{joint}_slope")
    return None if slope is None else float(lengths(slope).max())


def slope_warnings(run: Reading) -> Iterator[str]:
    """Yield films that a bent shaft makes thinner at an end of the bearing than the law knows."""
    result = run.result
    for name, joint in result.joints.items():
        film = result.scene.joints[name].film
        if film is None or film.length is None or f"{name}_slope" not in result:
            continue
        at_end = 0.5 * film.length * result[f"{name}_slope"]
        sides = (lengths(joint.eccentricity + sign * at_end) for sign in (1.0, -1.0))
        end = joint.clearance - np.maximum(*sides)
        middle = joint.clearance - joint.distance
        least = film.contact_gap or SMOOTH  # that asperities leave where the middle touches
        share = 1.0 - (middle - end) / np.maximum(middle, least)
        worst = int(np.argmin(share))
        if share[worst] < THIN:
            slope, thin, thick = (
                1e6 * float(values[worst])
                for values in (
                    lengths(result[f"{name}_slope"]),
                    np.maximum(end, 0.0),
                    np.maximum(middle, 0.0),
                )
            )
            yield (
                f"{name.replace('_', ' ')}: the shaft's slope of {slope:.3g} urad leaves "
                f"{thin:.3g} um of film at an end of the bearing, where the middle has "
                f"{thick:.3g} um; the film's law is that of a parallel journal: film.tilt of rigid "
                "bodies shows what that changes"
            )


SLOPES = (
    Quantity("peak_slope", "rad", "largest angle between the axes of journal and bearing",
             MOTION, _peak_slope, Owner.JOINT, _can_slope,
             display_unit="urad", extreme=Extreme.LARGEST),
)  # fmt: skip
