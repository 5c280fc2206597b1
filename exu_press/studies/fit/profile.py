"""Confidence intervals by profile likelihood: all further keys are fitted at each value of one."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, lsq_linear
from scipy.stats import chi2

from exu_press.numerics.arrays import Array
from exu_press.studies.fit.jacobian import Evaluate
from exu_press.studies.fit.minimum import Minimum

__all__ = ["OPEN", "End", "Interval", "interpolate_rise", "profile"]

OPEN, NOT_CONVERGED = "end of the range", "not converged"

BRACKET = 0.05
"""Largest distance of the values that bracket an end, over the outer one's from the best."""

GAIN = 0.02
"""Least expected fall of chi-square for a further fit of the free keys."""

BETTER = 0.05
"""Fall of chi-square below the minimum's, above which the search had not converged."""

DENSE = 200
"""Number of values of the key between the points of a profile."""

MOST_ENDS = 12
"""Most values on one side before the end is bracketed, and as many after."""

MOST_FITS = 6
REACH = 0.25
"""Largest step of the free keys over their range."""


@dataclass(frozen=True)
class End:
    """One end of an interval.

    Attributes:
        value: of the scaled key.
        remark: OPEN where it is the range's own end, beyond which chi-square may be as good;
            NOT_CONVERGED where no value outside the interval that runs is as near to one inside as
            BRACKET: the end is the nearest value outside then, or the range's own.
    """

    value: float
    remark: str = ""


@dataclass(frozen=True)
class Interval:
    """The profile of one scaled key.

    Attributes:
        low, high: ends.
        points: value of the key and chi-square above the minimum's, increasing, (points, 2).
        better: a point with a lower chi-square than the minimum's, if there is one.
    """

    low: End
    high: End
    points: Array
    better: Minimum | None = None


def interpolate_rise(points: Array, best: float, most: float) -> tuple[Array, Array]:
    """Return values of the key over a profile, (n,), and the rise of chi-square there, (n,).

    The rise is a parabola where the model is linear: its root is interpolated.

    Args:
        points: see Interval.
        best: value of the key at the minimum.
        most: largest rise.

    >>> points = np.array([[0.0, 36.0], [3.0, 0.0], [4.0, 4.0]])
    >>> values, rises = interpolate_rise(points, 3.0, 16.0)
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

    Each end is bracketed by values inside and outside: the root of chi-square's rise is straight
    where the model is linear.

    Args:
        best: the minimum.
        jacobian: there, (numbers, keys).
    """
    rise = float(np.sqrt(chi2.ppf(level, 1)))
    fits = [best]

    def root(value: float) -> float:
        """Return the root of chi-square's rise; infinite where runs fail."""
        fit = _conditional(evaluate, best, jacobian, key, value)
        if fit is None:
            return float("inf")
        fits.append(fit)
        return float(np.sqrt(max(fit.chi_square - best.chi_square, 0.0)))

    free = [k for k in range(len(best.x)) if k != key]
    slope = _slope(jacobian, key, free)
    first = rise / slope if slope > 0.0 else 1.0
    low, high = (_end(root, float(best.x[key]), bound, first, rise) for bound in (0.0, 1.0))
    points = sorted((float(fit.x[key]), fit.chi_square - best.chi_square) for fit in fits)
    lowest = min(fits, key=lambda fit: fit.chi_square)
    better = lowest if lowest.chi_square < best.chi_square - BETTER else None
    return Interval(low, high, np.array(points), better)


def _end(
    root: Callable[[float], float], best: float, bound: float, distance: float, rise: float
) -> End:
    """Return the end of an interval, where the root of chi-square's rise is `rise`.

    It is expected at a `distance` from the best value, and looked for up to the bound.
    """
    room = abs(bound - best)
    if room == 0.0:
        return End(bound, OPEN)
    sign = np.sign(bound - best)
    roots = {0.0: 0.0}

    def excess(distance: float) -> float:
        """Return the root less its value at the end, over it, at most 1."""
        if distance not in roots:
            value = bound if distance == room else best + sign * distance
            roots[distance] = root(float(value))
        return min(roots[distance] / rise - 1.0, 1.0)

    farthest = min(distance, room)
    while len(roots) <= MOST_ENDS and excess(farthest) < 0.0:
        if farthest == room:
            return End(bound, OPEN)
        expected = farthest * 1.02 * rise / max(roots[farthest], 1e-9)
        farthest = min(max(expected, 1.05 * farthest), 3.0 * farthest, room)
    if excess(farthest) < 0.0:
        return End(bound, NOT_CONVERGED)
    inside = max(d for d, r in roots.items() if r < rise)
    brentq(excess, inside, farthest, xtol=1e-12, rtol=BRACKET, maxiter=MOST_ENDS, disp=False)
    inner = max(d for d, r in roots.items() if r < rise)
    outer = min(d for d in roots if d > inner)
    if outer - inner > BRACKET * outer or np.isinf(roots[outer]):
        return End(float(best + sign * outer), NOT_CONVERGED)
    distance = float(np.interp(rise, [roots[inner], roots[outer]], [inner, outer]))
    return End(float(best + sign * distance))


def _slope(jacobian: Array, key: int, free: list[int]) -> float:
    """Return the slope of chi-square's root over a key, the free keys fitted (linear)."""
    column, columns = jacobian[:, key], jacobian[:, free]
    if free:
        column = column - columns @ np.linalg.lstsq(columns, column, rcond=1e-10)[0]
    return float(np.linalg.norm(column))


def _conditional(
    evaluate: Evaluate, best: Minimum, jacobian: Array, key: int, value: float
) -> Minimum | None:
    """Return the best point with one key fixed; None where its first run fails.

    Gauss-Newton steps within the ranges; the Jacobian is the minimum's, updated after each run
    (C. G. Broyden, Mathematics of Computation 19 (1965) 577-593).
    """
    free = [k for k in range(len(best.x)) if k != key]
    x, change = best.x.copy(), value - best.x[key]
    x[key] = value
    derivative = jacobian.copy()
    if free:
        x[free] += _step(derivative[:, free], best.residuals + derivative[:, key] * change, x[free])
    residuals = evaluate(x[None])[0]
    if not np.isfinite(residuals).all():
        return None
    derivative = _broyden_update(derivative, residuals - best.residuals, x - best.x)
    shrink = 1.0
    for _ in range(MOST_FITS if free else 0):
        step = np.zeros(len(x))
        step[free] = shrink * _step(derivative[:, free], residuals, x[free])
        expected = residuals + derivative @ step
        if residuals @ residuals - expected @ expected < GAIN:
            break
        trial = evaluate((x + step)[None])[0]
        if not np.isfinite(trial).all():
            shrink *= 0.5
            continue
        derivative = _broyden_update(derivative, trial - residuals, step)
        if trial @ trial < residuals @ residuals:
            x, residuals = x + step, trial
        else:
            shrink *= 0.5
    return Minimum(x, residuals)


def _step(derivative: Array, residuals: Array, x: Array) -> Array:
    """Return the step to the least sum of squares of the linear model, within the ranges."""
    low, high = np.maximum(-x, -REACH), np.minimum(1.0 - x, REACH)
    high = np.maximum(high, low + 1e-12)
    solution = lsq_linear(derivative, -residuals, bounds=(low, high), method="bvls")
    step: Array = np.clip(solution.x, -x, 1.0 - x)
    return step


def _broyden_update(derivative: Array, change: Array, step: Array) -> Array:
    size = float(step @ step)
    if size < 1e-16:
        return derivative
    correction = np.outer(change - derivative @ step, step) / size
    return np.asarray(derivative + correction, dtype=float)
