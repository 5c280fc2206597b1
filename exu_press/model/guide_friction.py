"""Friction of guides without clearance."""

import numpy as np

from exu_press.joints.guide_friction import GuideFriction, HeldSide, SideForce, SpringSide
from exu_press.joints.guide_line import FixedLine, GuideLine
from exu_press.mechanism import Guide
from exu_press.model.guides import turning_line
from exu_press.model.system import System

__all__ = ["add_guide_friction"]


def add_guide_friction(system: System, guide: Guide) -> GuideFriction:
    """Add the friction of a guide without clearance, which is in the system."""
    mbs = system.mbs
    line: GuideLine
    normal = np.array(guide.normal)
    if not guide.is_rail:
        nodes = [system.rigid[name].node for name in system.in_guide(guide)]
        line = turning_line(system, guide)
    elif guide.body in system.flexible:
        from exu_press.model.flexible_body import guided_motion

        body = system.flexible[guide.body]
        values, rows = guided_motion(system, guide.body)
        missed = float(normal @ (values - system.ideal[guide.body].position[0])[:2])
        nodes = body.nodes
        line = FixedLine(np.array(guide.direction) @ rows[:2], normal @ rows[:2], missed)
    else:
        nodes = [system.rigid[guide.body].node]
        line = FixedLine(np.array([*guide.direction, 0.0]), np.array([*normal, 0.0]))
    side: SideForce
    if guide.lateral is None:
        side = HeldSide(mbs, system.forces[guide.key, "force"])
    else:
        side = SpringSide(guide.lateral.stiffness, guide.lateral.damping, line)
    law = system.scene.guides[guide.name].friction_table(system.scene.friction or {}).friction()
    return GuideFriction(mbs, nodes, line, side, law)
