"""Elastic guides in place of ideal ones (A-9)."""

import math
from dataclasses import replace

from exu_press.mechanism import Body, Guide, Mechanism, Spring, Ways
from exu_press.scene.tables import ElasticGuide

__all__ = ["with_elastic_guides"]


def with_elastic_guides(drawn: Mechanism, elastic: ElasticGuide) -> Mechanism:
    """Return a mechanism whose guides are springs and dampers, its guided bodies free to tilt."""
    guides = tuple(_elastic(guide, drawn.body(guide.body), elastic) for guide in drawn.guides)
    return replace(drawn, guides=guides)


def _elastic(guide: Guide, body: Body, elastic: ElasticGuide) -> Guide:
    """Return a guide of springs, or of ways with play, in place of an ideal one (A-9)."""
    lateral = elastic.lateral_stiffness
    if elastic.clearance is not None:
        whole = _spring(lateral, elastic.lateral_damping, elastic.damping_ratio, body.mass)
        end = Spring(0.5 * whole.stiffness, 0.5 * whole.damping)
        ways = Ways(elastic.clearance, elastic.length, 0.5 * elastic.width, end)
        return replace(guide, ways=ways)
    tilting = elastic.tilting_stiffness or lateral * elastic.length**2 / 12
    ratio = elastic.damping_ratio
    return replace(
        guide,
        lateral=_spring(lateral, elastic.lateral_damping, ratio, body.mass),
        tilting=_spring(tilting, elastic.tilting_damping, ratio, body.inertia),
    )


def _spring(stiffness: float, damping: float | None, ratio: float, inertia: float) -> Spring:
    """Return a spring damped as asked for, or with a part of the critical damping."""
    critical = 2.0 * math.sqrt(stiffness * inertia)
    return Spring(stiffness, ratio * critical if damping is None else damping)
