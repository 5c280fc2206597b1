"""Peak accelerations by three observation models of the same curve.

An impact lasts about 75 us, so that the peak that is read depends on who looks: the integrator, a
program that prints one value a millisecond, or an instrument that differentiates a displacement.
"""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import evaluate, hermite, integral

__all__ = ["differentiated_peak", "mean_peak", "mean_peak_of", "peak"]

AT_ONCE = 200_000
"""Instants of a load that are summed up together."""

GROUP = 64
"""Steps whose windows are looked at together, or left out together."""

ROUNDED = 1e-6
"""Part by which a mean, the difference of two sums, may be above the load."""

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

    def largest(steps: slice) -> float:
        change = _change(_ends(time[steps], window), window, time[steps], velocity[steps])
        return peak(change / window)  # between them the mean is linear in time

    return max(map(largest, _blocks(time, window)), default=None)


def mean_peak_of(time: Array, values: Array, window: float = 1e-3) -> float | None:
    """Return the largest magnitude of a load averaged over a moving window, in its unit.

    Steps may be longer than the window.

    Returns:
        None where the record is shorter than the window.
    """
    blocks = _blocks(time, window)
    return max(
        (_mean_peak_of(time[steps], values[steps], window) for steps in blocks), default=None
    )


def _mean_peak_of(time: Array, values: Array, window: float) -> float:
    """Return the same of a record that is not shorter than the window.

    No mean is larger than the load is meanwhile. So where the load is largest one is looked for
    first, then where the load is larger than that.
    """
    values = np.ascontiguousarray(values)
    sums, sizes, last = integral(time, values), np.abs(values), len(time) - 1
    firsts = np.arange(0, last, GROUP)
    lasts = np.minimum(firsts + GROUP, last)
    begins = np.searchsorted(time, time[firsts] - window, side="right") - 2
    begins = np.maximum(begins, 0)  # of the windows that end from a group's first step to its last
    inner = np.maximum.reduceat(sizes, np.column_stack([begins, lasts]).ravel())[::2]
    bounds = (1.0 + ROUNDED) * np.maximum(inner, sizes[lasts])

    def largest(groups: NDArray[np.intp], least: float) -> float:
        begin, end = begins[groups[0]], lasts[groups[-1]] + 1
        late = _ends(time[begin:end], window)
        late = late[late >= time[firsts[groups[0]]]]
        steps = slice(begin, end + 1)  # a window's end belongs to the step behind it
        means = _means(late, window, time[steps], values[steps], sums[steps])
        return max(least, float(np.abs(means).max(initial=0.0)))

    largest_mean = largest(np.argmax(bounds, keepdims=True), 0.0)
    candidates = np.flatnonzero(bounds >= largest_mean)
    for groups in np.split(candidates, np.flatnonzero(np.diff(candidates) > 1) + 1):
        if len(groups):
            largest_mean = largest(groups, largest_mean)
    return largest_mean


def _means(ends: Array, window: float, time: Array, values: Array, sums: Array) -> Array:
    """Return the means of values (n,) over windows that end at (m,), s, and their extremes."""
    change = _change(ends, window, time, values)
    turns = np.flatnonzero(change[:-1] * change[1:] < 0.0)
    fraction = change[turns] / (change[turns] - change[turns + 1])
    ends = np.concatenate([ends, ends[turns] + fraction * np.diff(ends)[turns]])
    parabolas = hermite(time, sums, values)
    sums_after, sums_before = np.split(
        evaluate(time, parabolas, np.concatenate([ends, ends - window])), 2
    )
    return np.asarray((sums_after - sums_before) / window)


def _blocks(time: Array, window: float) -> Iterator[slice]:
    """Yield parts of a record in which every window lies in one; none if it is shorter than it."""
    for first in range(0, len(time), AT_ONCE):
        begin = int(np.searchsorted(time, time[max(first - 1, 0)] - window, side="right")) - 1
        steps = slice(max(begin, 0), first + AT_ONCE)
        if time[steps][-1] - time[steps][0] >= window:
            yield steps


def _ends(time: Array, window: float) -> Array:
    """Return when windows end that begin or end at a step, increasing; there may be none."""
    ends = np.concatenate([time, time + window])
    ends.sort(kind="stable")  # merges the two
    first, last = np.searchsorted(ends, time[0] + window), np.searchsorted(ends, time[-1], "right")
    ends = ends[first:last]
    return np.concatenate([ends[:1], ends[1:][ends[1:] > ends[:-1]]])


def _change(late: Array, window: float, time: Array, values: Array) -> Array:
    """Return the change of values (n,) over windows with these ends, (m,), s."""
    changed = np.interp(late, time, values) - np.interp(late - window, time, values)
    return np.asarray(changed)


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
