"""Force on the frame, and shaking force."""

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import GROUND, Motion
from exu_press.mechanism.guide_motion import guide_direction
from exu_press.numerics.arrays import Array
from exu_press.result.channel import UNBALANCED, Channel, Declaration, Declarations, guide_channel
from exu_press.result.gears_and_springs import force_on_second_end
from exu_press.result.motion import point_acceleration
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.model import Model

__all__ = ["CHANNELS", "record"]

CHANNELS = Declarations(
    Declaration(
        "frame_force", "N", "force of shaft, pivots, guides and springs on the frame", "plane"
    ),
    Declaration("shaking_force", "N", "shaking force: minus the rate of momentum", "plane"),
    Declaration(
        "shaking_force_without_counterweight",
        "N",
        "shaking force without the counterweight",
        "plane",
        unless=UNBALANCED,
    ),
)


def record(run: Recording) -> Record:
    """Return the forces on the frame; all joints and guides have their channels."""
    frame = CHANNELS.record(frame_force=_frame_force(run.model, run.so_far.channels, run.motions))
    return Record(frame | _shaking_forces(run.model, run.motions))


def _frame_force(
    model: "Model", channels: Mapping[str, Channel], motions: Mapping[str, Motion]
) -> Array:
    """Return the force of shaft, pivots, guides and springs on the frame, (n, 2), N."""
    on_bodies = np.zeros((len(channels["time"].values), 2))
    signs = {joint.name: 1.0 for joint in model.mechanism.joints if joint.bearing == GROUND}
    signs |= {joint.name: -1.0 for joint in model.mechanism.joints if joint.journal == GROUND}
    for name, sign in signs.items():
        if f"{name}_force" in channels:
            on_bodies += sign * channels[f"{name}_force"].values[:, :2]
    for guide in model.mechanism.guides:
        if not guide.on_frame:
            continue
        for quantity, direction in (("force", guide.normal), ("friction", guide.direction)):
            force = channels.get(f"{guide_channel(model.mechanism, guide.name)}_{quantity}")
            if force is not None:
                if guide.is_slot:
                    turned = guide_direction(model.mechanism, guide, direction, motions)
                    on_bodies += force.values[:, None] * turned
                else:
                    on_bodies += np.outer(force.values, direction)
    for spring in model.mechanism.springs:
        for sign, body in zip((1.0, -1.0), spring.between, strict=True):
            if body == GROUND:
                on_bodies += sign * force_on_second_end(model, spring.name, channels)
    return -on_bodies


def _shaking_forces(model: "Model", motions: Mapping[str, Motion]) -> dict[str, Channel]:
    """Return the shaking force, minus the rate of the mechanism's momentum, (n, 2), N.

    That is the force of shaft, pivots and guides on the frame, less weight and blanking force; the
    latter closes within the press, from the slider through tool and bed.

    Where the mechanism says which of its bodies are a counterweight, that of the others too: of the
    same press built without it, if it hangs on the crank and not on the slider's branch.
    """
    forces = {}
    for body in model.mechanism.bodies:
        mass, centre = body.mass, motions[body.name].acceleration
        if body.name in model.parts:
            # modes are orthogonal to rigid motions: they have no momentum of their own
            reduced = model.parts[body.name].reduced
            mass, centre = (
                reduced.mass,
                point_acceleration(model, body.name, reduced.centre_of_mass),
            )
        forces[body.name] = -mass * centre[:, :2]
    channels = CHANNELS.record(shaking_force=_sum(forces, forces))
    if counterweight := model.mechanism.counterweight:
        remaining = [name for name in forces if name not in counterweight]
        unbalanced = _sum(forces, remaining)
        channels |= CHANNELS.record(shaking_force_without_counterweight=unbalanced)
    return channels


def _sum(forces: dict[str, Array], names: Collection[str]) -> Array:
    first, *remaining = names
    total = forces[first].copy(order="K")
    for name in remaining:
        total += forces[name]
    return total
