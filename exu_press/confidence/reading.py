"""What is left open by reading loads at steps, which is in all runs alike."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from exu_press.result import Result

__all__ = ["LOADS", "OF_FIRST_STEP", "overshot", "smoothed"]

Array = NDArray[np.float64]

LOADS = ("acceleration", "force", "torque", "moment", "power", "shaking")
"""In the names of channels and figures that follow from accelerations."""


OF_FIRST_STEP = 0.25
"""Of a load's change in the first step, its overshoot: 0.07 to 0.18 were measured with films."""


def smoothed(run: Result) -> Result:
    """Return a run whose loads are averaged, at each step, with the line through its neighbours.

    The constraints of generalized-alpha leave loads that alternate from step to step, most so at
    the start and in the small steps of impacts; this takes the alternating part away. Of a peak
    that lies between steps it takes twice what it may be higher than the steps say. So the
    difference of a figure of the two is what reading it leaves open.
    """
    return _with_loads(run, _averaged)


def overshot(run: Result) -> Result:
    """Return a run whose loads go on by a part, OF_FIRST_STEP, of what the first step changes.

    Within it films take up their loads, with an overshoot that its end does not show.
    """
    return _with_loads(run, _overshot)


def _with_loads(run: Result, change: Callable[[Array, Array], Array]) -> Result:
    """Return a run with other loads: change(time (n,), values (n, ...))."""
    channels = {
        name: replace(channel, values=change(run.time, channel.values))
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


def _overshot(_: Array, values: Array) -> Array:
    """Return values (n, ...) with a larger second one."""
    if len(values) < 2:
        return values
    second = values[1] + OF_FIRST_STEP * (values[1] - values[0])
    return np.concatenate([values[:1], second[None], values[2:]])
