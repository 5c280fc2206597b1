"""Fewer points for the same picture."""

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array

__all__ = ["BINS", "block_extremes", "decimate", "distance_travelled", "visible_segments"]

BINS = 900
"""About a bin a pixel in a panel over half a picture's width."""


def decimate(x: Array, *curves: Array, bins: int = BINS) -> NDArray[np.intp]:
    """Return which points of curves over x to draw: first, lowest, highest and last in every bin.

    A line through these covers the same pixels as one through all points where a bin is at most
    a pixel wide (M4: Jugel et al., Proc. VLDB Endowment 7 (2014) 797-808).

    Args:
        x: (n,), as of a crank that may fall back; bins are of the way that it goes.
        curves: each (n,); extremes of each of them are kept.
        bins: of equal width.

    Returns:
        Increasing indices into x; all of them where there are not more than 4 a bin.
    """
    count = len(x)
    if count <= 4 * bins:
        return np.arange(count)
    path_length = distance_travelled(x)
    bin_of = np.minimum((path_length / (path_length[-1] / bins or 1.0)).astype(int), bins - 1)
    starts = np.flatnonzero(np.diff(bin_of, prepend=-1))
    ends = np.append(starts[1:], count) - 1
    extremes = [block_extremes(curve, starts).ravel() for curve in curves]
    return np.unique(np.concatenate([starts, ends, *extremes]))


def block_extremes(values: Array, starts: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return where the least and the largest values of blocks are.

    Args:
        values: (n,).
        starts: of the blocks, (m,), increasing; the first is 0.

    Returns:
        (m, 2) indices into the values, the least first; of equal values the first one.
    """
    block_of = np.repeat(np.arange(len(starts)), np.diff(np.append(starts, len(values))))
    columns = []
    for extreme in (np.minimum, np.maximum):
        reached = np.flatnonzero(values == extreme.reduceat(values, starts)[block_of])
        columns.append(reached[np.diff(block_of[reached], prepend=-1) > 0])
    return np.stack(columns, axis=1)


def distance_travelled(x: Array) -> Array:
    """Return the way from the first of places (n,) to each, whatever the direction, (n,)."""
    return np.append(0.0, np.cumsum(np.abs(np.diff(x))))


def visible_segments(points: Array, pixel: float) -> NDArray[np.intp]:
    """Return which segments of a path in the plane to draw.

    Points that stay in the pixel of the one before are left out, and of segments from one pixel to
    another only the last is kept, which is drawn over the earlier ones.

    Args:
        points: (n, 2).
        pixel: its width, in the unit of the points.

    Returns:
        (m, 2) indices of the segments' ends, in the order of the path.
    """
    cells = np.round(points / pixel).astype(int)
    moved = np.flatnonzero((np.diff(cells, axis=0) != 0).any(axis=1)) + 1
    points_kept = np.concatenate([[0], moved])
    segments = np.stack([points_kept[:-1], points_kept[1:]], axis=1)
    cells -= cells.min(axis=0)
    across, down = cells.max(axis=0) + 1
    number = cells[:, 0] * down + cells[:, 1]
    ends = number[segments] @ [across * down, 1]  # one number for both is sorted sooner than four
    _, unique = np.unique(ends[::-1], return_index=True)  # the last of each comes first
    return np.asarray(segments[np.sort(len(segments) - 1 - unique)])
