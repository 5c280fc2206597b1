"""The motion of a body as seen from its guide or slot: in a drawing that moves with that.

A circular slot is unrolled: there the pin moves along the tangent of the drawing.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import GROUND, Guide, Point
from exu_press.numerics.arrays import Array

__all__ = ["guide_direction", "guide_path", "motion_in_guide", "pose_in_guide"]


def pose_in_guide(mechanism: Mechanism, guide: Guide, bodies: Sequence[str], poses: Array) -> Array:
    """Return the pose (n, 3) of a guided body, at its pin or centre, in its guide's drawing.

    Args:
        mechanism: with the guide.
        guide: of the body.
        bodies: names.
        poses: of these bodies, (n, bodies, 3).
    """
    still = np.zeros_like(poses[:, 0])
    motions = {
        name: Motion(poses[:, bodies.index(name)], still, still) for name in guide.bodies - {GROUND}
    }
    return motion_in_guide(mechanism, guide, motions)[0]


def motion_in_guide(
    mechanism: Mechanism, guide: Guide, motions: Mapping[str, Motion]
) -> tuple[Array, Array]:
    """Return pose and velocity, (n, 3) each, of a guided body, at its pin or centre, there.

    Args:
        mechanism: with the guide.
        guide: of the body.
        motions: name of a body -> its motion (x, y, angle).
    """
    position, velocity = _on_base(mechanism, guide, motions)
    radius = guide.radius
    if radius is None:
        return position, velocity
    arm = position[:, :2] - np.array(guide.centre)
    distance = np.linalg.norm(arm, axis=1)
    drawn = math.atan2(guide.normal[1], guide.normal[0])
    turned = np.unwrap(np.arctan2(arm[:, 1], arm[:, 0])) - drawn
    turned -= 2.0 * np.pi * np.round(turned[:1] / (2.0 * np.pi))
    outwards = (arm * velocity[:, :2]).sum(axis=1) / distance
    around = (arm[:, 0] * velocity[:, 1] - arm[:, 1] * velocity[:, 0]) / distance
    along = np.outer(radius * turned, guide.direction) + np.outer(distance - radius, guide.normal)
    rate = np.outer(around, guide.direction) + np.outer(outwards, guide.normal)
    return (
        np.column_stack([along + np.array(guide.at), position[:, 2]]),
        np.column_stack([rate, velocity[:, 2]]),
    )


def _on_base(
    mechanism: Mechanism, guide: Guide, motions: Mapping[str, Motion]
) -> tuple[Array, Array]:
    """Return pose and velocity of a guided body's pin or centre in a drawing that moves."""
    name, point = mechanism.guided_end(guide)
    body = motions[name] if point == (0.0, 0.0) else motions[name].point_motion(point)
    if guide.on == GROUND:
        return body.position, body.velocity
    base, drawn = motions[guide.on], mechanism.body(guide.on)
    arm, omega = body.position[:, :2] - base.position[:, :2], base.velocity[:, 2]
    rate = body.velocity[:, :2] - base.velocity[:, :2]
    rate = rate - omega[:, None] * np.column_stack([-arm[:, 1], arm[:, 0]])
    turned = base.position[:, 2] - drawn.angle
    position = _turn(arm, -turned) + np.array(drawn.centre_of_mass)
    return (
        np.column_stack([position, body.position[:, 2] - turned]),
        np.column_stack([_turn(rate, -turned), body.velocity[:, 2] - omega]),
    )


def guide_direction(
    mechanism: Mechanism, guide: Guide, direction: Point, motions: Mapping[str, Motion]
) -> Array:
    """Return a direction of the drawing at a guide, (n, 2), which turns with it."""
    turned = np.zeros(len(motions[guide.body].position))
    if guide.on != GROUND:
        turned = motions[guide.on].position[:, 2] - mechanism.body(guide.on).angle
    if guide.radius is not None:
        along = motion_in_guide(mechanism, guide, motions)[0][:, :2] - np.array(guide.at)
        turned = turned + along @ np.array(guide.direction) / guide.radius
    return _turn(np.tile(direction, (len(turned), 1)), turned)


def guide_path(mechanism: Mechanism, guide: Guide, angle: Array) -> Array:
    """Return the path (n, 2) of a guided body's pin or centre in the drawing of its guide.

    A body whose crank does not turn stays where it is drawn.

    Args:
        mechanism: with the guide.
        guide: of the body.
        angle: (n,) crank angles from the drawing's, rad.
    """
    try:
        motions = mechanism.motion(angle, 1.0)
    except InputError:
        return np.array([mechanism.guided_point(guide)])
    return _on_base(mechanism, guide, motions)[0][:, :2]


def _turn(vectors: Array, angle: Array) -> Array:
    """Return vectors (n, 2), turned counter-clockwise by angles (n,)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors.T
    return np.column_stack([c * x - s * y, s * x + c * y])
