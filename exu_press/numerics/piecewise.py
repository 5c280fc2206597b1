"""Piecewise polynomials, without SciPy, whose import takes longer than a short run.

A cubic is c[0] + c[1] u + c[2] u^2 + c[3] u^3 between two neighbours of x, u from the left one.
"""

from typing import Literal

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["eno_cubic", "evaluate", "hermite", "integral", "spline"]

VARIES = 0.75
"""Change of second differences over the sum of its neighbours: 0.5 where a curve is smooth, 1 at an
event."""


def hermite(x: Array, values: Array, slopes: Array) -> Array:
    """Return the coefficients (4, ..., n - 1) that meet values and slopes (..., n) at x (n,)."""
    step = np.diff(x)
    chord = np.diff(values) / step
    left_slope, right_slope = slopes[..., :-1], slopes[..., 1:]
    square = (3.0 * chord - 2.0 * left_slope - right_slope) / step
    return np.stack(
        [values[..., :-1], left_slope, square, (left_slope + right_slope - 2.0 * chord) / step**2]
    )


def eno_cubic(x: Array, values: Array) -> Array:
    """Return coefficients (4, n - 1) of essentially non-oscillatory polynomials, n at least 4.

    Cubics through the four samples about each step where second differences change evenly. About a
    corner or a jump the parabola with the smaller curvature of those at the two ends, straight
    where these differ in sign: across a jump, without overshoot (A. Harten, S. Osher, SIAM J.
    Numer. Anal. 24 (1987) 279-309, eq. 3.4).

    >>> x = np.array([0.0, 1.0, 3.0, 4.0, 5.0])
    >>> values = evaluate(x, eno_cubic(x, x**3), 2.0), evaluate(x, eno_cubic(x, x > 1.0), 2.0)
    >>> [float(value.round(12)) for value in values]
    [8.0, 0.5]
    """
    step, values = np.diff(x), np.asarray(values, dtype=float)
    chord = np.diff(values) / step
    second = np.diff(chord) / (x[2:] - x[:-2])  # divided differences, (n - 2,)
    change = np.abs(np.diff(second))
    about = np.pad(change, 1, mode="edge")
    even = np.pad(change <= VARIES * (about[:-2] + about[2:]), 2, mode="edge")
    smooth = even[:-2] & even[1:-1] & even[2:]
    cube = np.pad(np.diff(second) / (x[3:] - x[:-3]), 1, mode="edge") * smooth
    rear, front = np.append(0.0, second), np.append(second, 0.0)
    smaller = np.where(np.abs(rear) < np.abs(front), rear, front) * (rear * front > 0.0)
    square = np.where(smooth, rear + cube * np.append(0.0, step[:-1]), smaller)
    if smooth[0]:
        square[0] = second[0] - cube[0] * (x[2] - x[0])
    # chord + u (u - h) (square + cube u), u from the left end of a step of length h
    return np.stack([values[:-1], chord - square * step, square - cube * step, cube])


def spline(
    x: Array, values: Array, ends: Literal["clamped", "natural", "not-a-knot"] = "not-a-knot"
) -> Array:
    """Return the coefficients (4, ..., n - 1) of the cubic spline through values (..., n).

    Args:
        x: (n,), increasing; four at least.
        values: at x, along the last axis.
        ends: there the slope is zero, or the curvature, or the outer two polynomials are one.
    """
    step = np.diff(x)
    chord = np.diff(values) / step
    inner = np.arange(1, len(x) - 1)
    matrix, right = np.zeros((len(x), len(x))), np.zeros(values.shape)
    matrix[inner, inner - 1] = 1.0 / step[:-1]  # the curvature has no jumps
    matrix[inner, inner] = 2.0 / step[:-1] + 2.0 / step[1:]
    matrix[inner, inner + 1] = 1.0 / step[1:]
    right[..., 1:-1] = 3.0 * (chord[..., :-1] / step[:-1] + chord[..., 1:] / step[1:])
    for end, (a, b, c), near, next_one in ((0, (0, 1, 2), 0, 1), (-1, (-1, -2, -3), -1, -2)):
        if ends == "clamped":
            matrix[end, a] = 1.0
        elif ends == "natural":
            matrix[end, [a, b]] = 2.0, 1.0
            right[..., end] = 3.0 * chord[..., near]
        else:
            outer_weight, inner_weight = step[near] ** -2, step[next_one] ** -2
            matrix[end, [a, b, c]] = outer_weight, outer_weight - inner_weight, -inner_weight
            right[..., end] = 2.0 * (
                outer_weight * chord[..., near] - inner_weight * chord[..., next_one]
            )
    slopes = np.asarray(np.linalg.solve(matrix, right.reshape(-1, len(x)).T).T, float)
    return hermite(x, values, slopes.reshape(values.shape))


def evaluate(x: Array, coefficients: Array, at: Array | float, derivative: int = 0) -> Array:
    """Return values of a piecewise cubic, beyond its ends those of the outer polynomials.

    Args:
        x: (n,), increasing.
        coefficients: (4, ..., n - 1).
        at: points (m,), or one point.
        derivative: 0, or 1 for the slopes.

    Returns:
        (..., m), or (...) at one point.
    """
    interval = np.searchsorted(x, at, side="right") - 1
    interval = np.minimum(np.maximum(interval, 0), len(x) - 2)
    u = at - x[interval]
    c0, c1, c2, c3 = (c[..., interval] for c in coefficients)
    if derivative:
        return np.asarray((3.0 * c3 * u + 2.0 * c2) * u + c1)
    return np.asarray(((c3 * u + c2) * u + c1) * u + c0)


def integral(x: Array, values: Array) -> Array:
    """Return the integral (n,) from x[0] to each x (n,), straight between the values (n,)."""
    running_sum, steps = np.zeros(len(x)), np.diff(x)
    steps *= 0.5
    steps *= values[1:] + values[:-1]
    np.cumsum(steps, out=running_sum[1:])
    return running_sum
