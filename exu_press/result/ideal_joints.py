"""Channels of the forces of ideal joints and guides that hold a coordinate."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import GROUND, Motion
from exu_press.numerics.arrays import Array
from exu_press.result.channel import VECTOR, Channel, Declaration, Declarations
from exu_press.result.guides import guide_channels
from exu_press.result.motion import sensor
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.model import Model

__all__ = ["CHANNELS", "record", "vectors"]

CHANNELS = Declarations(
    Declaration("{joint}_force", "N", "{joint}: force on journal", VECTOR, always=False)
)


def record(run: Recording) -> Record:
    """Return the forces of ideal joints and guides that the solver has as constraint forces."""
    model = run.model
    spherical = {joint.name for joint in model.mechanism.joints if joint.spherical}
    guides = {guide.key: guide.name for guide in model.mechanism.guides}
    channels: dict[str, Channel] = {}
    for name, quantity in model.sensors:
        if quantity not in ("force", "moment") or name == "drive":
            continue
        values = sensor(model, name, quantity)
        if name in guides:
            channels |= guide_channels(model.mechanism, guides[name], **{quantity: -values[:, 0]})
        else:
            if name in model.constraints.single_axis and not _is_on_flexible_body(model, name):
                values = _single_axis(model, run.motions, name, values[:, 0])
            channels |= CHANNELS.record(name, force=vectors(values[:, :2], name in spherical))
    return Record(channels | _sums_over_faces(channels, model))


def _sums_over_faces(channels: Mapping[str, Channel], model: "Model") -> dict[str, Channel]:
    """Return the forces of joints of the frame with several faces: those of the faces.

    Face by face they are in the channels, too, numbered.
    """
    totals: dict[str, Channel] = {}
    spherical = {joint.name for joint in model.mechanism.joints if joint.spherical}
    for placed in model.parts.values():
        for joint, faces in placed.faces.items():
            face_channels = [f"{joint}_{number}_force" for number in range(1, len(faces) + 1)]
            if len(face_channels) > 1 and face_channels[0] in channels:
                force = np.sum([channels[name].values for name in face_channels], axis=0)
                totals |= CHANNELS.record(joint, force=vectors(force, joint in spherical))
    return totals


def _is_on_flexible_body(model: "Model", joint: str) -> bool:
    """Return whether a joint holds a flexible body."""
    return any(joint in placed.faces for placed in model.parts.values())


def _single_axis(model: "Model", motions: Mapping[str, Motion], joint: str, force: Array) -> Array:
    """Return the force on the journal, (n, 2), N, of a joint that holds one direction."""
    constraint = model.constraints.single_axis[joint]
    declared = next(candidate for candidate in model.mechanism.joints if candidate.name == joint)
    rotation = 0.0 if constraint.body == GROUND else motions[constraint.body].position[:, 2]
    angle = constraint.angle + rotation * np.ones_like(force)
    on_journal = force * (1.0 if constraint.body == declared.journal else -1.0)
    return np.asarray(on_journal[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))


def vectors(values: Array, spherical: bool) -> Array:
    """Return vectors (n, 2 or 3) in space for spherical joints, (n, 3), else in the plane."""
    if not spherical:
        return np.ascontiguousarray(values[:, :2])
    in_space = np.zeros((len(values), 3))
    in_space[:, : values.shape[1]] = values
    return in_space
