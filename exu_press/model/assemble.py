"""Assembly of a scene's model, with its sensors."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import LoadForceVector, SensorNode

from exu_press.integrate.modal_mass import follow_modes
from exu_press.joints.joint import ClearanceJoint, States
from exu_press.mechanism import Body, Motion
from exu_press.model.constraints import add_drive, add_gear, add_ideal_joint, crank_angle_of
from exu_press.model.guides import add_guide, add_guide_friction
from exu_press.model.model import Model, count_items
from exu_press.model.rigid_body import PivotedBody, RigidBody, SlidingBody
from exu_press.model.system import System
from exu_press.scene import IdealJoint, Scene
from exu_press.scene.holding_torque import holding_torque
from exu_press.scene.joint import oil_of
from exu_press.schema.table import plain

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart
    from exu_press.model.loads import ActingLoad
    from exu_press.model.placed_part import PlacedPart
    from exu_press.model.stall import Stall
    from exu_press.model.start_stop import StartStop
    from exu_press.model.warm_film import WarmFilm

__all__ = ["build"]


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
        from exu_press.model.placed_part import placed_parts

        parts = placed_parts(scene, quiet=quiet)
    start: dict[str, Motion] = {}
    frames: dict[str, FrameStart] = {}
    if any(placed.reduced.mode_count for placed in parts.values()):
        from exu_press.model.start import deformed_start

        ideal = System(_ideal_scene(scene), parts)
        _assemble(ideal, {}, {})
        start, frames = deformed_start(ideal, scene.start_speed)
    system = System(scene, parts)
    if scene.start == "loaded" and scene.joints.with_clearance:
        from exu_press.model.loaded_start import moved_start

        start, frames = moved_start(system, start, frames)
    return _assemble(system, start, frames)


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
    system: System, start: Mapping[str, Motion], frames: Mapping[str, "FrameStart"]
) -> Model:
    """Add the items of a system's scene, and return its assembled model."""
    mechanism, constraints, joints = system.mechanism, system.constraints, system.scene.joints
    _add_bodies(system, {**system.ideal, **start}, frames)
    clearance = _clearance_joints(system) if joints.with_clearance else {}
    for joint in mechanism.joints:
        if joint.name in {*constraints.joints, *constraints.single_axis}:
            add_ideal_joint(system, joint)
    if system.flexible:
        from exu_press.model.flexible_support import hold_flexible_bodies

        hold_flexible_bodies(system, start)
    for guide in mechanism.guides:
        if guide.name in constraints.guides:
            add_guide(system, guide)
    for gear in mechanism.gears:
        if gear.name in constraints.gears:
            add_gear(system, gear)
    if mechanism.springs:
        from exu_press.model.springs import add_spring

        for spring in mechanism.springs:
            add_spring(system, spring)
    guideways = _guideways(system) if any(guide.guideway for guide in mechanism.guides) else {}
    friction = add_guide_friction(system) if system.scene.guides else {}
    crank_angle = crank_angle_of(system)
    start_stop: StartStop | None = None
    stall: Stall | None = None
    motor = system.scene.drive
    if motor is not None:
        from exu_press.model.stall import stall_of

        stall = stall_of(motor, system.scene.speed_rpm)
    if motor is not None and motor.clutch is not None:
        from exu_press.model.start_stop import add_flywheel, add_start_stop

        add_flywheel(system)
        start_stop = add_start_stop(system, crank_angle)
    add_drive(system)
    loads: dict[str, ActingLoad] = {}
    if system.loads:
        from exu_press.model.loads import add_loads

        loads = add_loads(system)
    if system.flexible:
        follow_modes(system.mbs)
    _record_bodies(system)
    system.mbs.Assemble()
    if start_stop is not None:
        begin = np.array([system.scene.start_angle])
        start_stop.begin(float(holding_torque(mechanism, system.scene, {}, begin)[0]))
    return Model(
        scene=system.scene,
        mechanism=mechanism,
        constraints=constraints,
        SC=system.SC,
        mbs=system.mbs,
        bodies=system.bodies,
        nodes=system.nodes,
        rigid=system.rigid,
        clearance_joints=clearance,
        drive=system.forces["drive", "force"],
        crank_angle=crank_angle,
        start_stop=start_stop,
        loads=loads,
        clocks=system.clocks,
        ahead=system.ahead,
        guideways=guideways,
        guide_friction=friction,
        sensors=system.sensors,
        parts=system.parts,
        warm=_warm_films(system, clearance),
        states=_states(system.scene, clearance, guideways),
        stall=stall,
        scene_items=count_items(system.mbs),
    )


def _add_bodies(
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


def _clearance_joints(system: System) -> dict[str, ClearanceJoint]:
    """Add the joints with clearance; return them by their names."""
    from exu_press.model.clearance_joints import add_clearance_joint

    return {
        joint.name: add_clearance_joint(system, joint, kind)
        for joint in system.mechanism.joints
        if not isinstance(kind := system.scene.joints[joint.name], IdealJoint)
    }


def _guideways(system: System) -> dict[str, tuple[ClearanceJoint, ...]]:
    """Add the guideways with clearance; return the contacts of a body's two ends and its film."""
    from exu_press.model.guideways import add_guideways

    return {
        guide.name: add_guideways(system, guide, guide.guideway)
        for guide in system.mechanism.guides
        if guide.guideway
    }


def _warm_films(
    system: System, clearance: Mapping[str, ClearanceJoint]
) -> Mapping[str, "WarmFilm"]:
    """Return the films whose oil warms."""
    joints = system.scene.joints
    if not any(oil_of(joints[name]) for name in clearance):
        return {}
    from exu_press.model.warm_film import warm_films

    return warm_films(clearance, joints)


def _states(
    scene: Scene,
    clearance: Mapping[str, ClearanceJoint],
    guideways: Mapping[str, tuple[ClearanceJoint, ...]],
) -> States:
    """Return the recorder of the joints' states, and of the friction work of those that wear."""
    wearing = [clearance[name] for name in scene.wearing["joints"]]
    wearing += [end for name in scene.wearing["guides"] for end in guideways[name]]
    ends = [end for contacts in guideways.values() for end in contacts]
    return States([*clearance.values(), *ends], wearing)


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
