"""Peak accelerations by three observation models of the same curve.

An impact lasts about 75 us, so that the peak that is read depends on who looks: the integrator, a
program that prints one value a millisecond, or an instrument that differentiates a displacement.
"""

import math
from collections.abc import Iterator

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import evaluate, hermite, integral

__all__ = ["differentiated_peak", "mean_peak", "mean_peak_of", "peak"]

AT_ONCE = 200_000
"""Instants whose windows are looked at together: the arrays take ten times their memory.
"""

MOST_SAMPLES = 10_000_000
"""Most samples of a displacement; they take 80 MB a copy."""

ON_A_SAMPLE = 1e-6
"""Part of the interval within which a record begins or ends on a sample, as instants are rounded.
"""


def peak(values: Array) -> float:
    """Return the largest magnitude."""
    return float(np.max(np.abs(values)))


def mean_peak(time: Array, velocity: Array, window: float = 1e-3) -> float | None:
    """Return the largest magnitude of the acceleration averaged over a moving window, m/s^2.

    Args:
        time: (n,), s, increasing.
        velocity: (n,), m/s, straight between.
        window: s.

    Returns:
        None where the record is shorter than the window.
    """

    def largest(part: slice) -> float:
        _, change = _windows(time[part], velocity[part], window)
        return peak(change / window)  # between them the mean is linear in time

    return max(map(largest, _parts(time, window)), default=None)


def mean_peak_of(time: Array, values: Array, window: float = 1e-3) -> float | None:
    """Return the largest magnitude of a load averaged over a moving window, in its unit.

    Steps may be longer than the window.

    Args:
        time: (n,), s, increasing.
        values: (n,), straight between.
        window: s.

    Returns:
        None where the record is shorter than the window.
    """
    parts = _parts(time, window)
    return max((_mean_peak_of(time[part], values[part], window) for part in parts), default=None)


def _mean_peak_of(time: Array, values: Array, window: float) -> float:
    """Return the same of a record that is not shorter than the window."""
    late, change = _windows(time, values, window)
    turns = np.flatnonzero(change[:-1] * change[1:] < 0.0)  # there the mean is largest or least
    part = change[turns] / (change[turns] - change[turns + 1])
    late = np.concatenate([late, late[turns] + part * np.diff(late)[turns]])
    parabolas = hermite(time, integral(time, values), values)
    sums = evaluate(time, parabolas, late) - evaluate(time, parabolas, late - window)
    return peak(sums / window)


def _parts(time: Array, window: float) -> Iterator[slice]:
    """Yield parts of a record in which every window lies in one; none if it is shorter than it."""
    for first in range(0, len(time), AT_ONCE):
        begin = int(np.searchsorted(time, time[max(first - 1, 0)] - window, side="right")) - 1
        part = slice(max(begin, 0), first + AT_ONCE)
        if time[part][-1] - time[part][0] >= window:
            yield part


def _windows(time: Array, values: Array, window: float) -> tuple[Array, Array]:
    """Return when windows end that begin or end at a step, increasing, and the change over each.

    There are none in a record that is shorter than the window.
    """
    ends = np.sort(np.concatenate([time, time + window]), kind="stable")  # merges the two
    ends = ends[(ends >= time[0] + window) & (ends <= time[-1])]
    late = ends[np.diff(ends, prepend=-np.inf) > 0.0]
    return late, np.interp(late, time, values) - np.interp(late - window, time, values)


def differentiated_peak(
    time: Array, position: Array, velocity: Array, rate: float = 1e3
) -> float | None:
    """Return the largest second difference of the displacement sampled at a rate, m/s^2.

    Samples are at multiples of the interval, in every part of a record and in every run alike: an
    impact reads half or all of itself, depending on where it falls between them.

    Args:
        time: (n,), s, increasing.
        position: (n,), m; interpolated between steps by cubic Hermite polynomials.
        velocity: (n,), m/s.
        rate: samples per second.

    Returns:
        None where the record holds fewer than three samples, or more than MOST_SAMPLES.
    """
    first = math.ceil(time[0] * rate - ON_A_SAMPLE)
    last = math.floor(time[-1] * rate + ON_A_SAMPLE)
    if not 3 <= last - first + 1 <= MOST_SAMPLES:
        return None
    instants = np.arange(first, last + 1) / rate
    samples = evaluate(time, hermite(time, position, velocity), instants)
    return peak(np.diff(samples, 2) * rate**2)
