"""Guides on moving bodies, without clearance: their lines, and the springs of elastic ones."""

import math

from exu_press.joints.guide_line import TurningLine
from exu_press.joints.guide_springs import GuideSprings
from exu_press.mechanism import Guide, Spring
from exu_press.model.system import System

__all__ = ["add_springs_on_body", "turning_line"]


def turning_line(system: System, guide: Guide) -> TurningLine:
    """Return the line of a guide on a moving body, by the coordinates of both."""
    mechanism = system.mechanism
    body, base = mechanism.body(guide.body), mechanism.body(guide.on)
    guided, on = (system.rigid[name] for name in system.in_guide(guide))
    return TurningLine(
        guided.reference,
        on.reference,
        base.local(body.centre_of_mass),
        math.atan2(guide.normal[1], guide.normal[0]) - base.angle,
    )


def add_springs_on_body(system: System, guide: Guide, lateral: Spring, tilting: Spring) -> None:
    """Add the springs of a guide on a moving body; their forces follow from the recorded motion."""
    mechanism = system.mechanism
    GuideSprings(
        system.mbs,
        [system.rigid[name].node for name in system.in_guide(guide)],
        turning_line(system, guide),
        (lateral.stiffness, lateral.damping),
        (tilting.stiffness, tilting.damping),
        mechanism.body(guide.body).angle - mechanism.body(guide.on).angle,
    )
