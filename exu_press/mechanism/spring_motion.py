"""Motion of springs with the bodies that they join."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.guide_motion import Drawing
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import GROUND, PRECISION, Joint, Point
from exu_press.mechanism.springs import SpringBetween
from exu_press.numerics.arrays import Array

__all__ = ["SpringMotion", "impossible_spring", "joint_at", "spring_ends", "spring_motion"]

REFINEMENTS = 4
"""Newton's iterations from half a degree to the crank angle of an extreme length."""


@dataclass(frozen=True)
class SpringMotion:
    """Motion of a spring over n instants.

    Attributes:
        ends: from the first end to the second, (n, 2), m.
        velocity: its rate, (n, 2), m/s.
        acceleration: the rate of that, (n, 2), m/s^2.
    """

    ends: Array
    velocity: Array
    acceleration: Array

    @property
    def length(self) -> Array:
        """Distance of its ends, (n,), m."""
        return np.asarray(np.hypot(*self.ends.T))

    @property
    def direction(self) -> Array:
        """Unit vector from the first end to the second, (n, 2)."""
        return self.ends / self.length[:, None]

    @property
    def rate(self) -> Array:
        """Rate of the length, (n,), m/s."""
        return np.asarray((self.direction * self.velocity).sum(axis=1))


def spring_ends(mechanism: Drawing, spring: SpringBetween) -> list[tuple[str, Point]]:
    """Return (body, point in its frame) of both ends of a spring."""
    return [
        (name, at if name == GROUND else mechanism.body(name).local(at))
        for name, at in zip(spring.between, spring.at, strict=True)
    ]


def spring_motion(
    mechanism: Drawing, spring: SpringBetween, motions: Mapping[str, Motion]
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


def joint_at(mechanism: Drawing, body: str, at: Point) -> Joint | None:
    """Return a body's joint at a point of the drawing, None where there is none."""
    close = PRECISION * mechanism.size
    joints = mechanism.joints_of(body)
    return next((joint for joint in joints if math.dist(joint.at, at) <= close), None)


def impossible_spring(mechanism: Drawing) -> tuple[SpringBetween, float, str] | None:
    """Return a spring, a crank angle, rad, and why the spring cannot be there; None without one.

    The extreme lengths over a revolution of the ideal mechanism decide.
    """
    for spring in mechanism.springs:
        angles = np.linspace(0.0, 2.0 * np.pi, 721)
        lengths = spring_motion(mechanism, spring, mechanism.motion(angles, 1.0)).length
        for extreme in (lengths.argmin(), lengths.argmax()):
            angle = float(angles[extreme])
            for _ in range(REFINEMENTS):
                motion = spring_motion(mechanism, spring, mechanism.motion(np.array([angle]), 1.0))
                slope = float((motion.ends * motion.velocity).sum())
                curvature = float((motion.velocity**2 + motion.ends * motion.acceleration).sum())
                if abs(slope) < np.radians(0.5) * abs(curvature):
                    angle -= slope / curvature
            length = float(motion.length[0])
            length = length if length > 1e-9 * mechanism.size else 0.0
            if reason := spring.why_impossible(length):
                return spring, angle % (2.0 * np.pi), reason
    return None
