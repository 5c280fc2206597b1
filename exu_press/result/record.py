"""The channels of a result from a model's sensors."""

import functools
import importlib.metadata
import platform
from collections.abc import Mapping

import numpy as np

from exu_press.integrate import Outcome
from exu_press.mechanism import Motion
from exu_press.mechanism.parts import DRIVE
from exu_press.model import Model
from exu_press.model.state import state_of
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, positive
from exu_press.result.declared import channel
from exu_press.result.energy import mechanical_energy, work
from exu_press.result.equilibrium import equilibrium
from exu_press.result.flexible import record_parts
from exu_press.result.forces import frame_force, held_forces, shaking_forces
from exu_press.result.guides import record_friction, record_guides, record_guideways
from exu_press.result.info import Info, Stress
from exu_press.result.joints import joint_states, record_joints
from exu_press.result.loads import record_loads
from exu_press.result.motion import body_motion, sensor
from exu_press.result.result import Result
from exu_press.result.start_stop import record_start_stop
from exu_press.result.stress import record_stress
from exu_press.result.surface import surfaces_of

__all__ = ["record"]

AT_ONCE = 2048
"""Instants."""


def record(model: Model, outcome: Outcome) -> Result:
    """Return the result of an integrated model."""
    scene, mechanism = model.scene, model.mechanism
    time = sensor(model, mechanism.slider, "position", with_time=True)[:, 0]
    motions = {body.name: body_motion(model, body.name) for body in mechanism.bodies}
    slider, crank = motions[mechanism.slider], motions[mechanism.crank]
    turned = body_motion(model, DRIVE) if DRIVE in model.nodes else crank
    drawn = mechanism.body(mechanism.crank).angle
    up, beside = positive(mechanism.output.direction), positive(mechanism.output.across)
    channels: dict[str, Channel] = {}
    for quantity, values, way in (
        ("time", time, ""),
        ("crank_angle", crank.position[:, 2] - drawn, ""),
        ("crank_speed", turned.velocity[:, 2], ""),
        ("slider_position", mechanism.travel(slider.position), up),
        ("slider_velocity", mechanism.along(slider.velocity), up),
        ("slider_acceleration", mechanism.along(slider.acceleration), up),
        ("slider_lateral", mechanism.beside(slider.position), beside),
        ("slider_tilt", slider.position[:, 2] - mechanism.body(mechanism.slider).angle, ""),
    ):
        channels |= channel(quantity, values, way=way)
    states = joint_states(model, time)
    in_joints, stored_in_joints, lost_in_joints = record_joints(model, states, time)
    channels |= held_forces(model, motions)
    angle = scene.start_angle + scene.angular_speed * time + model.ahead[0]
    if scene.drive is not None:
        angle = turned.position[:, 2] - drawn
    slider_motion = channels["slider_position"].values, channels["slider_velocity"].values
    loads, work_of_loads = record_loads(
        model, time, (angle, turned.velocity[:, 2]), slider_motion, motions
    )
    channels |= loads
    in_guideways, stored_in_guideways, lost_in_guideways = record_guideways(model, time, motions)
    channels |= in_guideways
    channels |= equilibrium(model, motions, channels | in_joints, states)
    in_guides, stored_in_guides, lost_in_guides = record_guides(model, time, motions)
    channels |= in_guides
    rubbed, lost_by_friction = record_friction(model, time, motions, channels)
    channels |= rubbed
    channels |= frame_force(model, channels | in_joints)
    channels |= shaking_forces(model, motions)
    rigid = [body for body in mechanism.bodies if body.name not in model.parts]
    stored = mechanical_energy(rigid, motions, scene.gravity)
    flywheel = 0.0 if scene.drive is None else scene.drive.on_crank
    if DRIVE in model.nodes:  # its flywheel is on no body
        stored += 0.5 * flywheel * turned.velocity[:, 2] ** 2
    dissipated = np.zeros_like(time)
    for more, kept, lost in (
        ({}, stored_in_guides, lost_in_guides),
        record_parts(model, time),
        (in_guideways, stored_in_guideways, lost_in_guideways),
        (in_joints, stored_in_joints, lost_in_joints),
    ):
        channels |= more
        stored += kept
        dissipated += lost
    dissipated += lost_by_friction
    stressed, worst = record_stress(model, time)
    channels |= stressed
    torque, speed = channels["drive_torque"].values, turned.velocity[:, 2]
    on_crank = torque - flywheel * turned.acceleration[:, 2]
    if model.start_stop is not None:
        more, kept, lost = record_start_stop(model, time, speed)
        channels |= more
        stored += kept
        dissipated += lost
        on_crank = more["clutch_torque"].values
        speed = more["flywheel_speed"].values
    driven = work(time, torque, speed) + work_of_loads
    channels |= channel("drive_power", torque * speed)
    channels |= channel("crank_torque", on_crank)
    channels |= channel("body_position", _poses(motions))
    if not model.own_items:  # their energies are not known
        channels |= channel("energy_input", driven)
        channels |= channel("energy_stored", stored - stored[0])
        channels |= channel("energy_dissipated", dissipated)
    return Result(
        scene=scene,
        channels=channels,
        info=_info(model, outcome, worst),
        bodies=tuple(motions),
        surfaces=surfaces_of(model.parts),
    )


def _poses(motions: Mapping[str, Motion]) -> Array:
    """Return the poses of bodies, (n, bodies, 3), part by part: each stays near the processor."""
    positions = [motion.position for motion in motions.values()]
    found = np.empty((len(positions[0]), len(positions), 3))
    for first in range(0, len(found), AT_ONCE):
        part = slice(first, first + AT_ONCE)
        for index, position in enumerate(positions):
            found[part, index] = position[part]
    return found


def _info(model: Model, outcome: Outcome, worst: dict[str, Stress]) -> Info:
    """Return status, statistics, sizes and versions."""
    mbs = model.mbs
    info: Info = {
        "status": outcome.status.value,
        "reason": outcome.reason,
        "end_time": outcome.end_time,
        "wall_time": outcome.wall_time,
        "steps": outcome.steps,
        "rejected_steps": outcome.rejected_steps,
        "newton_iterations": outcome.newton_iterations,
        "law_evaluations": outcome.law_evaluations,
        "own_items": model.own_items,
        "coordinates": mbs.systemData.ODE2Size(),
        "bodies": len(model.nodes),
        "connectors": mbs.systemData.NumberOfObjects() - len(model.nodes) - 1,
        "versions": dict(_versions()),
        "state": state_of(model),
    }
    if model.parts:
        info["stress"] = worst
        info["solids"] = {
            name: {
                "mass": part.reduced.mass,
                "centre_of_mass": [*part.centre_of_mass],
                "inertia": part.inertia,
                "modes": part.reduced.mode_count,
                "frequencies": part.reduced.fixed_interface_frequencies.tolist(),
            }
            for name, part in model.parts.items()
        }
    return info


@functools.cache
def _versions() -> Mapping[str, str]:
    """Return the versions behind a result; looking them up takes a tenth of a short run."""
    packages = ("exu-press", "exudyn", "numpy", "scipy")
    found = {name: importlib.metadata.version(name) for name in packages}
    return {"python": platform.python_version(), **found}
