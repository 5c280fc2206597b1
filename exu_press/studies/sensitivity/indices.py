"""Sobol indices with bootstrap intervals, from an evaluation that may fail at some points."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.stats import DegenerateDataWarning, bootstrap, qmc

from exu_press.numerics.arrays import Array

__all__ = ["MOST_DRAWN", "Indices", "Sample", "indices", "sample"]

MOST_DRAWN = 2
"""Times the samples wanted: so many are drawn at most where runs fail."""

RESAMPLES = 999


@dataclass(frozen=True)
class Sample:
    """Values of s quantities at n base samples over k keys (Saltelli's design).

    Attributes:
        shares: of the two independent samples, (2, n, k), each between 0 and 1.
        a, b: values there, (s, n).
        ab: values with one key of a from b, (k, s, n).
        drawn: base samples drawn; more than n where runs failed.
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
        first: share that a key explains alone.
        first_bounds: of it.
        total: share that it explains with all its interactions.
        total_bounds: of it.
    """

    first: Array
    first_bounds: Array
    total: Array
    total_bounds: Array


ALONE = Indices(np.ones(1), np.ones((1, 2)), np.ones(1), np.ones((1, 2)))
"""Indices of one key alone, which explains everything."""


def sample(evaluate: Callable[[Array], Array], keys: int, n: int, seed: int) -> Sample | None:
    """Return the values at n base samples; None where too few of twice as many give numbers.

    A base sample one of whose keys + 2 runs fails is left out, and the next one of the sequence is
    drawn for it.

    Args:
        evaluate: from shares (m, keys) to values (m, s); NaN in all of a row that failed.
        keys: number of them.
        n: a power of two.
        seed: of the Sobol' sequence's scrambling.

    Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270.
    """
    sequence = qmc.Sobol(2 * keys, rng=seed)
    kept: list[Array] = []
    points: list[Array] = []
    drawn = 0
    while len(kept) < n and drawn < MOST_DRAWN * n:
        wanted = n if drawn == 0 else min(n - len(kept), MOST_DRAWN * n - drawn)
        both = sequence.random(wanted).reshape(wanted, 2, keys)
        drawn += wanted
        design = np.array([_design(one[0], one[1]) for one in both])  # (wanted, keys + 2, keys)
        values = evaluate(design.reshape(-1, keys)).reshape(wanted, keys + 2, -1)
        whole = np.isfinite(values).all(axis=(1, 2))
        kept += list(values[whole])
        points += list(both[whole])
    if len(kept) < n:
        return None
    found = np.array(kept).transpose(1, 2, 0)
    return Sample(np.array(points).swapaxes(0, 1), found[0], found[1], found[2:], drawn)


def _design(a: Array, b: Array) -> Array:
    """Return a, b, and a with each key from b in turn, (keys + 2, keys)."""
    mixed = np.where(np.eye(len(a), dtype=bool), b, a)
    return np.concatenate([a[None], b[None], mixed])


def indices(found: Sample, level: float = 0.95) -> list[Indices | None]:
    """Return the indices of each quantity; None of one that does not move."""
    every: list[Indices | None] = []
    for place, (a, b) in enumerate(zip(found.a, found.b, strict=True)):
        both = np.concatenate([a, b])
        if np.ptp(both) <= 1e-12 * np.abs(both).max():
            every.append(None)
            continue
        ab = found.ab[:, place]
        if len(ab) == 1:
            every.append(ALONE)
            continue
        parts = a - both.mean(), b - both.mean(), ab - both.mean()
        with warnings.catch_warnings(), np.errstate(invalid="ignore"):
            warnings.simplefilter("ignore", DegenerateDataWarning)
            told = bootstrap(
                [np.arange(len(a))],
                lambda kept, parts=parts: _estimates(*(part[..., kept] for part in parts)),
                confidence_level=level, n_resamples=RESAMPLES, vectorized=False, rng=0,
            )  # fmt: skip
        first, total = _estimates(*parts)
        bounds = np.stack(told.confidence_interval, axis=-1)
        ends = np.array([0.5 - 0.5 * level, 0.5 + 0.5 * level])
        uncorrected = np.moveaxis(np.quantile(told.bootstrap_distribution, ends, axis=-1), 0, -1)
        bounds = np.where(np.isnan(bounds), uncorrected, bounds)  # of a key without any effect
        every.append(Indices(first, bounds[0], total, bounds[1]))
    return every


def _estimates(a: Array, b: Array, ab: Array) -> Array:
    """Return first and total indices, (2, k), from values (n,), (n,), (k, n) about their mean.

    These are those of `scipy.stats.sobol_indices`, whose own bootstrap takes no seed.

    Source: A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270, table 2.
    """
    first = np.mean(b * (ab - a), axis=-1)
    total = 0.5 * np.mean((a - ab) ** 2, axis=-1)
    variance = np.var([a, b])  # 0 where a resample leaves out what moves
    return np.asarray(np.array([first, total]) / variance) if variance else np.zeros((2, len(ab)))
