"""Growth of errors: the rate at which neighbouring motions diverge, and the horizon."""

import math
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Growth", "growth"]

LEAST_SPAN = 10.0
"""Factor by which a distance has to grow for a rate."""

LEAST_DISTANCE = 1e-3
"""Part of the distance of diverged motions below which two motions differ by rounding and by their
tolerances, which says nothing of how errors grow."""


@dataclass(frozen=True)
class Growth:
    """Growth of the distance of two neighbouring motions.

    Attributes:
        rate: of its logarithm, 1/s: the largest Lyapunov exponent where motion is chaotic; None
            where the distance does not grow by LEAST_SPAN.
        horizon: instant from which on the motions have diverged, s, or None.
    """

    rate: float | None
    horizon: float | None


def growth(time: Array, distance: Array, diverged_distance: float) -> Growth:
    """Return how fast a distance grows until motions have diverged.

    The rate is the least-squares slope of the logarithm of the largest distance so far, between the
    first distance above zero and the horizon.

    Args:
        time: (n,), s, increasing.
        distance: (n,) of two motions that start beside each other; of several pairs (pairs, n),
            whose logarithms are averaged.
        diverged_distance: from which on they have diverged, in the unit of `distance`.

    >>> time = np.linspace(0.0, 10.0, 1001)
    >>> result = growth(time, np.minimum(1e-6 * np.exp(2.0 * time), 1.0), diverged_distance=0.1)
    >>> round(result.rate, 2), round(result.horizon, 1)
    (2.0, 5.8)
    """
    with np.errstate(divide="ignore"):
        logarithm = np.log(np.atleast_2d(distance)).mean(axis=0)
    largest = np.maximum.accumulate(logarithm)
    limit = math.log(diverged_distance)
    beyond = np.flatnonzero(largest >= limit)
    end = int(beyond[0]) if len(beyond) else len(time)
    horizon = float(time[end]) if len(beyond) else None
    nonzero = np.flatnonzero(np.isfinite(largest[:end]))
    stays_near = largest[end - 1] < math.log(LEAST_DISTANCE) + limit
    if (
        stays_near
        or len(nonzero) < 3
        or largest[end - 1] - largest[nonzero[0]] < math.log(LEAST_SPAN)
    ):
        return Growth(None, horizon)
    instants = np.linspace(time[nonzero[0]], time[end - 1], 1000)  # steps are no measure of time
    rate = float(np.polyfit(instants, np.interp(instants, time, largest), 1)[0])
    return Growth(rate, horizon)
