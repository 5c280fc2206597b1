"""Transmission angles of a mechanism's dyads over the crank angle.

A dyad is a group of two bodies: two links (RRR), a link and a body on a guide (RRP), or a block on
a pin that slides on a link (RPR). The transmission angle is the acute angle between two lines [1]_:
those of the two links, or the link and the normal of the guide; in the latter dyad the normal of
the guide, along which the block presses, and the line from the pin to the link's other joint. A
body with a slot has one as well: between the slot's normal and the line from the pin to the body's
pivot, or the normal of its guide. A link drives its body best at 90 deg; at 0 deg the dyad locks.
Textbooks recommend 40 to 50 deg at least.

References
----------
.. [1] J. J. Uicker, G. R. Pennock, J. E. Shigley, Theory of Machines and Mechanisms, 5th ed.,
   Oxford University Press 2017, sections 1.10 and 3.18.
"""

from collections.abc import Mapping

import numpy as np
from scipy.optimize import minimize_scalar

from exu_press.mechanism.groups import groups_of
from exu_press.mechanism.guide_motion import guide_direction
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Guide, Joint
from exu_press.numerics.arrays import Array

__all__ = ["group_equal_angles", "least_transmission_angle", "transmission_angles"]

NEIGHBOUR = np.radians(1.0)


def transmission_angles(mechanism: Mechanism, angle: Array) -> dict[str, Array]:
    """Return transmission angles (n,), rad, by the name of the joint or guide inside each dyad.

    Other groups have none.

    Args:
        mechanism: with one degree of freedom.
        angle: (n,) crank angles from the drawing's, rad.

    Raises:
        InputError: the crank does not turn through a revolution.
    """
    motion = mechanism.motion(angle, 1.0)

    def path(element: Joint | Guide) -> Array:
        if isinstance(element, Guide):
            ends = [mechanism.guided_end(element)]
        else:
            ends = [end for end in mechanism.ends(element) if end[0] != GROUND]
        body, point = ends[0]
        return motion[body].point_motion(point).position[:, :2]

    transmission: dict[str, Array] = {}
    for group in groups_of(mechanism.constraints, mechanism.crank):
        dyad = {*group.bodies}
        elements: tuple[Joint | Guide, ...] = (*mechanism.joints, *mechanism.guides)
        inner = [element for element in elements if element.bodies == dyad]
        outer = [
            element
            for element in elements
            if len(element.bodies & dyad) == 1 and element.bodies & group.predecessors
        ]
        slots = [element for element in outer if isinstance(element, Guide) and element.is_slot]
        if len(dyad) == 1 and len(slots) == 1 and len(outer) == 2:
            (slot,) = slots
            holding = next(element for element in outer if element is not slot)
            lines = [guide_direction(mechanism, slot, slot.normal, motion)]
            if isinstance(holding, Guide):
                lines.append(guide_direction(mechanism, holding, holding.normal, motion))
            else:
                lines.append(path(slot) - path(holding))
            transmission[slot.name] = _acute_angle(*lines)
            continue
        if len(dyad) != 2 or slots:
            continue
        pins = [element for element in outer if isinstance(element, Joint)]
        guides = [element for element in outer if isinstance(element, Guide)]
        if len(inner) != 1 or not pins or len(pins) + len(guides) != 2:
            continue
        (within,) = inner
        if isinstance(within, Joint):
            centre = path(within)
            lines = [path(pin) - centre for pin in pins]
        elif len(pins) == 2:
            guides = [within]
            lines = [path(pins[1]) - path(pins[0])]
        else:
            continue
        lines += [guide_direction(mechanism, guide, guide.normal, motion) for guide in guides]
        transmission[within.name] = _acute_angle(*lines)
    return transmission


def least_transmission_angle(mechanism: Mechanism, name: str, near: float) -> tuple[float, float]:
    """Return the least transmission angle of a dyad, rad, and the crank angle of it, rad.

    Args:
        mechanism: as of `transmission_angles`.
        name: of the joint or guide inside the dyad.
        near: crank angle of the least one of whole degrees, rad.
    """

    def value(angle: float) -> float:
        return float(transmission_angles(mechanism, np.array([angle]))[name][0])

    bounds = near - NEIGHBOUR, near + NEIGHBOUR
    refined = minimize_scalar(value, bounds=bounds, method="bounded", options={"xatol": 1e-6})
    return min((value(near), near), (float(refined.fun), float(refined.x)))


def _acute_angle(first: Array, second: Array) -> Array:
    """Return the angle, rad, (n,), between two lines of directions (n, 2)."""
    across = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    return np.asarray(np.arctan2(across, np.abs((first * second).sum(axis=1))))


def group_equal_angles(transmission: Mapping[str, Array]) -> list[tuple[str, Array]]:
    """Return (names of joints, transmission angles), equal ones together, the smallest first."""
    groups: list[tuple[list[str], Array]] = []
    for name, values in transmission.items():
        for names, angles in groups:
            if np.allclose(angles, values):
                names.append(name)
                break
        else:
            groups.append(([name], values))
    groups.sort(key=lambda group: float(group[1].min()))
    return [(", ".join(names), angles) for names, angles in groups]
