"""Divergence of a run from its refinement runs, in joints and guides with clearance."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.guide_motion import pose_in_guide
from exu_press.numerics.arrays import Array
from exu_press.quantities.kind import ROUNDING
from exu_press.result import Result
from exu_press.scene import mechanism_of
from exu_press.verification.estimate import single_difference_factor
from exu_press.verification.growth import Growth, growth

__all__ = ["Divergence", "divergence"]

DIVERGED = 0.3
"""Distance, in clearances, from which on two motions are independent."""


@dataclass(frozen=True)
class Divergence:
    """Divergence of a run from the exact motion, and from its refinements.

    Attributes:
        growth: of the distance from the exact motion.
        nearest: error up to the horizon over the difference from the nearest refinement, where only
            that one still follows the run; else 0.
        distances: largest ones from the refinements, over that from the exact motion, which is a
            clearance at most; none without clearances.
    """

    growth: Growth
    nearest: float
    distances: Mapping[float, float]


def divergence(result: Result, refinements: Mapping[float, Result]) -> Divergence:
    """Return how fast a run diverges from the exact motion, in clearances, and from when on.

    The largest estimate of all refinements counts, as one may agree by chance. Where only the
    nearest one still follows the run, its distance keeps the factor that it had, or
    `single_difference_factor` if that is larger.

    Args:
        result: of the run; its instants count.
        refinements: ratio of errors to the run's, see `error_ratio` -> run, the nearest one first.
    """
    distances = {ratio: _distance(result, run) for ratio, run in refinements.items()}
    (ratio, nearest), *coarser_runs = distances.items()
    share = min(abs(1.0 - ratio), 1.0)
    error = nearest / share
    only_nearest = 0  # from this step on
    for coarser_ratio, distance in coarser_runs:
        follows = int(np.searchsorted(distance, DIVERGED))
        coarser_share = abs(1.0 - coarser_ratio)
        error[:follows] = np.maximum(error[:follows], distance[:follows] / coarser_share)
        only_nearest = max(only_nearest, follows)
    factor = single_difference_factor(ratio) if ratio < 1.0 else 1.0 / share
    if only_nearest:
        factor = max(factor, error[only_nearest - 1] / max(nearest[only_nearest - 1], ROUNDING))
        error[only_nearest:] = factor * nearest[only_nearest:]
    error_growth = growth(result.time, error, DIVERGED)
    end = result.time[-1] if error_growth.horizon is None else error_growth.horizon
    follows_to_end = 0 < only_nearest <= np.searchsorted(result.time, end)
    whole = min(max(float(error[-1]), ROUNDING), 1.0)
    largest = {r: float(distance[-1]) / whole for r, distance in distances.items() if distance[-1]}
    return Divergence(error_growth, float(factor) if follows_to_end else 0.0, largest)


def _distance(result: Result, refinement: Result) -> Array:
    """Return the largest distance so far of two runs, in clearances."""
    distance = np.zeros_like(result.time)
    for (clearance, position), (_, refined) in zip(
        _clearance_positions(result), _clearance_positions(refinement), strict=True
    ):
        squares = [
            (np.interp(result.time, refinement.time, refined[:, i]) - position[:, i]) ** 2
            for i in range(position.shape[1])
        ]
        distance = np.maximum(distance, np.sqrt(np.sum(squares, axis=0)) / clearance)
    return np.maximum.accumulate(distance)


def _clearance_positions(run: Result) -> Iterator[tuple[float, Array]]:
    """Yield each clearance, m, and the body's positions in it, (n, k), m."""
    for name in run.clearance_joints:
        yield run.joints[name].clearance, run[f"{name}_eccentricity"]
    mechanism = mechanism_of(run.scene)
    for guide in mechanism.guides:
        if guide.guideway is not None:
            position = pose_in_guide(mechanism, guide, run.bodies, run["body_position"])
            lateral = position[:, :2] @ np.array(guide.normal)
            angle = position[:, 2] - mechanism.body(guide.body).angle
            reach = 0.5 * guide.guideway.length * np.sin(angle)
            yield guide.guideway.clearance, np.stack([lateral - reach, lateral + reach], axis=1)
