"""Channels of loads: forces, and the work that they put in."""

from collections.abc import Mapping

import numpy as np

from exu_press.mechanism import Motion
from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel
from exu_press.result.declared import channel
from exu_press.result.energy import work
from exu_press.result.flexible import carried_motion

__all__ = ["record_loads"]


def record_loads(
    model: Model,
    time: Array,
    crank: tuple[Array, Array],
    slider: tuple[Array, Array],
    motions: Mapping[str, Motion],
) -> tuple[dict[str, Channel], Array]:
    """Return force, moment (where the load acts beside the middle) and work of every load.

    Args:
        model: integrated.
        time: (n,), s.
        crank: angle of the body that the drive turns, (n,), rad, and angular velocity, rad/s.
        slider: its position, (n,), m, and velocity, m/s.
        motions: of every body.

    Returns:
        The channels, and the work of all loads since the start, (n,), J.
    """
    channels: dict[str, Channel] = {}
    all_work = np.zeros_like(time)
    lasting = [name for name, (load, _) in model.loads.items() if load.clock or load.sheet]
    memory = dict(zip(lasting, model.remembered, strict=False))  # empty in a run of its own
    height = slider[0] - model.mechanism.bottom, slider[1]
    for name, (load, _) in model.loads.items():
        force = load.force(time, crank, height, memory.get(name))
        if load.body in model.parts:
            part = model.parts[load.body]
            velocity = carried_motion(model, load.body, part.loads[name], load.point)[1]
        else:
            velocity = motions[load.body].at(load.point).velocity
        along = velocity[:, :2] @ np.array(load.direction)
        done = work(time, force, along)
        all_work += done
        words = f"{name} on the {load.body.replace('_', ' ')}"
        channels |= channel("load_{load}_force", force, name, words=words)
        channels |= channel("load_{load}_work", done, name, words=words)
        if load.point != (0.0, 0.0):
            moment = load.moment(force, motions[load.body].position[:, 2])
            channels |= channel("load_{load}_moment", moment, name, words=words)
    return channels, all_work
