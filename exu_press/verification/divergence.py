"""Divergence of a run and others beside it, in joints and guides with clearance."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.result import Result
from exu_press.scene import mechanism_of
from exu_press.verification.estimate import of_one
from exu_press.verification.growth import Growth, growth

__all__ = ["Divergence", "divergence"]

APART = 0.3
"""Part of a clearance: journals that differ by this have nothing in common any more."""


@dataclass(frozen=True)
class Divergence:
    """How a run parts from the truth, and from its refinements.

    Attributes:
        growth: of the distance from the truth.
        alone: whether only the nearest refinement still followed the run up to the horizon.
        distances: the largest ones from the refinements, in clearances; none without clearances.
    """

    growth: Growth
    alone: bool
    distances: Mapping[float, float]


def divergence(result: Result, others: Mapping[float, Result]) -> Divergence:
    """Return how fast a run parts from the truth, in clearances, and from when on it has diverged.

    The nearest one is none: at half the tolerance it is half of the way from the run to the truth,
    as errors go with the tolerance until motions have diverged. Where the coarser ones have, this
    distance is the only one, which may be small by chance.

    Args:
        result: whose instants count.
        others: at other tolerances or steps, by their ratio to the run's; the nearest one is first.
    """
    distances = {ratio: _distance(result, other) for ratio, other in others.items()}
    nearest, *coarser = distances
    share = min(abs(1.0 - nearest), 1.0)
    apart = np.full_like(result.time, APART)
    if coarser and nearest < 1.0:
        alone = np.max([distances[ratio] for ratio in coarser], axis=0) >= APART
        apart[alone] = APART / (share * of_one(nearest))
    found = growth(result.time, distances[nearest] / share, apart)
    known = len(apart) if found.horizon is None else np.searchsorted(result.time, found.horizon)
    largest = {ratio: float(distance[-1]) for ratio, distance in distances.items() if distance[-1]}
    return Divergence(found, bool(np.any(apart[: known + 1] < APART)), largest)


def _distance(result: Result, other: Result) -> Array:
    """Return the largest distance so far of two runs, in clearances."""
    distance = np.zeros_like(result.time)
    for (clearance, here), (_, there) in zip(_plays(result), _plays(other), strict=True):
        squares = [
            (np.interp(result.time, other.time, there[:, i]) - here[:, i]) ** 2
            for i in range(here.shape[1])
        ]
        distance = np.maximum(distance, np.sqrt(np.sum(squares, axis=0)) / clearance)
    return np.maximum.accumulate(distance)


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
