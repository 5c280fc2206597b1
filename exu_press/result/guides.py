"""What elastic guides store and turn into heat."""

import numpy as np
from numpy.typing import NDArray

from exu_press.model import Model
from exu_press.result.channel import Channel
from exu_press.result.energy import work
from exu_press.result.forces import guide_channel

__all__ = ["record_guides"]

Array = NDArray[np.float64]


def record_guides(
    model: Model, time: Array, position: Array, velocity: Array
) -> tuple[dict[str, Channel], Array, Array]:
    """Return the losses of elastic guides as channels, their stored and their lost energy, J.

    Args:
        model: integrated.
        time: (n,), s.
        position: (n, bodies, 3) of every body.
        velocity: same shape.
    """
    channels: dict[str, Channel] = {}
    stored, dissipated = np.zeros_like(time), np.zeros_like(time)
    names = [body.name for body in model.mechanism.bodies]
    for guide in model.mechanism.guides:
        springs = (guide.lateral, (*guide.across, 0.0)), (guide.tilting, (0.0, 0.0, 1.0))
        if not any(spring for spring, _ in springs):
            continue
        index, lost = names.index(guide.body), np.zeros_like(time)
        for spring, direction in springs:
            if spring is not None:
                away = position[:, index] - model.rigid[guide.body].reference
                moved, rate = away @ np.array(direction), velocity[:, index] @ np.array(direction)
                stored += 0.5 * spring.stiffness * moved**2
                lost += work(time, spring.damping * rate, rate)
        words = f"{guide.body.replace('_', ' ')} guide: energy dissipated since the start"
        channels[f"{guide_channel(model, guide.body)}_loss"] = Channel(lost, "J", words)
        dissipated += lost
    return channels, stored, dissipated
