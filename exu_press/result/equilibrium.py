"""Forces of ideal guides and pivots, by the equilibrium of their bodies.

Such a body has one coordinate (`exu_press.model.rigid_body`), so that no constraint has the force.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import Point
from exu_press.mechanism.guide_motion import guide_direction
from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result import ideal_joints
from exu_press.result.channel import Channel, guide_channel
from exu_press.result.guides import guide_channels
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.joints.history import JointHistory

__all__ = ["record"]

JointOnBody = tuple[str, float, Point]
"""Name of a joint on a body, sign of its force there, and its point in the body's frame."""


def record(run: Recording) -> Record:
    """Return force and moment of ideal guides, and the pivots' forces on the journals.

    The loads and all joints that hold a coordinate or have clearance have their channels.
    """
    model, motions, channels, histories = run.model, run.motions, run.so_far.channels, run.histories
    reactions: dict[str, Channel] = {}
    masses = {body.name: body.mass for body in model.mechanism.bodies}

    on_body: dict[str, list[JointOnBody]] = {name: [] for name in masses}
    for joint in model.mechanism.joints:
        for sign, (name, point) in zip((1.0, -1.0), model.mechanism.ends(joint), strict=True):
            if name in on_body and f"{joint.name}_force" in channels:
                on_body[name].append((joint.name, sign, point))

    actions = {name: _guide_actions(run, name) for name in masses}

    def constraint_force(name: str) -> Array:
        """Return the reaction to all forces on a body, (n, 2)."""
        reaction = _force(model, name, on_body[name], channels) + actions[name][:, :2]
        for column, weight in enumerate((0.0, -masses[name] * model.scene.gravity)):
            inertia = masses[name] * motions[name].acceleration[:, column]
            reaction[:, column] = inertia - reaction[:, column] - weight
        return reaction

    for name in sorted(model.constraints.sliding_bodies):
        guide = model.mechanism.frame_guide(name)
        assert guide is not None
        across = constraint_force(name) @ np.array(guide.normal)
        angle = motions[name].position[:, 2]
        moment = -_moment(model, name, on_body[name], angle, channels, histories)
        moment -= actions[name][:, 2]
        reactions |= guide_channels(model.mechanism, guide.name, force=across, moment=moment)
    for name, pivot in model.constraints.pivots.items():
        if name in model.rigid:
            force = constraint_force(name) * (1.0 if pivot.journal == name else -1.0)
            reactions |= ideal_joints.CHANNELS.record(
                pivot.name, force=ideal_joints.vectors(force, pivot.spherical)
            )
    return Record(reactions)


def _guide_actions(run: Recording, name: str) -> Array:
    """Return force, N, and moment about its centre, N m, of moving guides on a body, (n, 3)."""
    mechanism, motions = run.model.mechanism, run.motions
    action = np.zeros((len(run.time), 3))
    for guide in mechanism.guides:
        channel = guide_channel(mechanism, guide.name)
        if guide.is_rail or name not in guide.bodies or f"{channel}_force" not in run:
            continue
        normal = guide_direction(mechanism, guide, guide.normal, motions)
        force = run[f"{channel}_force"][:, None] * normal
        end = motions[guide.body].point_motion(mechanism.guided_end(guide)[1])
        arm = end.position[:, :2] - motions[name].position[:, :2]
        moment = arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
        if f"{channel}_moment" in run:
            moment += run[f"{channel}_moment"]
        action += (1.0 if name == guide.body else -1.0) * np.column_stack([force, moment])
    return action


def _force(
    model: Model, name: str, joints: Sequence[JointOnBody], channels: Mapping[str, Channel]
) -> Array:
    """Return the force of joints, loads and springs on a body, (n, 2)."""
    force = np.zeros((len(channels["time"].values), 2))
    for joint, sign, _ in joints:
        force += sign * channels[f"{joint}_force"].values[:, :2]
    for key, acting in model.loads.items():
        load = acting.applied
        if load.body == name:
            force += np.outer(channels[f"load_{key}_force"].values, load.direction)
    for spring_force, _ in _spring_forces(model, name, channels):
        force += spring_force
    return force


def _moment(
    model: Model,
    name: str,
    joints: Sequence[JointOnBody],
    angle: Array,
    channels: Mapping[str, Channel],
    histories: "Mapping[str, JointHistory]",
) -> Array:
    """Return the moment of joints, loads and springs about a body's centre at angles (n,)."""
    cos, sin = np.cos(angle), np.sin(angle)
    moment = np.zeros(len(angle))
    for joint, sign, (x, y) in joints:
        on_body = sign * channels[f"{joint}_force"].values
        moment += (x * cos - y * sin) * on_body[:, 1] - (x * sin + y * cos) * on_body[:, 0]
        if joint in histories:
            moment += histories[joint].moments_in_plane[:, 0 if sign > 0.0 else 1]
    for key, acting in model.loads.items():
        load = acting.applied
        if load.body == name:
            moment += load.moment(channels[f"load_{key}_force"].values, angle)
    for force, (x, y) in _spring_forces(model, name, channels):
        moment += (x * cos - y * sin) * force[:, 1] - (x * sin + y * cos) * force[:, 0]
    return moment


def _spring_forces(
    model: Model, name: str, channels: Mapping[str, Channel]
) -> Iterator[tuple[Array, Point]]:
    """Yield the forces of springs on a body, (n, 2), and their points in its frame."""
    if not model.mechanism.springs:
        return
    from exu_press.mechanism.spring_motion import spring_ends
    from exu_press.result.springs import force_on_second_end

    for spring in model.mechanism.springs:
        ends = spring_ends(model.mechanism, spring)
        for sign, (body, point) in zip((-1.0, 1.0), ends, strict=True):
            if body == name:
                yield sign * force_on_second_end(model, spring.name, channels), point
