"""Identifiability: covariance, and keys or combinations that a measurement does not determine."""

from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from exu_press.numerics.arrays import Array

__all__ = ["Determined", "Direction", "determined"]

HALF_RANGE = 0.5
"""An interval that reaches further to each side, of a key's range, tells nothing."""

PART = 0.2
"""A key has a part in a direction where its component is larger."""


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
        """Return the keys that have a part in it, the largest first."""
        return [int(k) for k in np.argsort(-np.abs(self.vector)) if abs(self.vector[k]) > PART]


@dataclass(frozen=True)
class Determined:
    """Identifiability by the scaled Jacobian at the best point.

    Attributes:
        singular: its singular values, (keys,).
        open: directions that the measurement does not determine.
        deviation: standard deviation of each scaled key, (keys,); infinite with a part in an
            open direction.
        correlation: of keys, (keys, keys); NaN where one has a part in an open direction.
    """

    singular: Array
    open: list[Direction]
    deviation: Array
    correlation: Array

    @property
    def rank(self) -> int:
        """Number of combinations of keys that the measurement determines."""
        return len(self.singular) - len(self.open)


def determined(jacobian: Array, level: float) -> Determined:
    """Return the identifiability by a Jacobian (numbers, keys), over uncertainties and ranges."""
    keys = jacobian.shape[1]
    _, singular, vectors = np.linalg.svd(jacobian)
    singular = np.concatenate([singular, np.zeros(keys - len(singular))])
    least = norm.ppf((1.0 + level) / 2.0) / HALF_RANGE
    shut = singular > least
    open_ = [Direction(v, float(s)) for v, s in zip(vectors[~shut], singular[~shut], strict=True)]
    covariance = (vectors[shut].T / singular[shut] ** 2) @ vectors[shut]
    deviation = np.sqrt(np.diag(covariance))
    for direction in open_:
        deviation[direction.keys] = np.inf
    with np.errstate(divide="ignore", invalid="ignore"):
        correlation = covariance / np.outer(deviation, deviation)
    known = np.isfinite(deviation)
    correlation[~np.outer(known, known)] = np.nan
    return Determined(singular, open_, deviation, correlation)
