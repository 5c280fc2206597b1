"""The bodies of a system, rigid or flexible, in their initial position and velocity."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from exudyn.itemInterface import LoadForceVector

from exu_press.mechanism import Body, Motion
from exu_press.model.rigid_body import PivotedBody, RigidBody, SlidingBody
from exu_press.model.system import System

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart

__all__ = ["add_bodies"]


def add_bodies(
    system: System, start: Mapping[str, Motion], frames: Mapping[str, "FrameStart"]
) -> None:
    """Add every body, with its weight.

    Args:
        system: with nothing but the frame in it.
        start: name -> motion at the start.
        frames: name -> start of the frame of a flexible body that starts deformed.
    """
    gravity = system.scene.gravity
    for body in system.mechanism.bodies:
        if body.name in system.parts:
            _add_flexible_body(system, body.name, start[body.name], frames.get(body.name))
            continue
        _add_rigid_body(system, body, start[body.name])
        if gravity > 0.0:
            weight = [0.0, -body.mass * gravity, 0.0]
            centre = system.marker(body.name, (0.0, 0.0))
            system.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))


def _add_rigid_body(system: System, body: Body, start: Motion) -> None:
    """Add a rigid body with the coordinates that its ideal joints leave it."""
    pivot = system.constraints.pivots.get(body.name)
    relaxed = system.ideal[body.name].position[0]
    if pivot is not None:
        point = body.local(pivot.at)
        added: RigidBody = PivotedBody(system.mbs, body, start, pivot.at, point, relaxed)
    elif body.name in system.constraints.sliding_bodies:
        guide = system.mechanism.frame_guide(body.name)
        assert guide is not None
        added = SlidingBody(system.mbs, body, start, guide.direction, relaxed)
    else:
        guide = system.mechanism.frame_guide(body.name)
        if guide is not None and system.constraints.guides[guide.name][1]:
            start = _upright(start, float(relaxed[2]))
        added = RigidBody(system.mbs, body, start, relaxed)
    system.add_rigid(body.name, added)


def _upright(start: Motion, angle: float) -> Motion:
    """Return the start of a body whose angle a guide holds.

    In the ideal start balls may hold it instead, which move with flexible bodies.
    """
    position, velocity = start.position.copy(), start.velocity.copy()
    position[:, 2], velocity[:, 2] = angle, 0.0
    return replace(start, position=position, velocity=velocity)


def _add_flexible_body(
    system: System, name: str, start: Motion, deformed: "FrameStart | None"
) -> None:
    """Add a flexible body; its frame is the solid's, not in the centre of mass."""
    from exu_press.model.flexible_body import add_part, fit_to_guide, undeformed_start

    placed, ideal = system.parts[name], system.ideal[name].position[0]
    frame = deformed or undeformed_start(placed.frame_motion(start))
    guide = system.mechanism.frame_guide(name)
    if guide is not None:
        holds = system.constraints.guides[guide.name]
        frame = fit_to_guide(frame, placed, guide, holds, ideal)
    system.flexible[name] = body = add_part(system, name, frame)
    system.bodies[name], system.nodes[name] = body.object_number, body.node_rigid
    if body.node_modes is not None:
        system.nodes[f"{name}_modes"] = body.node_modes
