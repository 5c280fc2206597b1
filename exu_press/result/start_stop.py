"""Channels of flywheel, clutch and brake."""

import numpy as np

from exu_press.mechanism.parts import FLYWHEEL
from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel
from exu_press.result.declared import channel
from exu_press.result.energy import work
from exu_press.result.motion import sensor

__all__ = ["record_start_stop"]


def record_start_stop(
    model: Model, time: Array, crank_speed: Array
) -> tuple[dict[str, Channel], Array, Array]:
    """Return the channels, the stored and the dissipated energy, (n,) each, J.

    The work on a clutch or brake is dissipated, but for the twist of its shafts.

    Args:
        model: integrated.
        time: (n,), s.
        crank_speed: (n,), rad/s.
    """
    start_stop, motor = model.start_stop, model.scene.drive
    assert start_stop is not None
    assert motor is not None
    wheel = sensor(model, FLYWHEEL, "velocity")[:, 0]
    channels = channel("flywheel_speed", wheel)
    stored = 0.5 * motor.inertia * wheel**2
    dissipated = np.zeros_like(time)
    for name, pressed, rate in (
        ("clutch", start_stop.clutch, wheel - crank_speed),
        ("brake", start_stop.brake, crank_speed),
    ):
        if pressed is None:
            continue
        torque = sensor(model, name, "torque")[:, 0]
        twisted = 0.5 * torque**2 / pressed.coupling.stiffness
        lost = work(time, torque, rate) - (twisted - twisted[0])
        channels |= channel(f"{name}_torque", torque)
        channels |= channel(f"{name}_loss", lost)
        stored = stored + twisted
        dissipated += lost
    return channels, stored, dissipated
