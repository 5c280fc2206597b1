"""Transmission angles of a mechanism's dyads over the crank angle.

A dyad is a group of two bodies: two links (RRR), or a link and a body on a guide
(RRP). The transmission angle of the former is the acute angle between the two links, that of the
latter the acute angle between the link and the normal of the guide [1]_. A link drives its body
best at 90 deg; at 0 deg the dyad locks. Textbooks recommend 40 to 50 deg at least.

References
----------
.. [1] J. J. Uicker, G. R. Pennock, J. E. Shigley, Theory of Machines and Mechanisms, 5th ed.,
   Oxford University Press 2017, sections 1.10 and 3.18.
"""

from collections.abc import Mapping

import numpy as np

from exu_press.mechanism.groups import groups_of
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Joint
from exu_press.numerics.arrays import Array

__all__ = ["group_equal_angles", "transmission_angles"]


def transmission_angles(mechanism: Mechanism, angle: Array) -> dict[str, Array]:
    """Return transmission angles (n,), rad, by the name of the joint inside each dyad.

    Groups of more than two bodies have none.

    Args:
        mechanism: with one degree of freedom.
        angle: (n,) crank angles from the drawing's, rad.

    Raises:
        InputError: the crank does not turn through a revolution.
    """
    motion = mechanism.motion(angle, 1.0)
    guides = {guide.body: guide for guide in mechanism.guides}

    def path(joint: Joint) -> Array:
        (body, point), _ = sorted(mechanism.ends(joint), key=lambda end: end[0] == GROUND)
        return motion[body].point_motion(point).position[:, :2]

    transmission: dict[str, Array] = {}
    for group in groups_of(mechanism.constraints, mechanism.crank):
        dyad = group.bodies
        if len(dyad) != 2:
            continue
        joints = {body: mechanism.joints_of(body) for body in dyad}
        inner = [joint for joint in joints[dyad[0]] if joint in joints[dyad[1]]]
        outer = [
            [j for j in joints[body] if {j.journal, j.bearing} & group.predecessors]
            for body in dyad
            if body not in guides
        ]
        if len(inner) != 1 or not outer or any(len(ends) != 1 for ends in outer):
            continue
        centre = path(inner[0])
        lines = [path(ends[0]) - centre for ends in outer]
        if len(lines) == 1:
            guided = next(body for body in dyad if body in guides)
            lines.append(np.broadcast_to(np.array(guides[guided].normal), centre.shape))
        across = np.abs(lines[0][:, 0] * lines[1][:, 1] - lines[0][:, 1] * lines[1][:, 0])
        along = np.abs((lines[0] * lines[1]).sum(axis=1))
        transmission[inner[0].name] = np.arctan2(across, along)
    return transmission


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
