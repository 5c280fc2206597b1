"""Values at uneven places as means over even cells: an impact between two of them is not missed."""

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import integral

__all__ = ["cell_means"]


def cell_means(x: Array, values: Array, edges: Array) -> Array:
    """Return the mean of a curve in each cell, (m,): its integral over the cell, over its width.

    The curve is straight between its values, and the integral of that is exact, so that the sum
    over all cells keeps the area (the momentum of an impact) however narrow a peak is.

    Args:
        x: (n,), increasing.
        values: (n,).
        edges: of the cells, (m + 1,), increasing, within x.

    >>> x = np.array([0.0, 0.49, 0.5, 0.51, 1.0])
    >>> impact = np.array([0.0, 0.0, 100.0, 0.0, 0.0])
    >>> cell_means(x, impact, np.array([0.0, 0.25, 0.75, 1.0])).round(12)
    array([0., 2., 0.])

    Raises:
        InputError: the cells reach beyond the curve.
    """
    slack = 1e-9 * (x[-1] - x[0])
    if edges[0] < x[0] - slack or edges[-1] > x[-1] + slack:
        raise InputError(
            f"cells from {edges[0]:g} to {edges[-1]:g}: allowed are {x[0]:g} to {x[-1]:g}"
        )
    at = np.clip(edges, x[0], x[-1])
    left = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    beyond = at - x[left]
    slope = (values[left + 1] - values[left]) / (x[left + 1] - x[left])
    area = integral(x, values)[left] + beyond * (values[left] + 0.5 * beyond * slope)
    return np.asarray(np.diff(area) / np.diff(edges))
