"""The last revolution of a run, and its deviation from the ideal mechanism."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from exu_press.result import Result
from exu_press.scene import mechanism_of
from paper.readings import WINDOW, observed_span

__all__ = ["ideal_motion", "last_revolution", "mean_acceleration"]

Array = NDArray[np.float64]


def last_revolution(result: Result) -> Result:
    """Return what is observed of a run, its crank angle counted from that revolution's start."""
    start, end = observed_span(result)
    inside = (result.time >= start - 1e-12) & (result.time <= end + 1e-12)
    channels = {
        name: replace(channel, values=channel.values[inside])
        for name, channel in result.channels.items()
    }
    angle = channels["crank_angle"]
    whole_turns = 2.0 * np.pi * np.floor(angle.values[0] / (2.0 * np.pi) + 1e-6)
    channels["crank_angle"] = replace(angle, values=angle.values - whole_turns)
    return replace(result, channels=channels)


def ideal_motion(result: Result) -> tuple[Array, Array, Array]:
    """Return position (m), velocity and acceleration of the ideal slider at a run's instants."""
    scene = result.scene
    return mechanism_of(scene).ideal_slider(result["crank_angle"], scene.angular_speed)


def mean_acceleration(result: Result) -> Array:
    """Return the mean acceleration over the millisecond before each instant, (n,), m/s^2.

    As the table has it; NaN in the first millisecond.
    """
    time, velocity = result.time, result["slider_velocity"]
    change = velocity - np.interp(time - WINDOW, time, velocity)
    return np.asarray(np.where(time >= time[0] + WINDOW, change / WINDOW, np.nan))
