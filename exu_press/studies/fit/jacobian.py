"""Derivatives of residuals by finite differences, with steps that evaluations with errors allow."""

from collections.abc import Callable

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["LARGEST", "STEP", "Evaluate", "EvaluationError", "jacobian", "steps"]

Evaluate = Callable[[Array], Array]
"""From points (m, keys), each key scaled to 0 to 1 over its range, to residuals (m, numbers) in
units of their uncertainties; NaN in all of a row whose run failed."""

STEP = 0.02
"""Least step of a difference over a key's range."""

LARGEST = 0.25
"""Largest step over a key's range."""

VISIBLE = 10.0
"""Change of the residuals by a step over their errors."""


class EvaluationError(Exception):
    """All runs on both sides of a point failed: a start without a minimum, no fault of the user."""


def jacobian(evaluate: Evaluate, x: Array, residuals: Array, step: Array) -> Array:
    """Return the derivatives of residuals by scaled keys, (numbers, keys).

    Central differences of second order; one-sided ones of second order at a bound; of first order
    where a run fails.

    Args:
        x: point, (keys,).
        residuals: there, (numbers,).
        step: of each key, (keys,).

    Raises:
        EvaluationError: the runs on both sides failed.
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
        is_finite = [np.isfinite(r).all() for r in (r1, r2)]
        if all(is_finite):  # the parabola through three points
            slope = (d2**2 * (r1 - residuals) - d1**2 * (r2 - residuals)) / (d1 * d2 * (d2 - d1))
        elif is_finite[0]:
            slope = (r1 - residuals) / d1
        elif is_finite[1]:
            slope = (r2 - residuals) / d2
        else:
            raise EvaluationError
        columns.append(slope)
    return np.column_stack(columns)


def steps(evaluate: Evaluate, x: Array, residuals: Array, errors: Array) -> Array:
    """Return the step of each key at which residuals change well beyond their errors.

    It is doubled from STEP on, up to LARGEST.

    Args:
        x: point, (keys,).
        residuals: there, (numbers,).
        errors: of evaluations, in the unit of residuals, (numbers,).
    """
    sizes = np.full(len(x), STEP)
    open_keys = list(range(len(x)))
    while open_keys:
        points = np.tile(x, (len(open_keys), 1))
        for row, k in enumerate(open_keys):
            points[row, k] += sizes[k] if x[k] + sizes[k] <= 1.0 else -sizes[k]
        changes = np.abs(evaluate(points) - residuals)
        enlarged = []
        for k, change in zip(open_keys, changes, strict=True):
            is_visible = np.linalg.norm(change) >= VISIBLE * np.linalg.norm(errors)
            if not is_visible and np.isfinite(change).all() and 2.0 * sizes[k] <= LARGEST:
                sizes[k] *= 2.0
                enlarged.append(k)
        open_keys = enlarged
    return sizes
