"""The guides of a system: constraints where they are ideal, springs, or ways with play."""

import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinates,
    ObjectConnectorCoordinateVector,
    ObjectConnectorLinearSpringDamper,
)

from exu_press.joints import ClearanceJoint, add_ways_contact
from exu_press.mechanism import Guide, Spring, Ways
from exu_press.model.system import System
from exu_press.scene.laws import ways_contact_law, ways_friction_law

__all__ = ["add_guide", "add_ways"]


def add_ways(system: System, guide: Guide, ways: Ways) -> tuple[ClearanceJoint, ClearanceJoint]:
    """Let both ends of a body touch the ways that it has play between."""
    table = system.scene.guide
    assert table is not None
    body = system.mechanism.body(guide.body)
    along = np.array(guide.direction)
    rigid = system.rigid[guide.body]

    def end(side: float) -> ClearanceJoint:
        drawn = np.array(body.centre_of_mass) + 0.5 * side * ways.length * along
        point = rigid.local(body.local((float(drawn[0]), float(drawn[1]))))
        return add_ways_contact(
            system.mbs,
            (rigid.number, point),
            middle=body.centre_of_mass,
            direction=guide.direction,
            clearance=ways.clearance,
            contact=ways_contact_law(table, ways.end),
            friction=ways_friction_law(table),
            half_width=ways.half_width,
        )

    return end(-1.0), end(1.0)


def add_guide(system: System, guide: Guide) -> dict[str, int]:
    """Hold the displacement across a guide and the angle.

    Returns:
        "force" and "moment", as far as it holds them, -> object number.
    """
    holds_across, holds_angle = system.holding.guides[guide.body]
    added = {}
    if guide.lateral is not None:
        added["force"] = _lateral_spring(system, guide, guide.lateral)
    elif holds_across:
        added["force"] = _hold_across(system, guide)
    if guide.tilting is not None:
        added["moment"] = system.spring(guide.body, "angle", guide.tilting)
    elif holds_angle:
        added["moment"] = system.hold(guide.body, "angle")
    return added


def _hold_across(system: System, guide: Guide) -> int:
    """Hold a body across its guide; linear in the coordinates, and exact."""
    rigid = system.rigid[guide.body]
    offset = np.dot(system.mechanism.body(guide.body).centre_of_mass, guide.across)
    row = dict(zip(("x", "y", "angle"), (*guide.across, 0.0), strict=True))
    held = ObjectConnectorCoordinateVector(
        markerNumbers=[
            system.mbs.AddMarker(MarkerNodeCoordinates(nodeNumber=node))
            for node in (system.ground_node, rigid.node)
        ],
        scalingMarker0=[],
        scalingMarker1=[[row[coordinate] for coordinate in rigid.coordinates]],
        offset=[float(offset)],
    )
    return int(system.mbs.AddObject(held))


def _lateral_spring(system: System, guide: Guide, spring: Spring) -> int:
    """Add a spring across a guide, relaxed where the ideal mechanism starts."""
    start = system.ideal[guide.body].position[0]
    marker = MarkerBodyRigid(bodyNumber=system.ground, localPosition=[start[0], start[1], 0.0])
    held = ObjectConnectorLinearSpringDamper(
        markerNumbers=[system.mbs.AddMarker(marker), system.marker(guide.body, (0.0, 0.0))],
        stiffness=spring.stiffness,
        damping=spring.damping,
        axisMarker0=[*guide.across, 0.0],
    )
    number = int(system.mbs.AddObject(held))
    system.local_forces.add(number)
    return number
