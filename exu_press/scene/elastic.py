"""Guides that give way in place of ideal ones (A-9): springs and dampers, or clearance."""

import math
from collections.abc import Mapping
from dataclasses import replace

from exu_press.mechanism import Guide, Guideway, Mechanism, Spring
from exu_press.scene.guide import ElasticGuide, ElasticSupport, GuidewaySupport

__all__ = ["with_elastic_guides"]


def with_elastic_guides(
    drawn: Mechanism,
    elastic: ElasticGuide | None,
    solids: Mapping[str, tuple[float, float]] | None = None,
) -> Mechanism:
    """Return a mechanism with the guides that a scene asks for.

    Args:
        drawn: the mechanism.
        elastic: [guide] of the scene; without it, or without stiffness, guides stay ideal.
        solids: body -> mass, kg, and inertia, kg m^2, where these are not the drawn ones.
    """
    if elastic is None or elastic.support is None:
        return drawn
    drawn_ones = {guide.body: drawn.body(guide.body) for guide in drawn.guides}
    inertias = {name: (body.mass, body.inertia) for name, body in drawn_ones.items()}
    inertias |= solids or {}
    guides = (_elastic(guide, inertias[guide.body], elastic.support) for guide in drawn.guides)
    return replace(drawn, guides=tuple(guides))


def _elastic(
    guide: Guide, inertia: tuple[float, float], support: ElasticSupport | GuidewaySupport
) -> Guide:
    """Return a guide of springs, or of guideways with clearance, in place of an ideal one."""
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
