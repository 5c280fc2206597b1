"""Optimisation of one objective within limits, by SciPy's solvers."""

from collections.abc import Callable

import numpy as np
from scipy.optimize import differential_evolution, minimize
from scipy.stats import qmc

from exu_press.numerics.arrays import Array

__all__ = ["Judge", "evolve", "merit", "simplex", "spread_points"]

Judge = Callable[[Array], Array]
"""From scaled points (m, keys) to their merits (m,), less is better: the objective within limits;
above all of these violations of limits, and infinity without numbers."""

BEYOND = 1e9
"""Penalty over the objective's scale: added to a violation, so that every point within limits is
better (K. Deb, Computer Methods in Applied Mechanics and Engineering 186 (2000) 311-338)."""

POPULATION = 6
"""Points of differential evolution over the number of keys."""

RESOLVED = 1e-3
"""Size over a key's range to which the simplex shrinks."""


def spread_points(keys: int, number: int, seed: int) -> Array:
    """Return points spread over the ranges, the middle first, (a power of two + 1, keys)."""
    power = max(2, int(np.log2(max(number, 4))))
    return np.concatenate([np.full((1, keys), 0.5), qmc.Sobol(keys, rng=seed).random(2**power)])


def merit(values: Array, violations: Array, scale: float) -> Array:
    """Return the numbers that a solver compares, (points,): the objective with its penalty.

    Args:
        values: of the objective, less is better; NaN without a number.
        violations: of limits, 0 within.
        scale: of the objective.
    """
    penalized = np.where(violations > 0.0, BEYOND * (1.0 + violations), values / scale)
    return np.where(np.isfinite(values), penalized, np.inf)


def simplex(judge: Judge, start: Array, trials: int) -> None:
    """Search downhill from a point by the simplex of Nelder and Mead, for smooth objectives.

    Args:
        judge: see Judge; it stores its points.
        start: scaled, within the limits if such a point is known.
    """
    corners = np.tile(start, (len(start) + 1, 1))
    for key in range(len(start)):
        corners[key + 1, key] += 0.15 if start[key] < 0.5 else -0.15
    judge(corners)  # together, where the solver would evaluate one by one
    minimize(
        lambda x: float(judge(x[None])[0]),
        start,
        method="Nelder-Mead",
        bounds=[(0.0, 1.0)] * len(start),
        options={"initial_simplex": corners, "maxfev": trials, "xatol": RESOLVED, "fatol": 1e-6},
    )


def evolve(judge: Judge, keys: int, trials: int, seed: int) -> None:
    """Search by differential evolution, for rough objectives.

    Args:
        judge: see Judge; it stores its points.
        trials: approximate limit.
    """
    size = max(POPULATION * keys, 5)
    differential_evolution(
        lambda points: judge(points.T),
        [(0.0, 1.0)] * keys,
        maxiter=max(trials // size - 1, 1),
        popsize=POPULATION,
        init="sobol",
        rng=seed,
        polish=False,
        vectorized=True,
        updating="deferred",
        tol=1e-3,
    )
