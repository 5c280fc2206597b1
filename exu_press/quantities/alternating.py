"""Loads without the part that alternates from step to step, as peaks are read from them."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array, lengths

__all__ = ["LOADS", "Largest", "largest", "second_difference", "steady"]

LOADS = frozenset({"m/s^2", "N", "N m", "W"})
"""Units of the channels that follow from accelerations."""

LITTLE = 0.05
"""Part of a channel's largest value that is small."""

AT_ONCE = 16384
"""Instants that are looked at together: their arrays stay near the processor."""

SHORTEST = 7
"""Instants of a record in which something alternates."""

ALIKE = 0.3
"""Ratio of two neighbours from which on they count as large as each other."""


@dataclass(frozen=True)
class Largest:
    """The largest magnitudes of a load.

    Attributes:
        columns: of its components, (k,).
        length: of the vector, or of its only component.
    """

    columns: Array
    length: float


def largest(time: Array, values: Array) -> Largest:
    """Return the largest magnitudes of a load (n,) or (n, k), `steady`, at instants (n,), s."""
    values, length = _columns(values), 0.0
    columns = np.zeros(len(values))
    for block in _parts(time, values):
        columns = np.maximum(columns, _magnitudes(block))
        length = max(length, float(lengths(block.T).max()))
    return Largest(columns, length)


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
    filtered = np.empty(values.shape[::-1]).T
    columns, first = _columns(filtered), 0
    for block in _parts(time, _columns(values)):
        columns[:, first : first + block.shape[1]] = block
        first += block.shape[1]
    return filtered


def _columns(values: Array) -> Array:
    """Return values (n,) or (n, k) column by column, (k, n)."""
    return values[None] if values.ndim == 1 else values.T


def _magnitudes(block: Array) -> Array:
    """Return the largest magnitude of each row."""
    return np.asarray(np.maximum(block.max(axis=1), -block.min(axis=1)))


def _parts(time: Array, values: Array) -> Iterator[Array]:
    """Yield a load (k, n), part by part (k, m), without its part that alternates."""
    count = len(time)
    if count < SHORTEST:
        yield values
        return
    bounds = [*range(0, count - SHORTEST + 1, AT_ONCE), count]  # none is shorter
    little = np.zeros(len(values))
    for begin, end in pairwise(bounds):
        little = np.maximum(little, LITTLE * _magnitudes(np.array(values[:, begin:end], order="C")))
    for begin, end in pairwise(bounds):
        first, last = max(begin - 4, 0), min(end + 4, count)
        block = np.array(values[:, first:last], order="C")
        rows, at, alternation = _alternating(time[first:last], block, little)
        block[rows, at] -= alternation
        if last == count:
            before = at == block.shape[1] - 3
            block[rows[before], -2] += alternation[before]
            block[rows[before], -1] -= alternation[before]
        yield block[:, begin - first : end - first]


def _alternating(
    time: Array, values: Array, little: Array
) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Return where values (k, m) alternate, row and column, and the part that does.

    It is not known of the two at either end.
    """
    deviation = _chord_deviation(time, values)
    turns = deviation[:, :-1] * deviation[:, 1:] < 0.0
    rows, at = np.divmod(np.flatnonzero(turns[:, :-1] & turns[:, 1:]), turns.shape[1] - 1)
    alternation = (
        2.0 * deviation[rows, at + 1] - deviation[rows, at] - deviation[rows, at + 2]
    ) / 8.0
    whole = np.abs(alternation) <= little[rows]
    more = np.flatnonzero(~whole)
    for near in (-1, 0, 1, 2) if len(more) else ():
        more = more[_same(deviation, rows[more], at[more] + near)]
    whole[more] = True
    return rows[whole], at[whole] + 2, alternation[whole]


def _same(deviation: Array, rows: NDArray[np.intp], at: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Return where two neighbours have other signs and like sizes, or there are not two."""
    there = (at >= 0) & (at + 1 < deviation.shape[1])
    left_value, right_value = (deviation[rows, np.where(there, at + i, 0)] for i in (0, 1))
    sizes = np.abs(left_value), np.abs(right_value)
    alike = np.minimum(*sizes) > ALIKE * np.maximum(*sizes)
    return np.asarray((alike & (left_value * right_value < 0.0)) | ~there)


def second_difference(time: Array, values: Array) -> Array:
    """Return values (n, ...) less the line of their neighbours, (n - 2, ...)."""
    return np.asarray(_chord_deviation(time, values.T).T)


def _chord_deviation(time: Array, values: Array) -> Array:
    """Return values (..., n) less the line of their neighbours, (..., n - 2)."""
    fraction = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    chord = (1.0 - fraction) * values[..., :-2]
    np.subtract(values[..., 1:-1], chord, out=chord)
    chord -= fraction * values[..., 2:]
    return np.asarray(chord)
