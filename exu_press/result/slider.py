"""Channels of time, crank, slider and all bodies, and the energy of the rigid ones."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from exu_press.mechanism import Motion
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Declaration, Declarations, direction_text
from exu_press.result.energy import mechanical_energy
from exu_press.result.recording import Record, Recording

__all__ = ["CHANNELS", "record"]

CHANNELS = Declarations(
    Declaration("time", "s", "time"),
    Declaration("crank_angle", "rad", "crank angle from the mechanism's zero"),
    Declaration("slider_position", "m", "slider position, {positive}"),
    Declaration("slider_velocity", "m/s", "slider velocity, {positive}"),
    Declaration("slider_acceleration", "m/s^2", "slider acceleration, {positive}"),
    Declaration("slider_lateral", "m", "slider beside its guide, {positive}"),
    Declaration("slider_tilt", "rad", "slider tilt, counter-clockwise"),
    Declaration("body_position", "m, rad", "centres of mass and angles", "pose"),
)

AT_ONCE = 2048
"""Instants."""


def record(run: Recording) -> Record:
    """Return the motion of crank, slider and bodies, and the mechanical energy of rigid bodies."""
    mechanism = run.model.mechanism
    slider, crank = run.motions[mechanism.slider], run.motions[mechanism.crank]
    output = mechanism.output
    rigid = [body for body in mechanism.bodies if body.name not in run.model.parts]
    channels = CHANNELS.record(
        time=run.time,
        crank_angle=crank.position[:, 2] - mechanism.body(mechanism.crank).angle,
        slider_tilt=slider.position[:, 2] - mechanism.body(mechanism.slider).angle,
        body_position=_poses(run.motions),
    )
    motion = CHANNELS.record(
        positive="counter-clockwise" if output.rotation else direction_text(output.direction),
        slider_position=mechanism.output_position(slider.position),
        slider_velocity=mechanism.output_component(slider.velocity),
        slider_acceleration=mechanism.output_component(slider.acceleration),
    )
    if output.rotation:
        motion = {
            name: replace(channel, unit=channel.unit.replace("m", output.unit, 1))
            for name, channel in motion.items()
        }
    channels |= motion | CHANNELS.record(
        positive=direction_text(output.normal),
        slider_lateral=mechanism.lateral_displacement(slider.position),
    )
    return Record(channels, stored=mechanical_energy(rigid, run.motions, run.model.scene.gravity))


def _poses(motions: Mapping[str, Motion]) -> Array:
    """Return the poses of bodies, (n, bodies, 3), part by part: each stays near the processor."""
    positions = [motion.position for motion in motions.values()]
    poses = np.empty((len(positions[0]), len(positions), 3))
    for first in range(0, len(poses), AT_ONCE):
        block = slice(first, first + AT_ONCE)
        for index, position in enumerate(positions):
            poses[block, index] = position[block]
    return poses
