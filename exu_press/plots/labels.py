"""Places of labels beside a drawing."""

from collections.abc import Iterable

import numpy as np

__all__ = ["spread"]


def spread(heights: Iterable[float], least: float) -> list[float]:
    """Return heights moved apart so that neighbours keep a distance, in the given order."""
    wanted = np.array(list(heights))
    order = np.argsort(wanted)
    placed = wanted[order].copy()
    for _ in range(200):
        gaps = np.diff(placed)
        short = np.flatnonzero(gaps < least * (1 - 1e-6))
        if not len(short):
            break
        for index in short:
            push = 0.5 * (least - (placed[index + 1] - placed[index]))
            placed[index] -= push
            placed[index + 1] += push
    found = np.empty_like(placed)
    found[order] = placed
    return [float(value) for value in found]
