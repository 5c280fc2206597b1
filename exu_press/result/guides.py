"""Channels of guides, and the record of those without clearance: elastic ones, and friction."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import Guide, Mechanism
from exu_press.mechanism.guide_motion import motion_in_guide
from exu_press.numerics.arrays import Array
from exu_press.result.channel import (
    Channel,
    Declaration,
    Declarations,
    direction_text,
    guide_channel,
)
from exu_press.result.energy import work
from exu_press.result.motion import body_motion
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.model import Model

__all__ = ["CHANNELS", "guide_channels", "record"]

CHANNELS = Declarations(
    *(
        Declaration(f"{{guide}}_{quantity}", unit, f"{{guide}}: {meaning}", axis, always=False)
        for quantity, unit, meaning, axis in (
            ("force", "N", "force on the body, {positive}", ""),
            ("moment", "N m", "moment on the body, counter-clockwise", ""),
            ("friction", "N", "friction on the body, {positive}", ""),
            (
                "normal_force",
                "N",
                "normal forces on the body's back and front end, on the right side +",
                "guided",
            ),
            ("sliding", "m/s", "sliding velocity of both ends", "guided"),
            ("wall_force", "N", "normal force of a wall on the pin, of the right one +", ""),
            ("pin_sliding", "m/s", "sliding velocity of the pin on the wall", ""),
            ("loss", "J", "energy dissipated since the start", ""),
            ("gap", "m", "least thickness of its film, or minus the penetration", ""),
        )
    )
)


def guide_channels(mechanism: Mechanism, name: str, **values: Array) -> dict[str, Channel]:
    """Return the channels of a guide's action on its body.

    Args:
        mechanism: with the guide.
        name: of the guide.
        values: by quantity, as force (N, across), moment (N m), friction (N, along), loss (J).
    """
    guide = mechanism.guide(name)
    owner, label = guide_channel(mechanism, name), f"{name.replace('_', ' ')} guide"
    channels: dict[str, Channel] = {}
    for quantity, history in values.items():
        positive = direction_text(guide.direction if quantity == "friction" else guide.normal)
        positive += (
            ""
            if guide.on_frame and not guide.centre
            else f" in the drawing, turning with {guide.key}"
        )
        channels |= CHANNELS.record(owner, label=label, positive=positive, **{quantity: history})
    return channels


def record(run: Recording) -> Record:
    """Return the channels of elastic guides and of friction, stored and dissipated energy.

    Friction needs the forces of all guides: its record comes after theirs.
    """
    elastic = _elastic(run)
    return elastic + _friction(run, run.so_far.channels | elastic.channels)


def _elastic(run: Recording) -> Record:
    """Return the losses of elastic guides, and the forces of those without a sensor."""
    model, time = run.model, run.time
    channels: dict[str, Channel] = {}
    stored, dissipated = np.zeros_like(time), np.zeros_like(time)
    for guide in model.mechanism.guides:
        if guide.lateral is None and guide.tilting is None:
            continue
        loss = np.zeros_like(time)
        pose, velocity = _motion_in_guide(run, guide)
        displacement = pose - _relaxed_pose(model, guide)
        springs = (guide.lateral, (*guide.normal, 0.0)), (guide.tilting, (0.0, 0.0, 1.0))
        reactions = {}
        for quantity, (spring, direction) in zip(("force", "moment"), springs, strict=True):
            if spring is not None:
                deflection, rate = (
                    displacement @ np.array(direction),
                    velocity @ np.array(direction),
                )
                stored += 0.5 * spring.stiffness * deflection**2
                loss += work(time, spring.damping * rate, rate)
                reactions[quantity] = -(spring.stiffness * deflection + spring.damping * rate)
        if guide.body in model.parts or not guide.is_rail:  # others have sensors
            channels |= guide_channels(model.mechanism, guide.name, **reactions)
        channels |= guide_channels(model.mechanism, guide.name, loss=loss)
        dissipated += loss
    return Record(channels, stored, dissipated)


def _friction(run: Recording, channels: Mapping[str, Channel]) -> Record:
    """Return the friction of guides without clearance, and their losses with it."""
    model, time = run.model, run.time
    friction_channels: dict[str, Channel] = {}
    dissipated = np.zeros_like(time)
    for name, guide_friction in model.guide_friction.items():
        guide = model.mechanism.guide(name)
        speed = _motion_in_guide(run, guide)[1][:, :2] @ np.array(guide.direction)
        prefix = guide_channel(model.mechanism, name)
        normal = np.abs(channels[f"{prefix}_force"].values)
        friction = -guide_friction.friction.coefficients(time, speed) * normal
        loss = -work(time, friction, speed)
        dissipated += loss
        if f"{prefix}_loss" in channels:  # of its spring
            loss = loss + channels[f"{prefix}_loss"].values
        friction_channels |= guide_channels(model.mechanism, name, friction=friction, loss=loss)
    return Record(friction_channels, dissipated=dissipated)


def _motion_in_guide(run: Recording, guide: Guide) -> tuple[Array, Array]:
    """Return pose and velocity, (n, 3) each, of what lies in a guide, in its drawing."""
    discs = {body: guide.disc_of(body) for body in guide.bodies}
    discs = {body: disc for body, disc in discs.items() if disc in run.model.rigid}
    motions = {**run.motions, **{b: body_motion(run.model, disc) for b, disc in discs.items()}}
    if guide.is_rail and guide.body in run.model.parts:
        from exu_press.result.flexible import guided_motion

        motions = {**motions, guide.body: guided_motion(run.model, guide.body)}
    return motion_in_guide(run.model.mechanism, guide, motions)


def _relaxed_pose(model: "Model", guide: Guide) -> Array:
    """Return the pose (3,) in the drawing in which the springs of a guide are relaxed."""
    if not guide.is_rail:
        body = model.mechanism.body(guide.body)
        return np.array([*body.centre_of_mass, body.angle])
    if guide.body in model.rigid:
        return model.rigid[guide.body].reference
    start = model.mechanism.motion(np.array([model.scene.start_angle]), 1.0)[guide.body]
    return np.asarray(start.position[0])
