"""Loads without the part that alternates from step to step, as peaks are read from them."""

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["LOADS", "beside_line", "steady"]

LOADS = frozenset({"m/s^2", "N", "N m", "W"})
"""Units of the channels that follow from accelerations."""

LITTLE = 0.05
"""Part of a channel's largest value that is small."""

AT_ONCE = 200_000
"""Instants that are looked at together: the arrays take ten times their memory."""

ALIKE = 0.3
"""Ratio of two neighbours from which on they count as large as each other."""


def steady(time: Array, values: Array) -> Array:
    """Return a load (n, ...) at instants (n,), s, without its part that alternates.

    Constraints of index 3 leave an error in generalized-alpha's accelerations that changes its sign
    in each step; the rounding of positions feeds it, the more the shorter the steps are (M. Arnold,
    O. Bruels, BIT 47, 2007). Peaks read from such samples are too high by it, at all tolerances.

    Values beside the line of their neighbours have one sign where a curve is smooth, up to a point
    of inflection. Where three of them alternate, their second difference has all of the alternating
    part, and of a smooth curve its fourth derivative. A peak of a single sample makes three
    alternate, too: more than a LITTLE alternates where five of them do, and are as large.
    """
    if len(time) < 7:
        return values
    found = np.zeros_like(values)
    largest = np.abs(values).max(axis=0)
    for first in range(0, len(time), AT_ONCE):
        begin, end = max(first - 4, 0), min(first + AT_ONCE + 4, len(time))
        if end - begin >= 7:
            part = _alternating(time[begin:end], values[begin:end], LITTLE * largest)
            last = min(first + AT_ONCE, len(time))
            found[first:last] = part[first - begin : last - begin]
    found[-2], found[-1] = -found[-3], found[-3]
    np.subtract(values, found, out=found)
    return found


def _alternating(time: Array, values: Array, little: Array) -> Array:
    """Return the part of values that alternates, but for the two at either end, where it is 0."""
    beside = beside_line(time, values)
    sizes = np.abs(beside)
    turns = beside[:-1] * beside[1:] < 0.0
    counts = turns[:-1] & turns[1:]
    alike = np.minimum(sizes[:-1], sizes[1:]) > ALIKE * np.maximum(sizes[:-1], sizes[1:])
    whole = np.ones_like(turns[:1])
    same = np.concatenate([whole, turns & alike, whole])
    part = (2.0 * beside[1:-1] - beside[:-2] - beside[2:]) / 8.0
    counts &= (np.abs(part) <= little) | (same[:-3] & same[1:-2] & same[2:-1] & same[3:])
    found = np.zeros_like(values)
    found[2:-2] = np.where(counts, part, 0.0)
    return found


def beside_line(time: Array, values: Array) -> Array:
    """Return values (n, ...) less the line of their neighbours, (n - 2, ...)."""
    part = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    part = part.reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values[1:-1] - (1.0 - part) * values[:-2] - part * values[2:])
