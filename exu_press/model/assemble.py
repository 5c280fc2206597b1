"""Assembly of a scene's model, with its sensors."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import LoadForceVector, SensorNode

from exu_press.errors import error_prefix
from exu_press.integrate.modal_mass import follow_modes
from exu_press.joints.joint import States
from exu_press.mechanism import Body, Motion
from exu_press.model.constraints import add_drive, add_gear, add_ideal_joint, crank_angle_of
from exu_press.model.guides import add_guide, add_guide_friction
from exu_press.model.model import Model, count_items
from exu_press.model.rigid_body import PivotedBody, RigidBody, SlidingBody
from exu_press.model.system import System
from exu_press.scene import IdealJoint, Scene
from exu_press.scene.holding_torque import holding_torque
from exu_press.schema.table import plain
from exu_press.terminal.interrupt import unmasked_interrupt

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart
    from exu_press.model.placed_part import PlacedPart

__all__ = ["build"]


@unmasked_interrupt()
def build(scene: Scene, *, quiet: bool = True) -> Model:
    """Return the assembled Exudyn model of a scene, in the ideal mechanism's start.

    Flexible bodies start in the deformation, and its rate, of the quasi-static motion.

    Args:
        scene: of the model.
        quiet: False shows the progress of the flexible bodies' reduction, which takes long.
    """
    scene.require_code()
    parts: Mapping[str, PlacedPart] = {}
    if scene.bodies:
        from exu_press.model.placement import placed_parts

        parts = placed_parts(scene, quiet=quiet)
    with error_prefix(scene.origin):  # the parts have it
        return _model_at_start(scene, parts)


def _model_at_start(scene: Scene, parts: "Mapping[str, PlacedPart]") -> Model:
    """Return the assembled model of a scene with flexible bodies, in its start."""
    start: dict[str, Motion] = {}
    frames: dict[str, FrameStart] = {}
    if any(placed.reduced.mode_count for placed in parts.values()):
        from exu_press.model.start import deformed_start

        ideal = Model(_ideal_scene(scene), parts)
        _assemble(ideal, {}, {})
        start, frames = deformed_start(ideal, scene.start_speed)
    model = Model(scene, parts)
    if scene.start == "loaded" and scene.joints.with_clearance:
        from exu_press.model.loaded_start import moved_start

        start, frames = moved_start(model, start, frames)
    _assemble(model, start, frames)
    return model


def _ideal_scene(scene: Scene) -> Scene:
    """Return a scene with ideal joints at constant speed, without loads and without guide friction.

    Clearance and friction leave a body in its guide no determined position.
    """
    changes: dict[str, Any] = {f"joints.{name}": "ideal" for name in scene.joints.with_clearance}
    elastic = {
        name: {**plain(guide.support), "friction": "none"}
        for name, guide in scene.guides.items()
        if guide.support is not None and guide.clearance is None
    }
    return scene.replace(changes | {"drive": None, "load": {}, "guide": elastic or None})


def _assemble(
    model: Model, start: Mapping[str, Motion], frames: Mapping[str, "FrameStart"]
) -> None:
    """Add all items of a model's scene, and assemble them."""
    mechanism, constraints, scene = model.mechanism, model.constraints, model.scene
    _add_bodies(model, {**model.ideal, **start}, frames)
    if scene.joints.with_clearance:
        _add_clearance_joints(model)
    for joint in mechanism.joints:
        if joint.name in {*constraints.joints, *constraints.single_axis}:
            add_ideal_joint(model, joint)
    if model.flexible:
        from exu_press.model.flexible_support import hold_flexible_bodies

        hold_flexible_bodies(model, start)
    for guide in mechanism.guides:
        if guide.name in constraints.guides:
            add_guide(model, guide)
    for gear in mechanism.gears:
        if gear.name in constraints.gears:
            add_gear(model, gear)
    if mechanism.springs:
        from exu_press.model.springs import add_spring

        for spring in mechanism.springs:
            add_spring(model, spring)
    if any(guide.guideway for guide in mechanism.guides):
        from exu_press.model.guideways import add_guideways

        model.guideways = {
            guide.name: add_guideways(model, guide, guide.guideway)
            for guide in mechanism.guides
            if guide.guideway
        }
    if scene.guides:
        model.guide_friction = add_guide_friction(model)
    model.crank_angle = crank_angle_of(model)
    motor = scene.drive
    if motor is not None:
        from exu_press.model.stall import stall_of

        model.stall = stall_of(motor, scene.speed_rpm)
    if motor is not None and motor.clutch is not None:
        from exu_press.model.start_stop import add_flywheel, add_start_stop

        add_flywheel(model)
        model.start_stop = add_start_stop(model, model.crank_angle)
    add_drive(model)
    if model.applied_loads:
        from exu_press.model.loads import add_loads

        model.loads = add_loads(model)
    if model.flexible:
        follow_modes(model.mbs)
    _record_bodies(model)
    model.mbs.Assemble()
    model.scene_items = count_items(model.mbs)
    if model.start_stop is not None:
        begin = np.array([scene.start_angle])
        model.start_stop.begin(float(holding_torque(mechanism, scene, {}, begin)[0]))
    if scene.warms:
        from exu_press.model.warm_film import warm_films

        model.warm = warm_films(model.clearance_joints, scene.joints)
    model.states = _states(model)


def _add_bodies(
    system: System, start: Mapping[str, Motion], frames: Mapping[str, "FrameStart"]
) -> None:
    """Add every body, with its weight; frames are those of flexible bodies that start deformed."""
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


def _add_clearance_joints(system: System) -> None:
    """Add the joints with clearance."""
    from exu_press.model.clearance_joints import add_clearance_joint

    for joint in system.mechanism.joints:
        kind = system.scene.joints[joint.name]
        if not isinstance(kind, IdealJoint):
            system.clearance_joints[joint.name] = add_clearance_joint(system, joint, kind)


def _states(system: System) -> States:
    """Return the recorder of the joints' states, and of the friction work of those that wear."""
    wearing, ways = system.scene.wearing, system.guideways
    rubbing = [system.clearance_joints[name] for name in wearing["joints"]]
    rubbing += [end for name in wearing["guides"] for end in ways[name]]
    ends = [end for contacts in ways.values() for end in contacts]
    return States([*system.clearance_joints.values(), *ends], rubbing)


def _record_bodies(system: System) -> None:
    """Record the coordinates of all bodies, their rates and accelerations."""
    levels = {
        "position": exu.OutputVariableType.Coordinates,
        "velocity": exu.OutputVariableType.Coordinates_t,
        "acceleration": exu.OutputVariableType.Coordinates_tt,
    }
    for name, node in system.nodes.items():
        for level, output in levels.items():
            sensor = SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=output)
            system.sensors[name, level] = system.mbs.AddSensor(sensor)
