"""The moving masses' inertia forces: what shakes the press."""

from collections.abc import Collection

import numpy as np

from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel
from exu_press.result.declared import channel
from exu_press.result.motion import point_acceleration

__all__ = ["shaking_forces"]


def shaking_forces(model: Model, acceleration: Array) -> dict[str, Channel]:
    """Return the shaking force, minus the rate of the mechanism's momentum, (n, 2), N.

    That is what shaft, pivots and guides press the frame with, less weight and blanking force; the
    latter closes within the press, from the slider through tool and bed.

    Where the mechanism says which of its bodies are a counterweight, that of the others too: of the
    same press built without it, if it hangs on the crank and not on the slider's branch.

    Args:
        model: integrated.
        acceleration: (n, bodies, 3) of every body's frame.
    """
    forces = {}
    for index, body in enumerate(model.mechanism.bodies):
        mass, centre = body.mass, acceleration[:, index]
        if body.name in model.parts:
            # modes are orthogonal to rigid motions: they have no momentum of their own
            part = model.parts[body.name].reduced
            mass, centre = part.mass, point_acceleration(model, body.name, part.centre_of_mass)
        forces[body.name] = -mass * centre[:, :2]
    channels = channel("shaking_force", _sum(forces, forces))
    if counterweight := model.mechanism.counterweight:
        others = [name for name in forces if name not in counterweight]
        channels |= channel("shaking_force_without_counterweight", _sum(forces, others))
    return channels


def _sum(forces: dict[str, Array], names: Collection[str]) -> Array:
    return np.asarray(np.sum([forces[name] for name in names], axis=0))
