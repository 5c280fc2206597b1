"""Derivatives of residuals by finite differences that evaluations with errors allow."""

from collections.abc import Callable

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["LARGEST", "STEP", "Evaluate", "Failed", "jacobian", "steps"]

Evaluate = Callable[[Array], Array]
"""From points (m, keys), each key scaled to 0 to 1 over its range, to residuals (m, numbers) in
units of their uncertainties; NaN in all of a row whose run failed."""

STEP = 0.02
"""Least step of a difference over a key's range."""

LARGEST = 0.25
"""Largest step over a key's range."""

VISIBLE = 10.0
"""Change of the residuals by a step over the part of evaluations' errors in them."""


class Failed(Exception):  # noqa: N818  a start that leads nowhere, no fault of the user
    """All runs on both sides of a point failed."""


def jacobian(evaluate: Evaluate, x: Array, residuals: Array, step: Array) -> Array:
    """Return the derivatives of residuals by scaled keys, (numbers, keys).

    Central differences of second order; one-sided ones of second order at a bound; of first order
    where a run fails.

    Args:
        evaluate: see Evaluate.
        x: point, (keys,).
        residuals: there, (numbers,).
        step: of each key, (keys,).

    Raises:
        Failed: the runs on both sides failed.
    """
    points, signs = [], []
    for k, h in enumerate(step):
        room = x[k] - h >= 0.0, x[k] + h <= 1.0
        pair = (-1.0, 1.0) if all(room) else (-1.0, -2.0) if room[0] else (1.0, 2.0)
        for sign in pair:
            point = x.copy()
            point[k] = min(max(x[k] + sign * h, 0.0), 1.0)
            points.append(point)
            signs.append(point[k] - x[k])
    values = evaluate(np.array(points))
    columns = []
    for k in range(len(x)):
        (d1, d2), (r1, r2) = signs[2 * k : 2 * k + 2], values[2 * k : 2 * k + 2]
        fine = [np.isfinite(r).all() for r in (r1, r2)]
        if all(fine):  # the parabola through three points
            slope = (d2**2 * (r1 - residuals) - d1**2 * (r2 - residuals)) / (d1 * d2 * (d2 - d1))
        elif fine[0]:
            slope = (r1 - residuals) / d1
        elif fine[1]:
            slope = (r2 - residuals) / d2
        else:
            raise Failed
        columns.append(slope)
    return np.column_stack(columns)


def steps(evaluate: Evaluate, x: Array, residuals: Array, errors: Array) -> Array:
    """Return for each key the step at which residuals change well beyond evaluations' errors.

    It is doubled from STEP until they do, up to LARGEST.

    Args:
        evaluate: see Evaluate.
        x: point, (keys,).
        residuals: there, (numbers,).
        errors: of evaluations, in the unit of residuals, (numbers,).
    """
    found = np.full(len(x), STEP)
    open_keys = list(range(len(x)))
    while open_keys:
        points = np.tile(x, (len(open_keys), 1))
        for row, k in enumerate(open_keys):
            points[row, k] += found[k] if x[k] + found[k] <= 1.0 else -found[k]
        changes = np.abs(evaluate(points) - residuals)
        still = []
        for k, change in zip(open_keys, changes, strict=True):
            seen = np.linalg.norm(change) >= VISIBLE * np.linalg.norm(errors)
            if not seen and np.isfinite(change).all() and 2.0 * found[k] <= LARGEST:
                found[k] *= 2.0
                still.append(k)
        open_keys = still
    return found
