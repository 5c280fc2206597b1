"""The state of a model after a run, and its continuation by another model."""

from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.integrate.system import System
from exu_press.model.model import Model
from exu_press.model.state import State
from exu_press.numerics.arrays import Array

__all__ = ["go_on_from", "state_of"]

ROUNDED = 1e-9
"""rad: a smaller difference of the crank from its start and speed is rounding."""


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
        InputError: the state belongs to other bodies, joints or modes.
    """
    data: Any = model.mbs.systemData
    initial = exu.ConfigurationType.Initial
    user_force = System.of_mbs(model.mbs).joints
    sizes = [len(values) for values in data.GetSystemState(configuration=initial)]
    state_sizes = [len(values) for values in state["coordinates"]]
    histories = 0 if state["joints"] is None else len(state["joints"]["joints"])
    joints = 0 if user_force is None else len(user_force.joints)
    if sizes != state_sizes or histories != joints or len(state["clocks"]) != len(model.clocks):
        raise InputError(
            f"the state has {state_sizes[0]} coordinates and {histories} joints with clearance, "
            f"the scene {sizes[0]} and {joints}: allowed is a run of the same bodies, joints and "
            "loads"
        )
    coordinates: list[Array] = [np.array(values) for values in state["coordinates"]]
    coordinates[0] = coordinates[0] + (np.array(state["reference"]) - _reference(model))
    data.SetSystemState(systemStateList=coordinates, configuration=initial)
    data.SetODE2Coordinates_tt(coordinates=state["accelerations"], configuration=initial)
    nominal = model.scene.start_angle + model.scene.angular_speed * state["time"]
    ahead = model.crank_at_start() - nominal
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


def _reference(model: Model) -> Array:
    """Return the reference values of a model's second-order coordinates."""
    data: Any = model.mbs.systemData
    return np.array(data.GetODE2Coordinates(configuration=exu.ConfigurationType.Reference))
