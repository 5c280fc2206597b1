"""Identifiability of keys: covariance, and combinations that a measurement does not determine."""

from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from exu_press.numerics.arrays import Array

__all__ = ["Direction", "Identifiability", "identifiability"]

HALF_RANGE = 0.5
"""Half-width of an interval over the key's range, above which the key is not determined."""

LEAST_COMPONENT = 0.2
"""Component of a key in a direction, above which the key belongs to it."""


@dataclass(frozen=True)
class Direction:
    """A direction in scaled keys along which the measured numbers do not change visibly.

    Attributes:
        vector: of unit length, (keys,).
        singular: change of all residuals by a step of one range along it.
    """

    vector: Array
    singular: float

    @property
    def keys(self) -> list[int]:
        """Numbers of the keys that belong to it, the largest component first."""
        return [
            int(k)
            for k in np.argsort(-np.abs(self.vector))
            if abs(self.vector[k]) > LEAST_COMPONENT
        ]


@dataclass(frozen=True)
class Identifiability:
    """Identifiability of keys by the scaled Jacobian at the best point.

    Attributes:
        singular: its singular values, (keys,).
        open: directions that the measurement does not determine.
        deviation: standard deviation of each scaled key, (keys,); infinite in an open direction.
        correlation: of keys, (keys, keys); NaN with a key in an open direction.
    """

    singular: Array
    open: list[Direction]
    deviation: Array
    correlation: Array

    @property
    def rank(self) -> int:
        """Number of combinations of keys that the measurement determines."""
        return len(self.singular) - len(self.open)


def identifiability(jacobian: Array, level: float) -> Identifiability:
    """Return the identifiability by a Jacobian (numbers, keys) over uncertainties and ranges."""
    keys = jacobian.shape[1]
    _, singular, vectors = np.linalg.svd(jacobian)
    singular = np.concatenate([singular, np.zeros(keys - len(singular))])
    least = norm.ppf((1.0 + level) / 2.0) / HALF_RANGE
    is_open = singular <= least
    open_directions = [
        Direction(vector, float(value))
        for vector, value in zip(vectors[is_open], singular[is_open], strict=True)
    ]
    closed = vectors[~is_open]
    covariance = (closed.T / singular[~is_open] ** 2) @ closed
    deviation = np.sqrt(np.diag(covariance))
    for direction in open_directions:
        deviation[direction.keys] = np.inf
    with np.errstate(divide="ignore", invalid="ignore"):
        correlation = covariance / np.outer(deviation, deviation)
    known = np.isfinite(deviation)
    correlation[~np.outer(known, known)] = np.nan
    return Identifiability(singular, open_directions, deviation, correlation)
