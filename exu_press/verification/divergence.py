"""Divergence of a run and others beside it, in joints and guides with clearance."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities.kind import ROUNDING
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
        nearest: error up to the horizon over the difference from the nearest refinement, where only
            this one still follows the run then; else 0, as all of them tell it.
        distances: the largest ones from the refinements, in clearances; none without clearances.
    """

    growth: Growth
    nearest: float
    distances: Mapping[float, float]


def divergence(result: Result, others: Mapping[float, Result]) -> Divergence:
    """Return how fast a run parts from the truth, in clearances, and from when on it has diverged.

    Errors go with the tolerance until motions have diverged: a run at half of it is half of the way
    from the run to the truth. The largest estimate of all refinements counts, as one may be beside
    the run by chance. Where only the nearest one still follows the run, the distance from the truth
    is as many times the distance from it as before, or as one difference tells if that is more.

    Args:
        result: whose instants count.
        others: at other tolerances or steps, by their ratio to the run's; the nearest one is first.
    """
    distances = {ratio: _distance(result, other) for ratio, other in others.items()}
    (ratio, near), *coarser = distances.items()
    share = min(abs(1.0 - ratio), 1.0)
    error = near / share
    alone = 0  # from this step on
    for other, distance in coarser:
        follows = int(np.searchsorted(distance, APART))
        error[:follows] = np.maximum(error[:follows], distance[:follows] / abs(1.0 - other))
        alone = max(alone, follows)
    times = of_one(ratio) if ratio < 1.0 else 1.0 / share
    if alone:
        times = max(times, error[alone - 1] / max(near[alone - 1], ROUNDING))
        error[alone:] = times * near[alone:]
    found = growth(result.time, error, APART)
    end = result.time[-1] if found.horizon is None else found.horizon
    only = 0 < alone <= np.searchsorted(result.time, end)
    largest = {ratio: float(distance[-1]) for ratio, distance in distances.items() if distance[-1]}
    return Divergence(found, float(times) if only else 0.0, largest)


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
            beside = position[:, :2] @ np.array(guide.normal)
            angle = position[:, 2] - mechanism.body(guide.body).angle
            reach = 0.5 * guide.guideway.length * np.sin(angle)
            yield guide.guideway.clearance, np.stack([beside - reach, beside + reach], axis=1)
