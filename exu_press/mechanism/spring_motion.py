"""Motion of springs with the bodies that they join."""

import math
from collections.abc import Mapping

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import GROUND, PRECISION, Joint, Point
from exu_press.mechanism.springs import SpringBetween
from exu_press.numerics.arrays import Array

__all__ = ["SpringMotion", "joint_at", "spring_ends", "spring_motion"]


class SpringMotion(Motion):
    """Motion of a spring's second end from its first, over n instants."""

    @property
    def length(self) -> Array:
        """Distance of its ends, (n,), m."""
        return np.asarray(np.hypot(*self.position.T))

    @property
    def direction(self) -> Array:
        """Unit vector from the first end to the second, (n, 2)."""
        return self.position / self.length[:, None]

    @property
    def rate(self) -> Array:
        """Rate of the length, (n,), m/s."""
        return np.asarray((self.direction * self.velocity).sum(axis=1))


def spring_ends(mechanism: Mechanism, spring: SpringBetween) -> list[tuple[str, Point]]:
    """Return (body, point in its frame) of both ends of a spring."""
    return [mechanism.end(*end) for end in zip(spring.between, spring.at, strict=True)]


def spring_motion(
    mechanism: Mechanism, spring: SpringBetween, motions: Mapping[str, Motion]
) -> SpringMotion:
    """Return the motion of a spring with that of the bodies."""
    count = len(next(iter(motions.values())).position)
    first, second = (
        Motion(np.tile(point, (count, 1)), *np.zeros((2, count, 2)))
        if name == GROUND
        else motions[name].point_motion(point)[:2]
        for name, point in spring_ends(mechanism, spring)
    )
    return SpringMotion(
        second.position - first.position,
        second.velocity - first.velocity,
        second.acceleration - first.acceleration,
    )


def joint_at(mechanism: Mechanism, body: str, at: Point) -> Joint | None:
    """Return a body's joint at a point of the drawing, None where there is none."""
    close = PRECISION * mechanism.size
    joints = mechanism.joints_of(body)
    return next((joint for joint in joints if math.dist(joint.at, at) <= close), None)
