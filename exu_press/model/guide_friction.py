"""Friction of guides without clearance."""

from collections.abc import Mapping

import numpy as np

from exu_press.joints.guide_friction import GuideFriction, HeldSide, SideForce, SpringSide
from exu_press.mechanism import Guide
from exu_press.model.system import System

__all__ = ["add_guide_friction"]


def add_guide_friction(system: System, guide: Guide, numbers: Mapping[str, int]) -> GuideFriction:
    """Add the friction of a guide without clearance.

    Args:
        system: with the guide in it.
        guide: ideal or elastic.
        numbers: object numbers, as `add_guide` returns them.
    """
    table, mbs = system.scene.guide, system.mbs
    assert table is not None
    offset = np.zeros(3)
    if guide.body in system.flexible:
        from exu_press.model.flexible_body import guided_motion

        body = system.flexible[guide.body]
        values, rows = guided_motion(mbs, body, system.parts[guide.body])
        offset = values - system.ideal[guide.body].position[0]
        nodes = body.nodes
    else:
        nodes, rows = [system.rigid[guide.body].node], np.eye(3)
    side: SideForce
    if guide.lateral is None:
        side = HeldSide(mbs, numbers["force"])
    else:
        normal, spring = np.array(guide.normal), guide.lateral
        relaxed = float(normal @ offset[:2])
        side = SpringSide(spring.stiffness, spring.damping, normal @ rows[:2], relaxed)
    law = table.friction_table(system.scene.friction or {}).friction()
    return GuideFriction(mbs, nodes, np.array(guide.direction) @ rows[:2], side, law)
