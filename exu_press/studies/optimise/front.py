"""The points that no other one betters in everything, and one of them to choose."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array

__all__ = ["chosen", "front"]


def front(values: Array, violations: Array) -> NDArray[np.intp]:
    """Return the places of points that no other one dominates, by their first objective.

    A point dominates another one if it is not worse in any objective and better in one.

    Args:
        values: (points, objectives), less is better; NaN of a point that has none.
        violations: (points,), of limits; points with any are left out.

    >>> front(np.array([[1.0, 3.0], [2.0, 2.0], [3.0, 3.0]]), np.zeros(3)).tolist()
    [0, 1]
    """
    fine = np.flatnonzero(np.isfinite(values).all(axis=1) & (violations <= 0.0))
    kept: list[int] = []
    seen: set[bytes] = set()
    for place in fine:
        one, others = values[place], values[fine]
        worse = (others <= one).all(axis=1) & (others < one).any(axis=1)
        if not worse.any() and one.tobytes() not in seen:
            kept.append(int(place))
            seen.add(one.tobytes())
    kept.sort(key=lambda place: float(values[place, 0]))
    return np.array(kept, dtype=np.intp)


def chosen(values: Array, weights: Sequence[float]) -> int:
    """Return the point of a front that is nearest to the best of each objective.

    Objectives are scaled to 0 to 1 over the front; a weight stretches its own.

    >>> chosen(np.array([[0.0, 1.0], [0.2, 0.2], [1.0, 0.0]]), [1.0, 1.0])
    1
    """
    span = np.ptp(values, axis=0)
    scaled = (values - values.min(axis=0)) / np.where(span > 0.0, span, 1.0)
    return int(np.argmin(np.linalg.norm(scaled * np.asarray(weights), axis=1)))
