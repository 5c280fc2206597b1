"""The least sum of squares, from several starts or by differential evolution."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import differential_evolution, least_squares
from scipy.stats import qmc

from exu_press.numerics.arrays import Array
from exu_press.studies.fit.jacobian import Evaluate, Failed, jacobian

__all__ = ["Minimum", "evolved", "screened", "searched"]

ALIKE = 0.05
"""Scaled distance below which two minima are one."""

MOST_STEPS = 25
CHANGE = 1e-4
"""Change of the sum of squares below which a further step does not matter, relative."""

SHIFT = 1e-5
"""Shift over a key's range, likewise."""


@dataclass(frozen=True)
class Minimum:
    """The end of a search.

    Attributes:
        x: scaled keys, (keys,).
        residuals: there, in units of their uncertainties, (numbers,).
        times: how many starts ended there.
    """

    x: Array
    residuals: Array
    times: int = 1

    @property
    def chi_square(self) -> float:
        """Sum of squares."""
        return float(self.residuals @ self.residuals)


def screened(
    evaluate: Evaluate, keys: int, wanted: int, seed: int, start: Array | None = None
) -> list[Minimum]:
    """Return the best of points spread over the ranges, apart from each other, best first.

    Args:
        evaluate: see Evaluate.
        keys: number of them.
        wanted: how many.
        seed: of the spread points.
        start: a point that is always among them, whatever its residuals.
    """
    number = 2 ** int(np.ceil(np.log2(4 * keys)))
    points = qmc.Sobol(keys, rng=seed).random(number)
    first = np.full(keys, 0.5) if start is None else start
    points = np.concatenate([first[None], points])
    values = evaluate(points)
    fine = [Minimum(x, r) for x, r in zip(points, values, strict=True) if np.isfinite(r).all()]
    found = fine[:1] if start is not None and np.isfinite(values[0]).all() else []
    for one in sorted(fine, key=lambda m: m.chi_square):
        if len(found) < wanted and all(_apart(one, other, 4 * ALIKE) for other in found):
            found.append(one)
    return found


def searched(
    evaluate: Evaluate, starts: list[Minimum], step: Array, most: int = MOST_STEPS
) -> tuple[list[Minimum], int]:
    """Return the minima that starts lead to, best first, and how many starts led nowhere.

    SciPy's least_squares with a trust region, within the ranges; a step to a run that fails makes
    the region smaller.

    Args:
        evaluate: see Evaluate.
        starts: from where.
        step: of the differences, (keys,).
        most: evaluations of one search, less those of differences.
    """
    found: list[Minimum] = []
    lost = 0
    for start in starts:
        try:
            one = _search(evaluate, start, step, most)
        except Failed:
            lost += 1
            continue
        for place, other in enumerate(found):
            if not _apart(one, other, ALIKE):
                better = min(one, other, key=lambda m: m.chi_square)
                found[place] = Minimum(better.x, better.residuals, other.times + 1)
                break
        else:
            found.append(one)
    return sorted(found, key=lambda m: m.chi_square), lost


def _search(evaluate: Evaluate, start: Minimum, step: Array, most: int) -> Minimum:
    known = {start.x.tobytes(): start.residuals}

    def residuals(x: Array) -> Array:
        if x.tobytes() not in known:
            known[x.tobytes()] = evaluate(x[None])[0]
        return known[x.tobytes()]

    inside = np.clip(start.x, 1e-6, 1.0 - 1e-6)
    if not np.isfinite(residuals(inside)).all():
        raise Failed
    result = least_squares(
        residuals,
        inside,
        jac=lambda x: jacobian(evaluate, x, residuals(x), step),
        bounds=(0.0, 1.0),
        ftol=CHANGE,
        xtol=SHIFT,
        gtol=1e-6,
        max_nfev=most,
    )
    return Minimum(result.x, result.fun)


def evolved(evaluate: Evaluate, keys: int, generations: int, seed: int) -> Minimum | None:
    """Return the best point of differential evolution; None where all runs failed.

    For numbers that are so rough that differences say nothing. A failed run is worse than any.
    """
    best: list[Minimum] = []

    def chi_squares(points: Array) -> Array:
        values = evaluate(points.T)
        sums = np.where(np.isfinite(values).all(axis=1), (values**2).sum(axis=1), np.inf)
        place = int(sums.argmin())
        if np.isfinite(sums[place]) and (not best or sums[place] < best[0].chi_square):
            best[:] = [Minimum(points.T[place].copy(), values[place])]
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


def _apart(one: Minimum, other: Minimum, distance: float) -> bool:
    return float(np.abs(one.x - other.x).max()) > distance
