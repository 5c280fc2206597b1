"""Channels of gears, and of springs between bodies."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from exu_press.numerics.arrays import Array, lengths
from exu_press.result.channel import Channel, Declaration, Declarations
from exu_press.result.energy import work
from exu_press.result.motion import sensor
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.model import Model

__all__ = ["CHANNELS", "force_on_second_end", "record"]

CHANNELS = Declarations(
    Declaration(
        "gear_{gear}_torque",
        "N m",
        "gear {gear}: torque on its body, counter-clockwise",
        always=False,
    ),
    Declaration("spring_{spring}_length", "m", "spring {spring}: distance of its ends"),
    Declaration("spring_{spring}_force", "N", "spring {spring}: force that pushes its ends apart"),
    Declaration("spring_{spring}_loss", "J", "spring {spring}: energy dissipated since the start"),
)


def record(run: Recording) -> Record:
    """Return the torque of gears, and length, force, loss and stored energy of springs.

    A gear that is redundant has none; gears do no work.
    """
    total = Record({})
    for gear in run.model.constraints.gears:
        torque = sensor(run.model, f"gear_{gear}", "torque")[:, 0]
        total += Record(CHANNELS.record(gear, torque=torque))
    for spring in run.model.mechanism.springs:
        name = f"spring_{spring.name}"
        ends, velocity = (sensor(run.model, name, level) for level in ("ends", "velocity"))
        length = lengths(ends)
        rate = (ends * velocity).sum(axis=1) / length
        loss = work(run.time, spring.damping * rate, rate)
        force = np.asarray(spring.force(length, rate))
        channels = CHANNELS.record(spring.name, length=length, force=force, loss=loss)
        total += Record(channels, spring.energy(length), loss)
    return total


def force_on_second_end(model: "Model", spring: str, channels: Mapping[str, Channel]) -> Array:
    """Return the force of a recorded spring on its second end, (n, 2), N."""
    ends = sensor(model, f"spring_{spring}", "ends")[:, :2]
    force = channels[f"spring_{spring}_force"].values
    return np.asarray(ends * (force / lengths(ends))[:, None])
