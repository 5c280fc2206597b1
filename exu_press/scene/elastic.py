"""Guides that give way in place of ideal ones (A-9): springs and dampers, or clearance."""

import math
from collections.abc import Mapping
from dataclasses import replace

from exu_press.mechanism import Guide, Guideway, Mechanism, Spring
from exu_press.scene.guide import ElasticGuide, GuidewaySupport

__all__ = ["with_elastic_guides"]


def with_elastic_guides(
    drawn: Mechanism,
    guides: Mapping[str, ElasticGuide],
    solids: Mapping[str, tuple[float, float]] | None = None,
) -> Mechanism:
    """Return a mechanism with the guides that a scene asks for.

    Args:
        drawn: the mechanism.
        guides: name -> guide; one that is not among them, or has no stiffness, stays ideal.
        solids: body -> mass, kg, and inertia, kg m^2, where these are not the drawn ones.
    """
    if not any(guide.soft for guide in guides.values()):
        return drawn
    drawn_ones = {guide.body: drawn.body(guide.body) for guide in drawn.guides}
    inertias = {name: (body.mass, body.inertia) for name, body in drawn_ones.items()}
    inertias |= solids or {}
    return replace(
        drawn,
        guides=tuple(
            _elastic(guide, inertias[guide.body], guides[guide.name])
            if guide.name in guides
            else guide
            for guide in drawn.guides
        ),
    )


def _elastic(guide: Guide, inertia: tuple[float, float], elastic: ElasticGuide) -> Guide:
    """Return a guide of springs, or of guideways with clearance, in place of an ideal one."""
    support = elastic.support
    if support is None:
        return guide
    lateral = support.lateral_stiffness
    if isinstance(support, GuidewaySupport):
        half_width = 0.5 * support.width
        if guide.is_slot:
            pin = Guideway(support.clearance, 0.0, half_width, lateral)
            return replace(guide, guideway=pin)
        guideway = Guideway(support.clearance, support.length, half_width, 0.5 * lateral)
        return replace(guide, guideway=guideway)
    mass, about_centre = inertia
    tilting = support.tilting_stiffness or lateral * support.length**2 / 12
    ratio = support.damping_ratio
    return replace(
        guide,
        lateral=_spring(lateral, support.lateral_damping, ratio, mass),
        tilting=_spring(tilting, support.tilting_damping, ratio, about_centre),
    )


def _spring(stiffness: float, damping: float | None, ratio: float, inertia: float) -> Spring:
    """Return a spring damped as asked for, or with a part of the critical damping."""
    critical = 2.0 * math.sqrt(stiffness * inertia)
    return Spring(stiffness, ratio * critical if damping is None else damping)
