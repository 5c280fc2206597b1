"""Forces, energy and heat of guides: elastic ones, ones with clearance, and friction."""

from collections.abc import Mapping

import numpy as np

from exu_press.joints import history
from exu_press.mechanism import Motion
from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, guide_channel
from exu_press.result.energy import work
from exu_press.result.flexible import guided_motion
from exu_press.result.forces import guide_channels
from exu_press.result.joints import stored_and_lost
from exu_press.scene.wearing import wearing_guides

__all__ = ["record_friction", "record_guides", "record_guideways"]


def record_guides(
    model: Model, time: Array, motions: Mapping[str, Motion]
) -> tuple[dict[str, Channel], Array, Array]:
    """Return the losses of elastic guides as channels, their stored and their lost energy, J.

    Args:
        model: integrated.
        time: (n,), s.
        motions: of every body.
    """
    channels: dict[str, Channel] = {}
    stored, dissipated = np.zeros_like(time), np.zeros_like(time)
    for guide in model.mechanism.guides:
        springs = (guide.lateral, (*guide.across, 0.0)), (guide.tilting, (0.0, 0.0, 1.0))
        if not any(spring for spring, _ in springs):
            continue
        flexible, lost = guide.body in model.parts, np.zeros_like(time)
        held = guided_motion(model, guide.body) if flexible else motions[guide.body]
        place, speed = held.position - _relaxed(model, guide.body), held.velocity
        loads = {}
        for quantity, (spring, direction) in zip(("force", "moment"), springs, strict=True):
            if spring is not None:
                moved, rate = place @ np.array(direction), speed @ np.array(direction)
                stored += 0.5 * spring.stiffness * moved**2
                lost += work(time, spring.damping * rate, rate)
                loads[quantity] = -(spring.stiffness * moved + spring.damping * rate)
        if flexible:  # of others sensors tell it
            channels |= guide_channels(model, guide.body, loads)
        channels |= guide_channels(model, guide.body, {"loss": lost})
        dissipated += lost
    return channels, stored, dissipated


def record_friction(
    model: Model, time: Array, motions: Mapping[str, Motion], channels: Mapping[str, Channel]
) -> tuple[dict[str, Channel], Array]:
    """Return the friction of guides without clearance, their losses with it, and its sum, J.

    Args:
        model: integrated.
        time: (n,), s.
        motions: of every body.
        channels: with the guides' forces, and losses of elastic ones.
    """
    found: dict[str, Channel] = {}
    dissipated = np.zeros_like(time)
    guides = {guide.body: guide for guide in model.mechanism.guides}
    for name, rubbing in model.guide_friction.items():
        moving = guided_motion(model, name) if name in model.parts else motions[name]
        speed = moving.velocity[:, :2] @ np.array(guides[name].direction)
        shown = guide_channel(model.mechanism, name)
        side = np.abs(channels[f"{shown}_force"].values)
        friction = -rubbing.friction.coefficients(time, speed) * side
        lost = -work(time, friction, speed)
        dissipated += lost
        if f"{shown}_loss" in channels:  # of its spring
            lost = lost + channels[f"{shown}_loss"].values
        found |= guide_channels(model, name, {"friction": friction, "loss": lost})
    return found, dissipated


def _relaxed(model: Model, name: str) -> Array:
    """Return the pose (3,) in which the springs of a body's guide are relaxed."""
    if name in model.rigid:
        return model.rigid[name].reference
    start = model.mechanism.motion(np.array([model.scene.start_angle]), 1.0)[name]
    return np.asarray(start.position[0])


def record_guideways(
    model: Model, time: Array, motions: Mapping[str, Motion]
) -> tuple[dict[str, Channel], Array, Array]:
    """Return the action of guideways on their bodies, their stored and their lost energy, J.

    Args:
        model: integrated.
        time: (n,), s.
        motions: of every body.

    Returns:
        Force across and moment about the centre of mass of each guide, friction along it, its
        losses, and the least thickness of its film; the sums of both ends and of the film.
    """
    channels: dict[str, Channel] = {}
    all_stored, all_lost = np.zeros_like(time), np.zeros_like(time)
    wearing = wearing_guides(model.scene)
    states = {
        f"{body} {n}": history(model.states, each, time)
        for body, all_of in model.guideways.items()
        for n, each in enumerate(all_of)
    }
    for guide in model.mechanism.guides:
        if guide.guideway is None:
            continue
        angle = motions[guide.body].position[:, 2]
        angle = angle - model.mechanism.body(guide.body).angle
        x, y = guide.direction
        force, moment, lost = np.zeros((len(time), 2)), np.zeros_like(time), np.zeros_like(time)
        for n, side in enumerate((-1.0, 1.0)):
            end = states[f"{guide.body} {n}"]
            pressed = end.force[:, :2]
            reach = 0.5 * side * guide.guideway.length
            arm_x = reach * (np.cos(angle) * x - np.sin(angle) * y)
            arm_y = reach * (np.sin(angle) * x + np.cos(angle) * y)
            force += pressed
            moment += arm_x * pressed[:, 1] - arm_y * pressed[:, 0]
            moment += end.moments[:, 0]
            elastic, lost_here = stored_and_lost(end, time)
            lost += lost_here
            all_stored += elastic
        film = states.get(f"{guide.body} 2")
        if film is not None:
            force += film.force
            moment += film.moments.sum(axis=1)
            lost += stored_and_lost(film, time)[1]
            channels |= guide_channels(model, guide.body, {"gap": film.gap})
        all_lost += lost
        across, along = force @ np.array(guide.across), force @ np.array(guide.direction)
        held = {"force": across, "moment": moment, "friction": along, "loss": lost}
        channels |= guide_channels(model, guide.body, held)
        if guide.body in wearing:
            both = [states[f"{guide.body} {n}"] for n in (0, 1)]
            on_right = [np.sign(end.eccentricity[:, :2] @ np.array(guide.across)) for end in both]
            normal = [s * end.rubbing[:, 0] for s, end in zip(on_right, both, strict=True)]
            sliding = [end.rubbing[:, 1] for end in both]
            rubbed = {"normal_force": np.column_stack(normal), "sliding": np.column_stack(sliding)}
            channels |= guide_channels(model, guide.body, rubbed)
    return channels, all_stored, all_lost
