"""The least sum of squares, from several starts or by differential evolution."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import differential_evolution, least_squares
from scipy.stats import qmc

from exu_press.numerics.arrays import Array
from exu_press.studies.fit.jacobian import Evaluate, EvaluationError, jacobian

__all__ = ["Minimum", "evolve", "search_minima", "select_starts"]

DISTINCT = 0.05
"""Scaled distance above which two minima are distinct."""

MOST_STEPS = 25
"""Evaluations of one search, less those of differences."""

CHANGE = 1e-4
"""Relative change of the sum of squares that ends a search."""

SHIFT = 1e-5
"""Shift over a key's range that ends a search."""


@dataclass(frozen=True)
class Minimum:
    """The end of a search for the least sum of squares.

    Attributes:
        x: scaled keys, (keys,).
        residuals: in units of their uncertainties, (numbers,).
        times: number of starts that ended there.
    """

    x: Array
    residuals: Array
    times: int = 1

    @property
    def chi_square(self) -> float:
        """Sum of squares."""
        return float(self.residuals @ self.residuals)


def select_starts(
    evaluate: Evaluate, keys: int, count: int, seed: int, start: Array | None = None
) -> list[Minimum]:
    """Return the best distinct points of a sample over the ranges, best first.

    Args:
        start: a point that is always among them, whatever its residuals.
    """
    number = 2 ** int(np.ceil(np.log2(4 * keys)))
    points = qmc.Sobol(keys, rng=seed).random(number)
    first = np.full(keys, 0.5) if start is None else start
    points = np.concatenate([first[None], points])
    values = evaluate(points)
    valid = [Minimum(x, r) for x, r in zip(points, values, strict=True) if np.isfinite(r).all()]
    starts = valid[:1] if start is not None and np.isfinite(values[0]).all() else []
    for candidate in sorted(valid, key=lambda m: m.chi_square):
        if len(starts) < count and all(_distance(candidate, s) > 4 * DISTINCT for s in starts):
            starts.append(candidate)
    return starts


def search_minima(
    evaluate: Evaluate, starts: list[Minimum], step: Array
) -> tuple[list[Minimum], int]:
    """Return the minima that starts lead to, best first, and the number of diverged starts.

    SciPy's least_squares with a trust region, within the ranges; a step to a run that fails makes
    the region smaller.

    Args:
        step: of the differences, (keys,).
    """
    minima: list[Minimum] = []
    diverged = 0
    for start in starts:
        try:
            minimum = _search(evaluate, start, step)
        except EvaluationError:
            diverged += 1
            continue
        for number, known in enumerate(minima):
            if _distance(minimum, known) <= DISTINCT:
                better = min(minimum, known, key=lambda m: m.chi_square)
                minima[number] = Minimum(better.x, better.residuals, known.times + 1)
                break
        else:
            minima.append(minimum)
    return sorted(minima, key=lambda m: m.chi_square), diverged


def _search(evaluate: Evaluate, start: Minimum, step: Array) -> Minimum:
    known = {start.x.tobytes(): start.residuals}

    def residuals(x: Array) -> Array:
        if x.tobytes() not in known:
            known[x.tobytes()] = evaluate(x[None])[0]
        return known[x.tobytes()]

    inside = np.clip(start.x, 1e-6, 1.0 - 1e-6)
    if not np.isfinite(residuals(inside)).all():
        raise EvaluationError
    result = least_squares(
        residuals,
        inside,
        jac=lambda x: jacobian(evaluate, x, residuals(x), step),
        bounds=(0.0, 1.0),
        ftol=CHANGE,
        xtol=SHIFT,
        gtol=1e-6,
        max_nfev=MOST_STEPS,
    )
    return Minimum(result.x, result.fun)


def evolve(evaluate: Evaluate, keys: int, generations: int, seed: int) -> Minimum | None:
    """Return the best point of differential evolution; None where all runs failed.

    For numbers too rough for differences. A failed run is worse than any other.
    """
    best: list[Minimum] = []

    def chi_squares(points: Array) -> Array:
        values = evaluate(points.T)
        sums = np.where(np.isfinite(values).all(axis=1), (values**2).sum(axis=1), np.inf)
        least = int(sums.argmin())
        if np.isfinite(sums[least]) and (not best or sums[least] < best[0].chi_square):
            best[:] = [Minimum(points.T[least].copy(), values[least])]
        return np.asarray(sums)

    differential_evolution(
        chi_squares,
        [(0.0, 1.0)] * keys,
        maxiter=generations,
        popsize=8,
        init="sobol",
        rng=seed,
        polish=False,
        vectorized=True,
        updating="deferred",
    )
    return best[0] if best else None


def _distance(a: Minimum, b: Minimum) -> float:
    return float(np.abs(a.x - b.x).max())
