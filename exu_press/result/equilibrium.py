"""Forces of ideal guides and pivots, by the equilibrium of their bodies.

Such a body has one coordinate (`exu_press.model.rigid_body`), so that no constraint has the force.
"""

from collections.abc import Iterator

import numpy as np

from exu_press.mechanism import Point
from exu_press.mechanism.guide_motion import guide_direction
from exu_press.numerics.arrays import Array
from exu_press.result import ideal_joints
from exu_press.result.channel import Channel, guide_channel
from exu_press.result.guides import guide_channels
from exu_press.result.recording import Record, Recording

__all__ = ["record"]


def record(run: Recording) -> Record:
    """Return force and moment of ideal guides, and the pivots' forces on the journals.

    The loads and all joints that hold a coordinate or have clearance have their channels.
    """
    model = run.model
    reactions: dict[str, Channel] = {}
    for name in sorted(model.constraints.sliding_bodies):
        guide = model.mechanism.frame_guide(name)
        assert guide is not None
        reaction = _reaction(run, name)
        across = reaction[:, :2] @ np.array(guide.normal)
        moment = reaction[:, 2].copy()
        reactions |= guide_channels(model.mechanism, guide.name, force=across, moment=moment)
    for name, pivot in model.constraints.pivots.items():
        if name in model.rigid:
            force = _reaction(run, name)[:, :2] * (1.0 if pivot.journal == name else -1.0)
            reactions |= ideal_joints.CHANNELS.record(
                pivot.name, force=ideal_joints.vectors(force, pivot.spherical)
            )
    return Record(reactions)


def _reaction(run: Recording, name: str) -> Array:
    """Return what constraints exert on a body: force, and moment without inertia, (n, 3)."""
    mass, gravity = run.model.mechanism.body(name).mass, run.model.scene.gravity
    action = np.zeros((len(run.time), 3))
    for force, moment in _actions(run, name):
        action += np.column_stack([force, moment])
    action += _guide_actions(run, name)
    reaction = -action
    for column, weight in enumerate((0.0, -mass * gravity)):
        inertia = mass * run.motions[name].acceleration[:, column]
        reaction[:, column] = inertia - action[:, column] - weight
    return reaction


def _actions(run: Recording, name: str) -> Iterator[tuple[Array, Array]]:
    """Yield force, (n, 2), and moment about its centre, (n,), of all on a body but its guides."""
    model, mechanism = run.model, run.model.mechanism
    angle = run.motions[name].position[:, 2]
    cos, sin = np.cos(angle), np.sin(angle)

    def acting_at(point: Point, force: Array) -> tuple[Array, Array]:
        """Return a force at a point of the body's frame, and its moment."""
        x, y = point
        return force, (x * cos - y * sin) * force[:, 1] - (x * sin + y * cos) * force[:, 0]

    for joint in mechanism.joints:
        for sign, (body, point) in zip((1.0, -1.0), mechanism.ends(joint), strict=True):
            if body == name and f"{joint.name}_force" in run:
                force, moment = acting_at(point, sign * run[f"{joint.name}_force"][:, :2])
                if joint.name in run.histories:
                    of_journal_and_bearing = run.histories[joint.name].moments_in_plane
                    moment += of_journal_and_bearing[:, 0 if sign > 0.0 else 1]
                yield force, moment
    for key, acting in model.loads.items():
        load = acting.applied
        if load.body == name:
            size = run[f"load_{key}_force"]
            yield np.outer(size, load.direction), load.moment(size, angle)
    if mechanism.springs:
        from exu_press.mechanism.spring_motion import spring_ends
        from exu_press.result.gears_and_springs import force_on_second_end

        for spring in mechanism.springs:
            ends = spring_ends(mechanism, spring)
            for sign, (body, point) in zip((-1.0, 1.0), ends, strict=True):
                if body == name:
                    pushed = force_on_second_end(model, spring.name, run.so_far.channels)
                    yield acting_at(point, sign * pushed)


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
