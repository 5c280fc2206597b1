"""The motion of a body as seen from what guides it: in the drawing, which turns with that."""

from collections.abc import Mapping, Sequence

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import GROUND, Body, Guide, Point
from exu_press.numerics.arrays import Array

__all__ = ["guide_direction", "guide_path", "motion_in_guide", "pose_in_guide"]


def pose_in_guide(mechanism: Mechanism, guide: Guide, bodies: Sequence[str], poses: Array) -> Array:
    """Return the pose (n, 3) of a guided body in a drawing that moves with its guide.

    Args:
        mechanism: with the guide.
        guide: of the body.
        bodies: names.
        poses: of these bodies, (n, bodies, 3).
    """
    pose = poses[:, bodies.index(guide.body)]
    if guide.on == GROUND:
        return pose
    return _pose_on(mechanism.body(guide.on), pose, poses[:, bodies.index(guide.on)])


def _pose_on(base: Body, pose: Array, base_pose: Array) -> Array:
    """Return a pose in a drawing that moves with another body."""
    turned = base_pose[:, 2] - base.angle
    arm = _turn(pose[:, :2] - base_pose[:, :2], -turned)
    return np.column_stack([arm + np.array(base.centre_of_mass), pose[:, 2] - turned])


def motion_in_guide(
    mechanism: Mechanism, guide: Guide, motions: Mapping[str, Motion]
) -> tuple[Array, Array]:
    """Return pose and velocity, (n, 3) each, of a guided body in a drawing that moves with it."""
    body = motions[guide.body]
    if guide.on == GROUND:
        return body.position, body.velocity
    base = motions[guide.on]
    pose = _pose_on(mechanism.body(guide.on), body.position, base.position)
    arm, omega = body.position[:, :2] - base.position[:, :2], base.velocity[:, 2]
    rate = body.velocity[:, :2] - base.velocity[:, :2]
    rate = rate - omega[:, None] * np.column_stack([-arm[:, 1], arm[:, 0]])
    turned = base.position[:, 2] - mechanism.body(guide.on).angle
    return pose, np.column_stack([_turn(rate, -turned), body.velocity[:, 2] - omega])


def guide_direction(
    mechanism: Mechanism, guide: Guide, direction: Point, motions: Mapping[str, Motion]
) -> Array:
    """Return a direction of the drawing, (n, 2), that turns with a guide."""
    angle = motions[guide.body].position[:, 2]
    vectors = np.tile(direction, (len(angle), 1))
    if guide.on == GROUND:
        return vectors
    base: Body = mechanism.body(guide.on)
    return _turn(vectors, motions[guide.on].position[:, 2] - base.angle)


def guide_path(mechanism: Mechanism, guide: Guide, angle: Array) -> Array:
    """Return the path (n, 2) of a guided body in a drawing that moves with its guide.

    A body whose crank does not turn stays where it is drawn.

    Args:
        mechanism: with the guide.
        guide: of the body.
        angle: (n,) crank angles from the drawing's, rad.
    """
    try:
        motions = mechanism.motion(angle, 1.0)
    except InputError:
        return np.array([mechanism.body(guide.body).centre_of_mass])
    return motion_in_guide(mechanism, guide, motions)[0][:, :2]


def _turn(vectors: Array, angle: Array) -> Array:
    """Return vectors (n, 2), turned counter-clockwise by angles (n,)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors.T
    return np.column_stack([c * x - s * y, s * x + c * y])
