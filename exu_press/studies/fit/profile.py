"""Confidence intervals by profile likelihood: the other keys are fitted again at each value."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear
from scipy.stats import chi2

from exu_press.numerics.arrays import Array
from exu_press.studies.fit.jacobian import Evaluate
from exu_press.studies.fit.minimum import Minimum

__all__ = ["Interval", "between", "profile"]

NEAR = 0.03
"""Error in the root of the rise of chi-square at which an end is found, relative."""

GAIN = 0.02
"""Fall of chi-square that a further fit of the other keys would have to promise."""

BETTER = 0.05
"""By which a chi-square is below the minimum's where the search had not ended there."""

DENSE = 200
"""Values of the key of a curve between the points of a profile."""

MOST_ENDS = 8
MOST_FITS = 6
REACH = 0.25
"""Largest step of the other keys over their range."""


@dataclass(frozen=True)
class Interval:
    """The profile of one scaled key.

    Attributes:
        low, high: ends.
        low_open, high_open: an end is the range's own: beyond it, chi-square may be as good.
        points: value of the key and chi-square above the minimum's, increasing, (points, 2).
        better: a point with a lower chi-square than the minimum's, if one was met.
    """

    low: float
    high: float
    low_open: bool
    high_open: bool
    points: Array
    better: Minimum | None = None


def between(points: Array, best: float, most: float) -> tuple[Array, Array]:
    """Return values of the key between a profile's points, (n,), and chi-square's rise there, (n,).

    The rise is a parabola where the model is linear: its root is interpolated.

    Args:
        points: see Interval.
        best: value of the key at the minimum.
        most: rise up to which they go.

    >>> points = np.array([[0.0, 36.0], [3.0, 0.0], [4.0, 4.0]])
    >>> values, rises = between(points, 3.0, 16.0)
    >>> [round(float(x), 3) for x in (values[0], values[-1], np.interp(2.5, values, rises))]
    [1.0, 4.0, 1.0]
    """
    roots = np.sqrt(np.maximum(points[:, 1], 0.0)) * np.sign(points[:, 0] - best)
    rising = np.maximum.accumulate(roots)
    low, high = np.interp([-(most**0.5), most**0.5], rising, points[:, 0]).tolist()
    dense = np.linspace(low, high, DENSE)
    return dense, np.interp(dense, points[:, 0], roots) ** 2


def profile(evaluate: Evaluate, best: Minimum, jacobian: Array, key: int, level: float) -> Interval:
    """Return the interval of one key.

    Both ends are looked for by secants of the root of chi-square's rise, which is straight where
    the model is linear: two or three fits of the other keys a side.

    Args:
        evaluate: see Evaluate.
        best: the minimum.
        jacobian: there, (numbers, keys).
        key: its place.
        level: as 0.95.
    """
    rise = float(np.sqrt(chi2.ppf(level, 1)))
    points = [(float(best.x[key]), 0.0)]
    better: Minimum | None = None
    ends, is_open = [], []
    free = [k for k in range(len(best.x)) if k != key]
    slope = _slope(jacobian, key, free)
    for sign, bound in ((-1.0, 0.0), (1.0, 1.0)):
        room = abs(bound - best.x[key])
        inner, outer = (0.0, 0.0), None  # distance, root of the rise
        distance = min(rise / slope, room) if slope > 0.0 else room
        end, open_ = best.x[key] + sign * room, True
        for _ in range(MOST_ENDS):
            if distance <= 0.0:
                break
            fitted = _conditional(evaluate, best, jacobian, key, best.x[key] + sign * distance)
            if fitted is None:  # runs fail there: as if it could not be
                outer = distance, np.inf
                distance = 0.5 * (inner[0] + distance)
                continue
            above = fitted.chi_square - best.chi_square
            if above < -BETTER and (better is None or fitted.chi_square < better.chi_square):
                better = fitted
            root = float(np.sqrt(max(above, 0.0)))
            points.append((float(fitted.x[key]), above))
            if root >= rise * (1.0 - NEAR):
                open_, end = False, best.x[key] + sign * _between(inner, (distance, root), rise)
                if root <= rise * (1.0 + NEAR) or distance - inner[0] < 1e-4:
                    break
                outer = distance, root
            else:
                inner = distance, root
                if distance >= room:
                    open_, end = True, bound
                    break
            distance = _next(inner, outer, rise, room)
        ends.append(float(end))
        is_open.append(open_)
    table = np.array(sorted(points))
    return Interval(ends[0], ends[1], is_open[0], is_open[1], table, better)


def _slope(jacobian: Array, key: int, free: list[int]) -> float:
    """Return by how much the root of chi-square rises with a key, the others fitted (linear)."""
    column, others = jacobian[:, key], jacobian[:, free]
    if free:
        column = column - others @ np.linalg.lstsq(others, column, rcond=1e-10)[0]
    return float(np.linalg.norm(column))


def _between(inner: tuple[float, float], outer: tuple[float, float], rise: float) -> float:
    """Return the distance at which the root reaches the rise, on the straight line between."""
    (d1, r1), (d2, r2) = inner, outer
    return d1 + (d2 - d1) * min(1.0, (rise - r1) / (r2 - r1)) if r2 > r1 else d2


def _next(
    inner: tuple[float, float], outer: tuple[float, float] | None, rise: float, room: float
) -> float:
    """Return the distance to try next."""
    if outer is None:
        factor = min(3.0, 1.02 * rise / inner[1]) if inner[1] > 0.0 else 3.0
        return min(inner[0] * max(factor, 1.05), room)
    if not np.isfinite(outer[1]):
        return 0.5 * (inner[0] + outer[0])
    guess = _between(inner, outer, rise)
    part = 0.1 * (outer[0] - inner[0])
    return float(np.clip(guess, inner[0] + part, outer[0] - part))


def _conditional(
    evaluate: Evaluate, best: Minimum, jacobian: Array, key: int, value: float
) -> Minimum | None:
    """Return the best point with one key held; None where its first run fails.

    Gauss and Newton's steps within the ranges; the Jacobian is the minimum's, corrected by what
    each run shows (C. G. Broyden, Mathematics of Computation 19 (1965) 577-593).
    """
    free = [k for k in range(len(best.x)) if k != key]
    x, moved = best.x.copy(), value - best.x[key]
    x[key] = value
    derivative = jacobian.copy()
    if free:
        x[free] += _step(derivative[:, free], best.residuals + derivative[:, key] * moved, x[free])
    residuals = evaluate(x[None])[0]
    if not np.isfinite(residuals).all():
        return None
    derivative = _corrected(derivative, residuals - best.residuals, x - best.x)
    shrink = 1.0
    for _ in range(MOST_FITS if free else 0):
        step = np.zeros(len(x))
        step[free] = shrink * _step(derivative[:, free], residuals, x[free])
        promised = residuals + derivative @ step
        if residuals @ residuals - promised @ promised < GAIN:
            break
        tried = evaluate((x + step)[None])[0]
        if not np.isfinite(tried).all():
            shrink *= 0.5
            continue
        derivative = _corrected(derivative, tried - residuals, step)
        if tried @ tried < residuals @ residuals:
            x, residuals = x + step, tried
        else:
            shrink *= 0.5
    return Minimum(x, residuals)


def _step(derivative: Array, residuals: Array, x: Array) -> Array:
    """Return the step to the least sum of squares of the linear model, within the ranges."""
    low, high = np.maximum(-x, -REACH), np.minimum(1.0 - x, REACH)
    high = np.maximum(high, low + 1e-12)
    found = lsq_linear(derivative, -residuals, bounds=(low, high), method="bvls")
    step: Array = np.clip(found.x, -x, 1.0 - x)
    return step


def _corrected(derivative: Array, change: Array, step: Array) -> Array:
    size = float(step @ step)
    if size < 1e-16:
        return derivative
    correction = np.outer(change - derivative @ step, step) / size
    return np.asarray(derivative + correction, dtype=float)
