"""The state of a model after a run, and its continuation by another model."""

from collections.abc import Sequence, Sized
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.integrate.system import System
from exu_press.model.model import Model
from exu_press.model.state import State
from exu_press.numerics.arrays import Array
from exu_press.scene.solver import RPM

__all__ = ["go_on_from", "state_of"]

ROUNDED = 1e-9
"""A smaller difference of the crank, rad, or of its speed, over that, is rounding."""

COORDINATES = (
    "second-order coordinates",
    "first-order coordinates",
    "constraint forces",
    "data variables",
)
"""Lists of `State.coordinates`, but for rates, of which there are as many as coordinates."""


def state_of(model: Model) -> State:
    """Return the state of a model after it was solved."""
    data: Any = model.mbs.systemData
    user_force = System.of_mbs(model.mbs).joints
    state: State = {
        "time": float(data.GetTime()),
        "step": float(model.mbs.sys["dynamicSolver"].it.currentStepSize),
        "coordinates": [np.asarray(values).tolist() for values in data.GetSystemState()],
        "accelerations": np.asarray(data.GetODE2Coordinates_tt()).tolist(),
        "reference": _reference(model).tolist(),
        "joints": None if user_force is None else user_force.memory(),
        "clocks": [clock.memory() for clock, _ in model.clocks],
    }
    if model.warm:
        state["films"] = {n: (film.temperature, film.pressure) for n, film in model.warm.items()}
    if model.start_stop is not None:
        state["start_stop"] = model.start_stop.memory()
    return state


def go_on_from(model: Model, state: State) -> None:
    """Let a model start in a state, at its time.

    Raises:
        InputError: the state belongs to other bodies, joints or modes, or to another speed of a
            crank that turns at constant speed.
    """
    data: Any = model.mbs.systemData
    initial = exu.ConfigurationType.Initial
    user_force = System.of_mbs(model.mbs).joints
    own_sizes = _sizes(
        data.GetSystemState(configuration=initial),
        () if user_force is None else user_force.joints,
        model.clocks,
        () if model.start_stop is None else model.start_stop.memory(),
    )
    joints = () if state["joints"] is None else state["joints"]["joints"]
    sizes = _sizes(state["coordinates"], joints, state["clocks"], state.get("start_stop", ()))
    if differing := [name for name, size in own_sizes.items() if sizes[name] != size]:
        counts = ", and ".join(
            f"{sizes[name]} {name}, the scene {own_sizes[name]}" for name in differing
        )
        raise InputError(
            f"the state has {counts}: allowed is a run of the same bodies, joints, loads and drive"
        )
    coordinates: list[Array] = [np.array(values) for values in state["coordinates"]]
    coordinates[0] = coordinates[0] + (np.array(state["reference"]) - _reference(model))
    data.SetSystemState(systemStateList=coordinates, configuration=initial)
    data.SetODE2Coordinates_tt(coordinates=state["accelerations"], configuration=initial)
    nominal = model.scene.start_angle + model.scene.angular_speed * state["time"]
    ahead = model.crank_at_start() - nominal
    speed = model.crank_angle()[1]
    if model.scene.drive is None and abs(speed / model.scene.angular_speed - 1.0) > ROUNDED:
        raise InputError(
            f"speed_rpm = {model.scene.speed_rpm:g}: the crank of the state turns at "
            f"{speed / RPM:g} rpm; allowed is that speed, or the same scene from its own start"
        )
    model.ahead[0] = ahead if abs(ahead) > ROUNDED else 0.0
    data.SetTime(newTime=state["time"], configurationType=initial)
    if user_force is not None and state["joints"] is not None:
        user_force.recall(state["joints"])
    for (clock, _), memory in zip(model.clocks, state["clocks"], strict=True):
        clock.recall(memory)
    for name, (temperature, pressure) in state.get("films", {}).items():
        if name in model.warm:
            model.warm[name].set_state(temperature, pressure)
    if model.start_stop is not None and "start_stop" in state:
        model.start_stop.recall(state["start_stop"])
    model.begin, model.first_step = state["time"], state["step"]
    model.remembered = tuple(state["clocks"])


def _sizes(
    coordinates: Sequence[Sized], joints: Sized, clocks: Sized, start_stop: Sized
) -> dict[str, int]:
    """Return the lengths of a state's lists, by what they hold."""
    positions, _, *further = coordinates
    return {
        **dict(zip(COORDINATES, map(len, (positions, *further)), strict=True)),
        "joints with clearance": len(joints),
        "pulses and sheets": len(clocks),
        "numbers of clutch, brake and schedule": len(start_stop),
    }


def _reference(model: Model) -> Array:
    """Return the reference values of a model's second-order coordinates."""
    data: Any = model.mbs.systemData
    return np.array(data.GetODE2Coordinates(configuration=exu.ConfigurationType.Reference))
