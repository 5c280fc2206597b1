"""What is left open by reading loads at steps, which is in all runs alike."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from exu_press.result import Result

__all__ = ["LOADS", "smoothed"]

Array = NDArray[np.float64]

LOADS = ("acceleration", "force", "torque", "moment", "power", "shaking")
"""In the names of channels and figures that follow from accelerations."""


def smoothed(run: Result) -> Result:
    """Return a run whose loads are averaged, at each step, with the line through its neighbours.

    The constraints of generalized-alpha leave loads that alternate from step to step, most so at
    the start and in the small steps of impacts; this takes the alternating part away. Of a peak
    that lies between steps it takes twice what it may be higher than the steps say. So the
    difference of a figure of the two is what reading it leaves open.
    """
    channels = {
        name: replace(channel, values=_averaged(run.time, channel.values))
        if any(word in name for word in LOADS)
        else channel
        for name, channel in run.channels.items()
    }
    return replace(run, channels=channels)


def _averaged(time: Array, values: Array) -> Array:
    """Return values (n, ...) averaged with their neighbours', but for the first and the last."""
    if len(time) < 3:
        return values
    part = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    part = part.reshape(-1, *[1] * (values.ndim - 1))
    line = (1.0 - part) * values[:-2] + part * values[2:]
    return np.concatenate([values[:1], 0.5 * (values[1:-1] + line), values[-1:]])
