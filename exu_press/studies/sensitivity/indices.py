"""Sobol indices with bootstrap intervals, from an evaluation that may fail at some points."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.stats import DegenerateDataWarning, bootstrap, qmc

from exu_press.numerics.arrays import Array

__all__ = ["MOST_DRAWN", "Indices", "Sample", "indices", "sample"]

MOST_DRAWN = 2
"""Largest number of drawn samples over that of valid ones, where runs fail."""

RESAMPLES = 999


@dataclass(frozen=True)
class Sample:
    """Values of s quantities at n base samples over k keys (Saltelli's design).

    Attributes:
        shares: of the two independent samples, (2, n, k), each between 0 and 1.
        a, b: values there, (s, n).
        ab: values with one key of a from b, (k, s, n).
        drawn: number of drawn base samples; more than n where runs failed.
    """

    shares: Array
    a: Array
    b: Array
    ab: Array
    drawn: int

    @property
    def values(self) -> Array:
        """The quantities over the keys' distributions, (s, 2 n)."""
        return np.concatenate([self.a, self.b], axis=1)


@dataclass(frozen=True)
class Indices:
    """Shares of one quantity's variance by key, (k,), each with the bounds of its interval (k, 2).

    Attributes:
        first: share of a key alone.
        total: share of a key with all its interactions.
    """

    first: Array
    first_bounds: Array
    total: Array
    total_bounds: Array


ALONE = Indices(np.ones(1), np.ones((1, 2)), np.ones(1), np.ones((1, 2)))
"""Indices of one key alone, which explains everything."""


def sample(evaluate: Callable[[Array], Array], keys: int, n: int, seed: int) -> Sample | None:
    """Return the values at n base samples; None where too few of twice as many give numbers.

    The next base sample of the sequence replaces one with a failed run.

    Args:
        evaluate: from shares (m, keys) to values (m, s); NaN in all of a row that failed.
        n: a power of two.
        seed: of the Sobol' sequence's scrambling.

    Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270.
    """
    sequence = qmc.Sobol(2 * keys, rng=seed)
    valid: list[Array] = []
    points: list[Array] = []
    drawn = 0
    while len(valid) < n and drawn < MOST_DRAWN * n:
        count = n if drawn == 0 else min(n - len(valid), MOST_DRAWN * n - drawn)
        pairs = sequence.random(count).reshape(count, 2, keys)
        drawn += count
        first, second = pairs[:, :1], pairs[:, 1:]
        mixed = np.where(np.eye(keys, dtype=bool), second, first)  # each key of b in turn
        design = np.concatenate([pairs, mixed], axis=1)  # (count, keys + 2, keys)
        values = evaluate(design.reshape(-1, keys)).reshape(count, keys + 2, -1)
        is_valid = np.isfinite(values).all(axis=(1, 2))
        valid += list(values[is_valid])
        points += list(pairs[is_valid])
    if len(valid) < n:
        return None
    a, b, *ab = np.array(valid).transpose(1, 2, 0)
    return Sample(np.array(points).swapaxes(0, 1), a, b, np.array(ab), drawn)


def indices(values: Sample, level: float = 0.95) -> list[Indices | None]:
    """Return the indices of each quantity; None of a constant one."""
    by_quantity: list[Indices | None] = []
    for a, b, ab in zip(values.a, values.b, values.ab.swapaxes(0, 1), strict=True):
        both = np.concatenate([a, b])
        if np.ptp(both) <= 1e-12 * np.abs(both).max():
            by_quantity.append(None)
            continue
        if len(ab) == 1:
            by_quantity.append(ALONE)
            continue
        centred = a - both.mean(), b - both.mean(), ab - both.mean()
        with warnings.catch_warnings(), np.errstate(invalid="ignore"):
            warnings.simplefilter("ignore", DegenerateDataWarning)
            resampled = bootstrap(
                [np.arange(len(a))],
                lambda n, centred=centred: _estimates(*(values[..., n] for values in centred)),
                confidence_level=level, n_resamples=RESAMPLES, vectorized=False, rng=0,
            )  # fmt: skip
        first, total = _estimates(*centred)
        bounds = np.stack(resampled.confidence_interval, axis=-1)
        ends = np.array([0.5 - 0.5 * level, 0.5 + 0.5 * level])
        quantiles = np.quantile(resampled.bootstrap_distribution, ends, axis=-1)
        uncorrected = np.moveaxis(quantiles, 0, -1)
        bounds = np.where(np.isnan(bounds), uncorrected, bounds)  # of a key without any effect
        by_quantity.append(Indices(first, bounds[0], total, bounds[1]))
    return by_quantity


def _estimates(a: Array, b: Array, ab: Array) -> Array:
    """Return first and total indices, (2, k), from values (n,), (n,), (k, n) about their mean.

    As `scipy.stats.sobol_indices`, whose own bootstrap takes no seed.

    Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270, table 2.
    """
    first = np.mean(b * (ab - a), axis=-1)
    total = 0.5 * np.mean((a - ab) ** 2, axis=-1)
    variance = np.var([a, b])  # 0 where a resample is constant
    return np.asarray(np.array([first, total]) / variance) if variance else np.zeros((2, len(ab)))
