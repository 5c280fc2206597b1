"""The guides of a system without clearance: constraints where they are ideal, or springs."""

import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinates,
    ObjectConnectorCoordinateVector,
    ObjectConnectorLinearSpringDamper,
    ObjectGenericODE2,
    VObjectGenericODE2,
)

from exu_press.mechanism import Guide, Spring
from exu_press.model.system import System
from exu_press.numerics.arrays import Array

__all__ = ["add_guide"]


def add_guide(system: System, guide: Guide) -> dict[str, int]:
    """Hold the displacement across a guide and the angle.

    Returns:
        "force" and "moment", as far as it holds them, -> object number.
    """
    if guide.body in system.flexible:
        return _add_flexible_guide(system, guide)
    holds_across, holds_angle = system.constraints.guides[guide.body]
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


def _add_flexible_guide(system: System, guide: Guide) -> dict[str, int]:
    """Do the same to the mean motion of the faces of a flexible body that lie in the guide.

    Springs are one item with constant matrices, whose forces follow from the motion.
    """
    from exu_press.model.flexible_body import guided_motion

    mbs, body = system.mbs, system.flexible[guide.body]
    values, rows = guided_motion(mbs, body, system.parts[guide.body])
    away = values - system.ideal[guide.body].position[0]
    away[2] = np.remainder(away[2] + np.pi, 2.0 * np.pi) - np.pi
    held = dict(zip(("force", "moment"), system.constraints.guides[guide.body], strict=True))
    springs = {"force": guide.lateral, "moment": guide.tilting}
    directions = {"force": (*guide.normal, 0.0), "moment": (0.0, 0.0, 1.0)}
    nodes = [body.node_rigid, *([] if body.node_modes is None else [body.node_modes])]
    references = [np.array(mbs.GetNodeParameter(n, "referenceCoordinates")) for n in nodes]
    added = {}
    stiffness, damping = (np.zeros((rows.shape[1],) * 2) for _ in range(2))
    force = np.zeros(rows.shape[1])
    for quantity, direction in directions.items():
        row, missed = direction @ rows, float(direction @ away)
        spring = springs[quantity]
        if spring is not None:
            stiffness += spring.stiffness * np.outer(row, row)
            damping += spring.damping * np.outer(row, row)
            force -= spring.stiffness * missed * row
        elif held[quantity]:
            offset = float(row @ np.concatenate(references)) - missed
            added[quantity] = _hold_row(system, nodes, row, len(references[0]), offset)
    if stiffness.any():
        item = ObjectGenericODE2(
            nodeNumbers=nodes,
            stiffnessMatrix=stiffness,
            dampingMatrix=damping,
            forceVector=force,
            visualization=VObjectGenericODE2(show=False),
        )
        mbs.AddObject(item)
    return added


def _hold_row(system: System, nodes: list[int], row: Array, frame: int, offset: float) -> int:
    """Hold a combination of one or two nodes' coordinates, `frame` of them the first one's."""
    mbs = system.mbs
    ground = [system.ground_node] if len(nodes) == 1 else []
    markers = [mbs.AddMarker(MarkerNodeCoordinates(nodeNumber=node)) for node in (*ground, *nodes)]
    first, second = (
        ([], [row.tolist()]) if ground else ([(-row[:frame]).tolist()], [row[frame:].tolist()])
    )
    held = ObjectConnectorCoordinateVector(
        markerNumbers=markers, scalingMarker0=first, scalingMarker1=second, offset=[offset]
    )
    return int(mbs.AddObject(held))


def _hold_across(system: System, guide: Guide) -> int:
    """Hold a body across its guide; linear in the coordinates, and exact."""
    rigid = system.rigid[guide.body]
    offset = np.dot(system.mechanism.body(guide.body).centre_of_mass, guide.normal)
    by_name = dict(zip(("x", "y", "angle"), (*guide.normal, 0.0), strict=True))
    row = np.array([by_name[coordinate] for coordinate in rigid.coordinates])
    return _hold_row(system, [rigid.node], row, len(row), float(offset))


def _lateral_spring(system: System, guide: Guide, spring: Spring) -> int:
    """Add a spring across a guide, relaxed where the ideal mechanism starts."""
    start = system.ideal[guide.body].position[0]
    marker = MarkerBodyRigid(bodyNumber=system.ground, localPosition=[start[0], start[1], 0.0])
    held = ObjectConnectorLinearSpringDamper(
        markerNumbers=[system.mbs.AddMarker(marker), system.marker(guide.body, (0.0, 0.0))],
        stiffness=spring.stiffness,
        damping=spring.damping,
        axisMarker0=[*guide.normal, 0.0],
    )
    number = int(system.mbs.AddObject(held))
    system.local_forces.add(number)
    return number
