"""A long run in a page: the least and the largest value of every few steps, so no peak is lost."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array, lengths
from exu_press.plots.decimate import block_extremes

__all__ = ["MOST_VALUES", "Thinning", "thinning"]

MOST_VALUES = 5_000_000
"""Most values in a page; they take 3 bytes each."""


@dataclass(frozen=True)
class Thinning:
    """The instants that a page has of a run.

    Attributes:
        count: steps of the run.
        every: so many steps become two values; 1: all of them are kept.
    """

    count: int
    every: int

    @property
    def steps(self) -> NDArray[np.intp]:
        """Steps at whose instants the page has values: the first and the middle of every block."""
        if self.every == 1:
            return np.arange(self.count)
        first = np.arange(0, self.count, self.every)
        middle = first + self.every // 2
        middle[-1] = self.count - 1
        return np.column_stack([first, middle]).ravel()

    def extremes(self, values: Array) -> Array:
        """Return the least and the largest values of blocks, in their order, from (n,) or (n, k).

        They stand at the instants of `steps`, less than a block from where they were.
        """
        if self.every == 1:
            return values
        flat = values.reshape(self.count, -1)
        columns = [column[self._extremes_of(column)] for column in flat.T]
        return np.stack(columns, axis=1).reshape(-1, *values.shape[1:])

    def vectors(self, values: Array) -> Array:
        """Return the shortest and the longest vectors (m, k) of blocks, in their order."""
        return values if self.every == 1 else values[self._extremes_of(lengths(values))]

    def _extremes_of(self, values: Array) -> NDArray[np.intp]:
        """Return where the extremes of every block are, two a block, in their order."""
        starts = np.arange(0, self.count, self.every)
        return np.sort(block_extremes(values, starts), axis=1).ravel()


def thinning(counts: list[int], widths: list[int], most: int = MOST_VALUES) -> list[Thinning]:
    """Return how runs are thinned for one page: each gets the same room."""
    room = most / len(counts)
    return [
        Thinning(count, 1 if count * width <= room else int(np.ceil(2.0 * count * width / room)))
        for count, width in zip(counts, widths, strict=True)
    ]
