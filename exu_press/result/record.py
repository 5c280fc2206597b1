"""From a model's sensors to the channels of a result."""

import importlib.metadata
import platform
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.integrate import Outcome
from exu_press.joints import history, overlay_of
from exu_press.model import Model
from exu_press.result.energy import mechanical_energy, work
from exu_press.result.flexible import record_parts, worst_stress
from exu_press.result.motion import body_motion, sensor
from exu_press.result.result import Channel, Result

__all__ = ["record"]

Array = NDArray[np.float64]


def record(model: Model, outcome: Outcome) -> Result:
    """Return the result of an integrated model."""
    scene, mechanism = model.scene, model.mechanism
    time = sensor(model, mechanism.slider, "position", with_time=True)[:, 0]
    poses = [body_motion(model, body.name) for body in mechanism.bodies]
    position, velocity, acceleration = (
        np.stack(level, axis=1) for level in zip(*poses, strict=True)
    )
    names = [body.name for body in mechanism.bodies]
    slider, crank = names.index(mechanism.slider), names.index(mechanism.crank)
    channels = {
        "time": Channel(time, "s", "time"),
        "crank_angle": Channel(position[:, crank, 2], "rad", "crank angle from top dead centre"),
        "slider_position": Channel(
            position[:, slider, 1] - mechanism.slider_origin, "m", "slider position, upwards"
        ),
        "slider_velocity": Channel(velocity[:, slider, 1], "m/s", "slider velocity, upwards"),
        "slider_acceleration": Channel(
            acceleration[:, slider, 1], "m/s^2", "slider acceleration, upwards"
        ),
    }
    channels |= _constraint_forces(model)
    rigid = [index for index, name in enumerate(names) if name not in model.parts]
    stored = mechanical_energy(
        [mechanism.bodies[index] for index in rigid],
        position[:, rigid],
        velocity[:, rigid],
        scene.gravity,
    )
    dissipated = np.zeros_like(time)
    if model.parts:
        flexible_channels, flexible_stored, dissipated = record_parts(model, time)
        channels |= flexible_channels
        stored += flexible_stored
    overlay = overlay_of(model.mbs) if model.clearance_joints else None
    for name, joint in model.clearance_joints.items():
        assert overlay is not None
        held = {number: name for name, number in model.nodes.items()}
        q, q_t = (
            np.hstack([sensor(model, held[node], level) for node in overlay.nodes])
            for level in ("position", "velocity")
        )
        states = history(joint, time, q, q_t)
        spherical = name.startswith("ball")
        elastic = np.array([state.stored_energy for state in states])
        loads = np.array([state.force + state.moments for state in states])
        rates = np.array([state.velocity + state.spins for state in states])
        lost = -work(time, loads, rates) - (elastic - elastic[0])
        stored += elastic
        dissipated += lost
        in_words = name.replace("_", " ")
        channels |= {
            f"{name}_eccentricity": _vector(
                [state.eccentricity for state in states],
                "m",
                f"{in_words}: journal centre minus bearing centre",
                spherical,
            ),
            f"{name}_force": _vector(
                [state.force for state in states], "N", f"{in_words}: force on journal", spherical
            ),
            f"{name}_loss": Channel(lost, "J", f"{in_words}: energy dissipated since the start"),
        }
    driven = work(time, channels["drive_torque"].values, velocity[:, crank, 2])
    if "blanking_force" in channels:
        driven += work(time, channels["blanking_force"].values, velocity[:, slider, 1])
    channels |= {
        "energy_input": Channel(driven, "J", "work of drive and load since the start"),
        "energy_stored": Channel(stored - stored[0], "J", "change of stored energy"),
        "energy_dissipated": Channel(dissipated, "J", "energy dissipated since the start"),
        "body_position": Channel(position, "m, rad", "centres of mass and angles", "pose"),
    }
    return Result(
        scene=scene,
        channels=channels,
        info=_info(model, outcome, time),
        bodies=tuple(names),
    )


def _vector(rows: list[tuple[float, ...]], unit: str, words: str, spherical: bool) -> Channel:
    """Return a channel of vectors in space for spherical joints, else of their x and y."""
    values = np.zeros((len(rows), 3))
    values[:, : len(rows[0])] = rows
    return (
        Channel(values, unit, words, "space")
        if spherical
        else Channel(values[:, :2], unit, words, "plane")
    )


def _constraint_forces(model: Model) -> dict[str, Channel]:
    """Return the forces of drive, load, guides and ideal joints."""
    slider = model.mechanism.slider
    channels = {}
    for name, quantity in model.sensors:
        if quantity not in ("force", "moment"):
            continue
        values = sensor(model, name, quantity)
        in_words = name.replace("_", " ")
        if name == "drive":
            channels["drive_torque"] = Channel(-values[:, 0], "N m", "torque that turns the crank")
        elif name == "blanking":
            channels["blanking_force"] = Channel(
                values[:, 0], "N", "blanking force on the slider, upwards"
            )
        elif name.endswith("_guide"):
            shown = "guide" if name == f"{slider}_guide" else name
            unit = "N" if quantity == "force" else "N m"
            along = "to the right" if quantity == "force" else "counter-clockwise"
            channels[f"{shown}_{quantity}"] = Channel(
                -values[:, 0], unit, f"{in_words}: {quantity} on the body, {along}"
            )
        elif values.shape[1] == 1:
            rows: list[tuple[float, ...]] = [(0.0, value) for value in values[:, 0]]
            channels[f"{name}_force"] = _vector(
                rows, "N", f"{in_words}: force on journal", spherical=True
            )
        else:
            channels[f"{name}_force"] = Channel(
                values[:, :2], "N", f"{in_words}: force on journal", "plane"
            )
    return channels


def _info(model: Model, outcome: Outcome, time: Array) -> dict[str, Any]:
    """Return status, statistics, sizes and versions."""
    mbs = model.mbs
    packages = ("exu-press", "exudyn", "numpy", "scipy")
    return {
        "status": outcome.status.value,
        "reason": outcome.reason,
        "end_time": outcome.end_time,
        "wall_time": outcome.wall_time,
        "steps": outcome.steps,
        "rejected_steps": outcome.rejected_steps,
        "newton_iterations": outcome.newton_iterations,
        "law_evaluations": outcome.law_evaluations,
        **({"stress": worst_stress(model, time)} if model.parts else {}),
        "coordinates": mbs.systemData.ODE2Size(),
        "bodies": len(model.nodes),
        "connectors": mbs.systemData.NumberOfObjects() - len(model.nodes) - 1,
        "versions": {
            "python": platform.python_version(),
            **{name: importlib.metadata.version(name) for name in packages},
        },
    }
