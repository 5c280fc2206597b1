"""Divergence of a run and one beside it, in joints and guides with clearance."""

from collections.abc import Iterator

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.result import Result
from exu_press.scene import mechanism_of
from exu_press.verification.growth import Growth, growth

__all__ = ["divergence"]

APART = 0.3
"""Of a clearance: journals that differ by this have nothing in common any more."""


def divergence(result: Result, other: Result, ratio: float) -> Growth:
    """Return how fast a run parts from the truth, in clearances, and from when on it has diverged.

    The other run is none: at half the tolerance it is half of the way from the run to the truth, as
    errors go with the tolerance until motions have diverged.

    Args:
        result: whose instants count.
        other: at another tolerance or step.
        ratio: of the other one's tolerance or step to the run's.
    """
    distance = np.zeros_like(result.time)
    for (clearance, here), (_, there) in zip(_plays(result), _plays(other), strict=True):
        squares = [
            (np.interp(result.time, other.time, there[:, i]) - here[:, i]) ** 2
            for i in range(here.shape[1])
        ]
        distance = np.maximum(distance, np.sqrt(np.sum(squares, axis=0)) / clearance)
    return growth(result.time, distance / min(abs(1.0 - ratio), 1.0), APART)


def _plays(run: Result) -> Iterator[tuple[float, Array]]:
    """Yield each clearance, m, and where in it the body is, (n, k), m."""
    for name in run.clearance_joints:
        yield run.joints[name].clearance, run[f"{name}_eccentricity"]
    mechanism = mechanism_of(run.scene)
    for guide in mechanism.guides:
        if guide.guideway is not None:
            position = run["body_position"][:, run.bodies.index(guide.body)]
            beside = position[:, :2] @ np.array(guide.across)
            angle = position[:, 2] - mechanism.body(guide.body).angle
            reach = 0.5 * guide.guideway.length * np.sin(angle)
            yield guide.guideway.clearance, np.stack([beside - reach, beside + reach], axis=1)
