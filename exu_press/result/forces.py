"""Forces that hold and drive the mechanism, press its frame, and shake it."""

from collections.abc import Collection, Mapping

import numpy as np

from exu_press.mechanism import GROUND, Motion
from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, guide_channel, positive
from exu_press.result.declared import channel
from exu_press.result.motion import point_acceleration, sensor

__all__ = ["frame_force", "guide_channels", "held_forces", "shaking_forces", "vectors"]


def held_forces(model: Model, motions: Mapping[str, Motion]) -> dict[str, Channel]:
    """Return the forces of drive, ideal joints and guides that hold a coordinate.

    Args:
        model: integrated.
        motions: of every body.
    """
    spherical = {joint.name for joint in model.mechanism.joints if joint.spherical}
    channels: dict[str, Channel] = {}
    for name, quantity in model.sensors:
        if quantity not in ("force", "moment"):
            continue
        values = sensor(model, name, quantity)
        if name == "drive":
            channels |= channel("drive_torque", -values[:, 0])
        elif name.endswith("_guide"):
            body = name.removesuffix("_guide")
            channels |= guide_channels(model, body, {quantity: -values[:, 0]})
        else:
            if name in model.holding.single_axis and not _flexible(model, name):
                values = _single_axis(model, motions, name, values[:, 0])
            channels |= channel("{joint}_force", vectors(values[:, :2], name in spherical), name)
    return channels | _of_several_faces(channels, model)


def _of_several_faces(channels: Mapping[str, Channel], model: Model) -> dict[str, Channel]:
    """Return the forces of joints of the frame with several faces: those of the faces.

    Face by face they are in the channels, too, numbered.
    """
    found: dict[str, Channel] = {}
    spherical = {joint.name for joint in model.mechanism.joints if joint.spherical}
    for part in model.parts.values():
        for joint, faces in part.faces.items():
            each = [f"{joint}_{number}_force" for number in range(1, len(faces) + 1)]
            if len(each) > 1 and each[0] in channels:
                force = np.sum([channels[name].values for name in each], axis=0)
                found |= channel("{joint}_force", vectors(force, joint in spherical), joint)
    return found


def frame_force(model: Model, channels: Mapping[str, Channel]) -> dict[str, Channel]:
    """Return the force of shaft, pivots and guides together on the frame, (n, 2), N."""
    on_bodies = np.zeros((len(channels["time"].values), 2))
    signs = {joint.name: 1.0 for joint in model.mechanism.joints if joint.bearing == GROUND}
    signs |= {joint.name: -1.0 for joint in model.mechanism.joints if joint.journal == GROUND}
    for name, sign in signs.items():
        if f"{name}_force" in channels:
            on_bodies += sign * channels[f"{name}_force"].values[:, :2]
    for guide in model.mechanism.guides:
        for quantity, direction in (("force", guide.across), ("friction", guide.direction)):
            force = channels.get(f"{guide_channel(model.mechanism, guide.body)}_{quantity}")
            if force is not None:
                on_bodies += np.outer(force.values, direction)
    return channel("frame_force", -on_bodies)


def _flexible(model: Model, joint: str) -> bool:
    """Return whether a joint holds a flexible body."""
    return any(joint in part.faces for part in model.parts.values())


def _single_axis(model: Model, motions: Mapping[str, Motion], joint: str, force: Array) -> Array:
    """Return the force on the journal, (n, 2), N, of a joint that holds one direction."""
    held = model.holding.single_axis[joint]
    described = next(one for one in model.mechanism.joints if one.name == joint)
    turned = 0.0 if held.body == GROUND else motions[held.body].position[:, 2]
    angle = held.angle + turned * np.ones_like(force)
    on_journal = force * (1.0 if held.body == described.journal else -1.0)
    return np.asarray(on_journal[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))


def guide_channels(model: Model, body: str, loads: Mapping[str, Array]) -> dict[str, Channel]:
    """Return the channels of a guide's action on its body.

    Args:
        model: integrated.
        body: that it guides.
        loads: "force" (N), "moment" (N m), "friction" (N) and "loss" (J), as far as there are.
    """
    guide = next(guide for guide in model.mechanism.guides if guide.body == body)
    shown, words = guide_channel(model.mechanism, body), f"{body.replace('_', ' ')} guide"
    found: dict[str, Channel] = {}
    for quantity, values in loads.items():
        way = positive(guide.direction if quantity == "friction" else guide.across)
        found |= channel(f"{{guide}}_{quantity}", values, shown, words=words, way=way)
    return found


def vectors(values: Array, spherical: bool) -> Array:
    """Return vectors (n, 2 or 3) in space for spherical joints, (n, 3), else in the plane."""
    if not spherical:
        return np.ascontiguousarray(values[:, :2])
    in_space = np.zeros((len(values), 3))
    in_space[:, : values.shape[1]] = values
    return in_space


def shaking_forces(model: Model, motions: Mapping[str, Motion]) -> dict[str, Channel]:
    """Return the shaking force, minus the rate of the mechanism's momentum, (n, 2), N.

    That is the force of shaft, pivots and guides on the frame, less weight and blanking force; the
    latter closes within the press, from the slider through tool and bed.

    Where the mechanism says which of its bodies are a counterweight, that of the others too: of the
    same press built without it, if it hangs on the crank and not on the slider's branch.

    Args:
        model: integrated.
        motions: of every body's frame.
    """
    forces = {}
    for body in model.mechanism.bodies:
        mass, centre = body.mass, motions[body.name].acceleration
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
    first, *others = names
    found = forces[first].copy(order="K")
    for name in others:
        found += forces[name]
    return found
