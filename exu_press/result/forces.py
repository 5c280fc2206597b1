"""What holds and drives the mechanism: forces of load, drive, guides and ideal joints."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from exu_press.mechanism import GROUND
from exu_press.model import Model
from exu_press.result.motion import sensor
from exu_press.result.result import Channel

__all__ = ["frame_force", "guide_channel", "guide_channels", "held_forces", "vectors"]

Array = NDArray[np.float64]


def held_forces(model: Model) -> dict[str, Channel]:
    """Return the forces of drive, load, ideal joints and guides that hold a coordinate."""
    spherical = {joint.name for joint in model.mechanism.joints if joint.spherical}
    channels = {}
    for name, quantity in model.sensors:
        if quantity not in ("force", "moment"):
            continue
        values = sensor(model, name, quantity)
        in_words = name.replace("_", " ")
        if name == "drive":
            channels["drive_torque"] = Channel(-values[:, 0], "N m", "torque that turns the crank")
        elif name == "blanking":
            channels |= _load(model, values[:, 0])
        elif name.endswith("_guide"):
            body = name.removesuffix("_guide")
            channels |= guide_channels(model, body, {quantity: -values[:, 0]})
        else:
            if values.shape[1] == 1:  # held vertically alone
                values = np.column_stack([np.zeros(len(values)), values])
            channels[f"{name}_force"] = vectors(
                values[:, :2], "N", f"{in_words}: force on journal", name in spherical
            )
    return channels


def frame_force(model: Model, channels: Mapping[str, Channel]) -> Channel:
    """Return what shaft, pivots and guides together press the frame with, (n, 2), N."""
    on_bodies = np.zeros((len(channels["time"].values), 2))
    grounded = [joint.name for joint in model.mechanism.joints if joint.bearing == GROUND]
    bearings = [name for name in model.ideal_joints if name not in _names(model)]  # flexible crank
    for name in (*grounded, *bearings):
        if f"{name}_force" in channels:
            on_bodies += channels[f"{name}_force"].values
    for guide in model.mechanism.guides:
        on_bodies[:, 0] += channels[f"{guide_channel(model, guide.body)}_force"].values
    return Channel(-on_bodies, "N", "force of shaft, pivots and guides on the frame", "plane")


def guide_channel(model: Model, body: str) -> str:
    """Return what the channels of a body's guide begin with; the slider's is the guide."""
    return "guide" if body == model.mechanism.slider else f"{body}_guide"


def guide_channels(model: Model, body: str, loads: Mapping[str, Array]) -> dict[str, Channel]:
    """Return the channels of what a guide does to its body: "force" (N) and "moment" (N m)."""
    units = {"force": ("N", "to the right"), "moment": ("N m", "counter-clockwise")}
    shown, in_words = guide_channel(model, body), f"{body.replace('_', ' ')} guide"
    found = {}
    for quantity, values in loads.items():
        unit, along = units[quantity]
        words = f"{in_words}: {quantity} on the body, {along}"
        found[f"{shown}_{quantity}"] = Channel(values, unit, words)
    return found


def _load(model: Model, force: Array) -> dict[str, Channel]:
    """Return the channels of the blanking force and, if it acts beside the middle, its moment."""
    pulse = model.scene.blanking
    assert pulse is not None
    found = {"blanking_force": Channel(force, "N", "blanking force on the slider, upwards")}
    if pulse.eccentricity != 0.0:
        found["blanking_moment"] = Channel(
            pulse.eccentricity * force, "N m", "blanking moment on the slider, counter-clockwise"
        )
    return found


def vectors(values: Array, unit: str, words: str, spherical: bool) -> Channel:
    """Return a channel of vectors (n, 2 or 3), in space for spherical joints, else in the plane."""
    if not spherical:
        return Channel(values[:, :2], unit, words, "plane")
    in_space = np.zeros((len(values), 3))
    in_space[:, : values.shape[1]] = values
    return Channel(in_space, unit, words, "space")


def _names(model: Model) -> set[str]:
    return {joint.name for joint in model.mechanism.joints}
