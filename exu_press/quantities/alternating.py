"""Loads without their oscillation from step to step, and their peaks."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array, lengths

__all__ = ["LOADS", "Peaks", "peaks", "remove_alternation", "second_difference"]

LOADS = frozenset({"m/s^2", "N", "N m", "W"})
"""Units of the channels that follow from accelerations."""

SMALL_SHARE = 0.05
"""Part of a channel's largest value below which three alternating values suffice."""

AT_ONCE = 16384
"""Instants of a block: its arrays stay near the processor."""

SHORTEST = 7
"""Instants of a record, at least, for an oscillation."""

ALIKE = 0.3
"""Ratio of two neighbours from which on they are alike."""


@dataclass(frozen=True)
class Peaks:
    """The largest magnitudes of a load.

    Attributes:
        columns: of its components, (k,).
        length: of the vector, or of its only component.
    """

    columns: Array
    length: float


def peaks(time: Array, values: Array) -> Peaks:
    """Return the peaks of a load (n,) or (n, k) without alternation, at instants (n,), s."""
    values, length = _columns(values), 0.0
    columns = np.zeros(len(values))
    for block in _blocks(time, values):
        columns = np.maximum(columns, _magnitudes(block))
        length = max(length, float(lengths(block.T).max()))
    return Peaks(columns, length)


def remove_alternation(time: Array, values: Array) -> Array:
    """Return a load (n, ...) at instants (n,), s, without its oscillation from step to step.

    Constraints of index 3 leave an error in generalized-alpha's accelerations that changes its sign
    in each step; the rounding of positions feeds it, the more the shorter the steps are (M. Arnold,
    O. Bruels, BIT 47, 2007). Peaks of such samples are too high by it, at all tolerances.

    Deviations from the chord of both neighbours have one sign where a curve is smooth, up to a
    point of inflection. Where three of them alternate, their second difference has all of the
    oscillation, and of a smooth curve its fourth derivative. A peak of a single sample makes three
    alternate, too: above SMALL_SHARE five of them have to, and to be alike.
    """
    filtered = np.empty(values.shape[::-1]).T
    columns, first = _columns(filtered), 0
    for block in _blocks(time, _columns(values)):
        columns[:, first : first + block.shape[1]] = block
        first += block.shape[1]
    return filtered


def _columns(values: Array) -> Array:
    """Return values (n,) or (n, k) column by column, (k, n)."""
    return values[None] if values.ndim == 1 else values.T


def _magnitudes(block: Array) -> Array:
    """Return the largest magnitude of each row."""
    return np.asarray(np.maximum(np.abs(block.max(axis=1)), np.abs(block.min(axis=1))))


def _blocks(time: Array, values: Array) -> Iterator[Array]:
    """Yield a load (k, n) in blocks (k, m), without its oscillation."""
    count = len(time)
    if count < SHORTEST:
        yield values
        return
    bounds = [*range(0, count - SHORTEST + 1, AT_ONCE), count]  # none is shorter
    small = np.zeros(len(values))
    for begin, end in pairwise(bounds):
        small = np.maximum(
            small, SMALL_SHARE * _magnitudes(np.array(values[:, begin:end], order="C"))
        )
    for begin, end in pairwise(bounds):
        first, last = max(begin - 4, 0), min(end + 4, count)
        block = np.array(values[:, first:last], order="C")
        rows, at, alternation = _alternating(time[first:last], block, small)
        block[rows, at] -= alternation
        if last == count:
            final = at == block.shape[1] - 3
            block[rows[final], -2] += alternation[final]
            block[rows[final], -1] -= alternation[final]
        yield block[:, begin - first : end - first]


def _alternating(
    time: Array, values: Array, small: Array
) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Return row and column where values (k, m) alternate, and the oscillation there.

    It is not known of the two at either end.
    """
    deviation = _chord_deviation(time, values)
    turns = deviation[:, :-1] * deviation[:, 1:] < 0.0
    rows, at = np.divmod(np.flatnonzero(turns[:, :-1] & turns[:, 1:]), turns.shape[1] - 1)
    alternation = (
        2.0 * deviation[rows, at + 1] - deviation[rows, at] - deviation[rows, at + 2]
    ) / 8.0
    whole = np.abs(alternation) <= small[rows]
    more = np.flatnonzero(~whole)
    for near in (-1, 0, 1, 2) if len(more) else ():
        more = more[_are_alike(deviation, rows[more], at[more] + near)]
    whole[more] = True
    return rows[whole], at[whole] + 2, alternation[whole]


def _are_alike(deviation: Array, rows: NDArray[np.intp], at: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Return where two neighbours have opposite signs and like sizes, or one is missing."""
    exist = (at >= 0) & (at + 1 < deviation.shape[1])
    left_value, right_value = (deviation[rows, np.where(exist, at + i, 0)] for i in (0, 1))
    sizes = np.abs(left_value), np.abs(right_value)
    alike = np.minimum(*sizes) > ALIKE * np.maximum(*sizes)
    return np.asarray((alike & (left_value * right_value < 0.0)) | ~exist)


def second_difference(time: Array, values: Array) -> Array:
    """Return the deviation of values (n, ...) from the chord of their neighbours, (n - 2, ...)."""
    return np.asarray(_chord_deviation(time, values.T).T)


def _chord_deviation(time: Array, values: Array) -> Array:
    """Return the deviation of values (..., n) from the chord of their neighbours, (..., n - 2)."""
    fraction = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    chord = (1.0 - fraction) * values[..., :-2]
    np.subtract(values[..., 1:-1], chord, out=chord)
    chord -= fraction * values[..., 2:]
    return np.asarray(chord)
