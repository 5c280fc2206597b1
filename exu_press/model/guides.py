"""The guides of a system without clearance: constraints or springs, and friction."""

from typing import TYPE_CHECKING

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinates,
    ObjectConnectorCoordinateVector,
    ObjectConnectorDistance,
    ObjectConnectorLinearSpringDamper,
    ObjectGenericODE2,
    VObjectGenericODE2,
)

from exu_press.errors import InputError
from exu_press.mechanism import Guide, Spring
from exu_press.model.constraints import hold_direction
from exu_press.model.system import System
from exu_press.numerics.arrays import Array

if TYPE_CHECKING:
    from exu_press.joints.guide_friction import GuideFriction
    from exu_press.joints.guide_line import TurningLine

__all__ = ["add_guide", "add_guide_friction"]


def add_guide(system: System, guide: Guide) -> None:
    """Hold the displacement along a guide's normal and the angle, by constraints or springs."""
    if guide.is_rail and guide.body in system.flexible:
        _add_flexible_guide(system, guide)
        return
    body, on = system.in_guide(guide)
    holds_across, holds_angle = system.constraints.guides[guide.name]
    if guide.lateral is not None and guide.tilting is not None and not guide.is_rail:
        _add_springs_on_body(system, guide, guide.lateral, guide.tilting)
        return
    if guide.lateral is not None:
        _add_lateral_spring(system, guide, guide.lateral)
    elif holds_across:
        _hold_across(system, guide)
    if guide.tilting is not None:
        system.record(guide.key, "moment", system.spring(body, "angle", guide.tilting))
    elif holds_angle:
        system.record(guide.key, "moment", system.hold(body, "angle", on))


def _add_flexible_guide(system: System, guide: Guide) -> None:
    """Hold the mean motion of a flexible body's faces in a guide.

    Springs are one item with constant matrices; their forces follow from the recorded motion.
    """
    mbs, body = system.mbs, system.flexible[guide.body]
    values, rows = system.parts[guide.body].guided_motion(mbs, body)
    change = values - system.ideal[guide.body].position[0]
    change[2] = np.remainder(change[2] + np.pi, 2.0 * np.pi) - np.pi
    is_held = dict(zip(("force", "moment"), system.constraints.guides[guide.name], strict=True))
    springs = {"force": guide.lateral, "moment": guide.tilting}
    directions = {"force": (*guide.normal, 0.0), "moment": (0.0, 0.0, 1.0)}
    references = [np.array(mbs.GetNodeParameter(n, "referenceCoordinates")) for n in body.nodes]
    stiffness, damping = (np.zeros((rows.shape[1],) * 2) for _ in range(2))
    force = np.zeros(rows.shape[1])
    for quantity, direction in directions.items():
        row, deflection = direction @ rows, float(direction @ change)
        spring = springs[quantity]
        if spring is not None:
            stiffness += spring.stiffness * np.outer(row, row)
            damping += spring.damping * np.outer(row, row)
            force -= spring.stiffness * deflection * row
        elif is_held[quantity]:
            offset = float(row @ np.concatenate(references)) - deflection
            number = _hold_row(system, body.nodes, row, len(references[0]), offset)
            system.record(guide.key, quantity, number)
    if stiffness.any():
        item = ObjectGenericODE2(
            nodeNumbers=body.nodes,
            stiffnessMatrix=stiffness,
            dampingMatrix=damping,
            forceVector=force,
            visualization=VObjectGenericODE2(show=False),
        )
        mbs.AddObject(item)


def _hold_row(system: System, nodes: list[int], row: Array, frame: int, offset: float) -> int:
    """Hold a combination of the coordinates of one or two nodes, the first with `frame` of them."""
    mbs = system.mbs
    ground = [system.ground_node] if len(nodes) == 1 else []
    markers = [mbs.AddMarker(MarkerNodeCoordinates(nodeNumber=node)) for node in (*ground, *nodes)]
    first, second = (
        ([], [row.tolist()]) if ground else ([(-row[:frame]).tolist()], [row[frame:].tolist()])
    )
    constraint = ObjectConnectorCoordinateVector(
        markerNumbers=markers, scalingMarker0=first, scalingMarker1=second, offset=[offset]
    )
    return int(mbs.AddObject(constraint))


def _hold_across(system: System, guide: Guide) -> None:
    """Hold a rigid body along its guide's normal; in the frame linear in the coordinates."""
    if not guide.is_rail:
        (body, on), (_, point) = system.in_guide(guide), system.mechanism.guided_end(guide)
        pin, (line, angle) = system.marker(body, point), system.mechanism.line_of(guide)
        if guide.radius is None:
            hold_direction(system, guide.key, (on, line), angle, pin)
            return
        circle = ObjectConnectorDistance(
            markerNumbers=[system.marker(on, line), pin], distance=guide.radius
        )
        system.record(guide.key, "force", system.mbs.AddObject(circle))
        return
    rigid = system.rigid[guide.body]
    offset = np.dot(system.mechanism.body(guide.body).centre_of_mass, guide.normal)
    by_name = dict(zip(("x", "y", "angle"), (*guide.normal, 0.0), strict=True))
    row = np.array([by_name[coordinate] for coordinate in rigid.coordinates])
    number = _hold_row(system, [rigid.node], row, len(row), float(offset))
    system.record(guide.key, "force", number)


def _add_lateral_spring(system: System, guide: Guide, spring: Spring) -> None:
    """Add a spring along a guide's normal, relaxed in the ideal mechanism's start."""
    start = system.ideal[guide.body].position[0]
    marker = MarkerBodyRigid(bodyNumber=system.ground, localPosition=[start[0], start[1], 0.0])
    connector = ObjectConnectorLinearSpringDamper(
        markerNumbers=[system.mbs.AddMarker(marker), system.marker(guide.body, (0.0, 0.0))],
        stiffness=spring.stiffness,
        damping=spring.damping,
        axisMarker0=[*guide.normal, 0.0],
    )
    number = system.mbs.AddObject(connector)
    system.record(guide.key, "force", number, exu.OutputVariableType.ForceLocal)


def _turning_line(system: System, guide: Guide) -> "TurningLine":
    """Return the line of a guide on a moving body, by the coordinates of both."""
    from exu_press.joints.guide_line import TurningLine  # few scenes have one

    guided, on = (system.rigid[name] for name in system.in_guide(guide))
    return TurningLine(guided.reference, on.reference, *system.mechanism.line_of(guide))


def _add_springs_on_body(system: System, guide: Guide, lateral: Spring, tilting: Spring) -> None:
    """Add the springs of a guide on a moving body; their forces follow from the recorded motion."""
    from exu_press.joints.guide_springs import GuideSprings

    mechanism = system.mechanism
    GuideSprings(
        system.mbs,
        [system.rigid[name].node for name in system.in_guide(guide)],
        _turning_line(system, guide),
        (lateral.stiffness, lateral.damping),
        (tilting.stiffness, tilting.damping),
        mechanism.body(guide.body).angle - mechanism.body(guide.on).angle,
    )


def add_guide_friction(system: System) -> dict[str, "GuideFriction"]:
    """Add the friction of guides without clearance; return it by their names."""
    rubbing = [
        guide
        for guide in system.mechanism.guides
        if guide.name in system.scene.guides
        and system.scene.guides[guide.name].rubs
        and guide.guideway is None
    ]
    for guide in rubbing:
        if guide.key in system.constraints.undetermined:
            path = system.scene.guide_key(guide.name, "friction")
            raise InputError(
                f"{path}: the force of {guide.key}, which decides it, is not determined "
                "beside gears and ideal joints; allowed is friction in a guide with stiffness or "
                "clearance"
            )
    return {
        guide.name: _guide_friction(system, guide)
        for guide in rubbing
        if guide.lateral or (guide.key, "force") in system.forces
    }


def _guide_friction(system: System, guide: Guide) -> "GuideFriction":
    """Add the friction of a guide without clearance, which is in the system."""
    from exu_press.joints.guide_friction import GuideFriction, HeldSide, SideForce, SpringSide
    from exu_press.joints.guide_line import FixedLine, GuideLine

    mbs = system.mbs
    line: GuideLine
    normal = np.array(guide.normal)
    if not guide.is_rail:
        nodes = [system.rigid[name].node for name in system.in_guide(guide)]
        line = _turning_line(system, guide)
    elif guide.body in system.flexible:
        body = system.flexible[guide.body]
        values, rows = system.parts[guide.body].guided_motion(mbs, body)
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
    rubbing = system.scene.guides[guide.name].rubbing
    assert rubbing is not None
    return GuideFriction(mbs, nodes, line, side, rubbing.friction())
