"""Guides of the sliding bodies: ideal, or elastic as a scene's [guide] asks for (A-9)."""

import math
from dataclasses import replace

from exu_press.mechanism.description import Body, Guide, Spring
from exu_press.scene.tables import ElasticGuide

__all__ = ["free_to_tilt", "guide_of"]

STEEL = 7850.0
"""kg/m^3, for the size of a body whose shape the paper does not give."""


def free_to_tilt(body: Body, elastic: ElasticGuide | None) -> Body:
    """Return a body with the inertia that it needs where its guide lets it tilt.

    Args:
        body: "slider", "slide" or "counterweight".
        elastic: has that body's inertia, or a steel cube's is taken; None for an ideal guide,
            where the inertia does not matter.
    """
    if elastic is None:
        return body
    given: float | None = getattr(elastic, f"{body.name}_inertia")
    cube = body.mass * (body.mass / STEEL) ** (2 / 3) / 6
    return replace(body, inertia=cube if given is None else given)


def guide_of(body: Body, elastic: ElasticGuide | None, *, holds_angle: bool = True) -> Guide:
    """Return the guide of a body.

    Args:
        body: with the inertia that it has.
        elastic: None for an ideal guide.
        holds_angle: whether an ideal guide does; an elastic one always does.
    """
    if elastic is None:
        return Guide(body.name, holds_angle)
    lateral = elastic.lateral_stiffness
    tilting = elastic.tilting_stiffness or lateral * elastic.length**2 / 12
    ratio = elastic.damping_ratio
    return Guide(
        body.name,
        lateral=_spring(lateral, elastic.lateral_damping, ratio, body.mass),
        tilting=_spring(tilting, elastic.tilting_damping, ratio, body.inertia),
    )


def _spring(stiffness: float, damping: float | None, ratio: float, inertia: float) -> Spring:
    """Return a spring damped as asked for, or with a share of the critical damping."""
    critical = 2.0 * math.sqrt(stiffness * inertia)
    return Spring(stiffness, ratio * critical if damping is None else damping)
