"""A long run in a page: the least and the largest value of every few steps, so no peak is lost."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array, lengths

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
        blocks = -(-self.count // self.every)
        missing = blocks * self.every - self.count
        padded = np.concatenate([values, np.repeat(values[-1:], missing, axis=0)])
        padded = padded.reshape(blocks, self.every, -1)
        both = np.sort(np.stack([padded.argmin(axis=1), padded.argmax(axis=1)], axis=1), axis=1)
        extreme_values = np.take_along_axis(padded, both, axis=1)
        return np.asarray(extreme_values.reshape(2 * blocks, *values.shape[1:]))

    def vectors(self, values: Array) -> Array:
        """Return the shortest and the longest vectors (m, k) of blocks, in their order."""
        if self.every == 1:
            return values
        size = lengths(values)
        blocks = -(-self.count // self.every)
        padded = np.full(blocks * self.every, size[-1])
        padded[: self.count] = size
        table = padded.reshape(blocks, self.every)
        both = np.sort(np.column_stack([table.argmin(axis=1), table.argmax(axis=1)]), axis=1)
        steps = both + self.every * np.arange(blocks)[:, None]
        return np.asarray(values[np.minimum(steps.ravel(), self.count - 1)])


def thinning(counts: list[int], widths: list[int], most: int = MOST_VALUES) -> list[Thinning]:
    """Return how runs are thinned for one page: each gets the same room."""
    room = most / len(counts)
    return [
        Thinning(count, 1 if count * width <= room else int(np.ceil(2.0 * count * width / room)))
        for count, width in zip(counts, widths, strict=True)
    ]
