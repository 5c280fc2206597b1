"""Channels of time, crank, slider and all bodies, and the energy of the rigid ones."""

from collections.abc import Mapping

import numpy as np

from exu_press.mechanism import Motion
from exu_press.numerics.arrays import Array
from exu_press.result.channel import positive
from exu_press.result.declared import Declared
from exu_press.result.energy import mechanical_energy
from exu_press.result.recording import Record, Recording

__all__ = ["CHANNELS", "record"]

CHANNELS = (
    TIME,
    CRANK_ANGLE,
    POSITION,
    VELOCITY,
    ACCELERATION,
    LATERAL,
    TILT,
    POSES,
) = (
    Declared("time", "s", "time"),
    Declared("crank_angle", "rad", "crank angle from the mechanism's zero"),
    Declared("slider_position", "m", "slider position, {way}"),
    Declared("slider_velocity", "m/s", "slider velocity, {way}"),
    Declared("slider_acceleration", "m/s^2", "slider acceleration, {way}"),
    Declared("slider_lateral", "m", "slider beside its guide, {way}"),
    Declared("slider_tilt", "rad", "slider tilt, counter-clockwise"),
    Declared("body_position", "m, rad", "centres of mass and angles", "pose"),
)

AT_ONCE = 2048
"""Instants."""


def record(run: Recording) -> Record:
    """Return the motion of crank, slider and bodies, and the mechanical energy of rigid bodies."""
    mechanism = run.model.mechanism
    slider, crank = run.motions[mechanism.slider], run.motions[mechanism.crank]
    up, beside = positive(mechanism.output.direction), positive(mechanism.output.normal)
    tilt = slider.position[:, 2] - mechanism.body(mechanism.slider).angle
    rigid = [body for body in mechanism.bodies if body.name not in run.model.parts]
    return Record(
        channels=TIME.record(run.time)
        | CRANK_ANGLE.record(crank.position[:, 2] - mechanism.body(mechanism.crank).angle)
        | POSITION.record(mechanism.output_position(slider.position), way=up)
        | VELOCITY.record(mechanism.output_component(slider.velocity), way=up)
        | ACCELERATION.record(mechanism.output_component(slider.acceleration), way=up)
        | LATERAL.record(mechanism.lateral_displacement(slider.position), way=beside)
        | TILT.record(tilt)
        | POSES.record(_poses(run.motions)),
        stored=mechanical_energy(rigid, run.motions, run.model.scene.gravity),
    )


def _poses(motions: Mapping[str, Motion]) -> Array:
    """Return the poses of bodies, (n, bodies, 3), part by part: each stays near the processor."""
    positions = [motion.position for motion in motions.values()]
    poses = np.empty((len(positions[0]), len(positions), 3))
    for first in range(0, len(poses), AT_ONCE):
        part = slice(first, first + AT_ONCE)
        for index, position in enumerate(positions):
            poses[part, index] = position[part]
    return poses
