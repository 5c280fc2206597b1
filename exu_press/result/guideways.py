"""Channels of guideways with clearance: forces of both ends and of the film, energy, heat."""

import numpy as np

from exu_press.joints.history import history
from exu_press.mechanism.guide_motion import guide_direction
from exu_press.result.channel import Channel
from exu_press.result.guides import guide_channels
from exu_press.result.joints import stored_and_lost
from exu_press.result.recording import Record, Recording

__all__ = ["record"]


def record(run: Recording) -> Record:
    """Return the action of guideways on their bodies, their stored and their dissipated energy.

    The channels are force across and moment about the centre of mass of each guide, friction along
    it, its losses, and the least thickness of its film; sums of both ends and of the film.
    """
    model, time = run.model, run.time
    channels: dict[str, Channel] = {}
    all_stored, all_losses = np.zeros_like(time), np.zeros_like(time)
    wearing = model.scene.wearing["guides"]
    states = {
        f"{name} {n}": history(model.states, joint, time)
        for name, ends_of_guide in model.guideways.items()
        for n, joint in enumerate(ends_of_guide)
    }
    for guide in model.mechanism.guides:
        if guide.guideway is None:
            continue
        angle = run.motions[guide.body].position[:, 2]
        angle = angle - model.mechanism.body(guide.body).angle
        x, y = guide.direction
        force, moment, loss = np.zeros((len(time), 2)), np.zeros_like(time), np.zeros_like(time)
        normal = guide_direction(model.mechanism, guide, guide.normal, run.motions)
        direction = guide_direction(model.mechanism, guide, guide.direction, run.motions)
        for n, side in enumerate((0.0,) if guide.is_slot else (-1.0, 1.0)):
            end = states[f"{guide.name} {n}"]
            end_force = end.force[:, :2]
            reach = 0.5 * side * guide.guideway.length
            arm_x = reach * (np.cos(angle) * x - np.sin(angle) * y)
            arm_y = reach * (np.sin(angle) * x + np.cos(angle) * y)
            force += end_force
            moment += arm_x * end_force[:, 1] - arm_y * end_force[:, 0]
            moment += end.moments[:, 0]
            elastic, end_loss = stored_and_lost(end, time)
            loss += end_loss
            all_stored += elastic
        film = states.get(f"{guide.name} 2")
        if film is not None:
            force += film.force
            moment += film.moments.sum(axis=1)
            loss += stored_and_lost(film, time)[1]
            channels |= guide_channels(model.mechanism, guide.name, gap=film.gap)
        all_losses += loss
        across, along = (force * normal).sum(axis=1), (force * direction).sum(axis=1)
        channels |= guide_channels(
            model.mechanism, guide.name, force=across, moment=moment, friction=along, loss=loss
        )
        if guide.name in wearing:
            ends = [states[f"{guide.name} {n}"] for n in ((0,) if guide.is_slot else (0, 1))]
            on_right = [np.sign((end.eccentricity[:, :2] * normal).sum(axis=1)) for end in ends]
            normal_force = [s * end.rubbing[:, 0] for s, end in zip(on_right, ends, strict=True)]
            sliding = [end.rubbing[:, 1] for end in ends]
            names = ("wall_force", "pin_sliding") if guide.is_slot else ("normal_force", "sliding")
            pairs = (normal_force, sliding)
            values = (v[0] if guide.is_slot else np.column_stack(v) for v in pairs)
            channels |= guide_channels(
                model.mechanism, guide.name, **dict(zip(names, values, strict=True))
            )
    return Record(channels, all_stored, all_losses)
