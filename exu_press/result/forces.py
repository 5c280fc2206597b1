"""What holds and drives the mechanism: forces of load, drive, guides and ideal joints."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from exu_press.mechanism import GROUND
from exu_press.model import Model
from exu_press.result.motion import sensor
from exu_press.result.result import Channel

__all__ = ["frame_force", "guide_channel", "held_forces", "vectors"]

Array = NDArray[np.float64]

LOADS = {
    "force": ("N", "blanking force on the slider, upwards"),
    "moment": ("N m", "blanking moment on the slider, counter-clockwise"),
}


def held_forces(model: Model) -> dict[str, Channel]:
    """Return the forces of drive, load, guides and ideal joints."""
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
            channels[f"blanking_{quantity}"] = Channel(values[:, 0], *LOADS[quantity])
        elif name.endswith("_guide"):
            shown = guide_channel(model, name.removesuffix("_guide"))
            unit = "N" if quantity == "force" else "N m"
            along = "to the right" if quantity == "force" else "counter-clockwise"
            channels[f"{shown}_{quantity}"] = Channel(
                -values[:, 0], unit, f"{in_words}: {quantity} on the body, {along}"
            )
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


def vectors(values: Array, unit: str, words: str, spherical: bool) -> Channel:
    """Return a channel of vectors (n, 2 or 3), in space for spherical joints, else in the plane."""
    if not spherical:
        return Channel(values[:, :2], unit, words, "plane")
    in_space = np.zeros((len(values), 3))
    in_space[:, : values.shape[1]] = values
    return Channel(in_space, unit, words, "space")


def _names(model: Model) -> set[str]:
    return {joint.name for joint in model.mechanism.joints}
