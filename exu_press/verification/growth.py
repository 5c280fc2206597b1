"""Growth of errors: the rate at which neighbouring motions diverge, and the horizon."""

import math
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Growth", "growth"]

LEAST_SPAN = 10.0
"""Over its beginning, how far a distance has to grow so that a rate says something."""


LEAST_DISTANCE = 1e-3
"""Over that of motions that have diverged: two that never get so far from each other differ by
rounding and by their tolerances, which says nothing of how errors grow."""


@dataclass(frozen=True)
class Growth:
    """Growth of the distance of two neighbouring motions.

    Attributes:
        rate: of its logarithm, 1/s: Lyapunov's largest exponent where motion is chaotic; None where
            the distance does not grow tenfold.
        horizon: instant from which the motions are as far apart as they get, s, or None.
    """

    rate: float | None
    horizon: float | None


def growth(time: Array, distance: Array, apart: float) -> Growth:
    """Return how fast a distance grows until motions have diverged.

    The rate is the least-squares slope of the logarithm of the largest distance so far, from where
    there first is one until the horizon.

    Args:
        time: (n,), s, increasing.
        distance: (n,) of two motions that start beside each other; of several pairs (pairs, n),
            whose logarithms are averaged.
        apart: the distance from which on they have diverged, in the unit of `distance`.

    >>> time = np.linspace(0.0, 10.0, 1001)
    >>> found = growth(time, np.minimum(1e-6 * np.exp(2.0 * time), 1.0), apart=0.1)
    >>> round(found.rate, 2), round(found.horizon, 1)
    (2.0, 5.8)
    """
    with np.errstate(divide="ignore"):
        logarithm = np.log(np.atleast_2d(distance)).mean(axis=0)
    largest = np.maximum.accumulate(logarithm)
    limit = math.log(apart)
    diverged = np.flatnonzero(largest >= limit)
    end = int(diverged[0]) if len(diverged) else len(time)
    horizon = float(time[end]) if len(diverged) else None
    begun = np.flatnonzero(np.isfinite(largest[:end]))
    near = largest[end - 1] < math.log(LEAST_DISTANCE) + limit
    if near or len(begun) < 3 or largest[end - 1] - largest[begun[0]] < math.log(LEAST_SPAN):
        return Growth(None, horizon)
    instants = np.linspace(time[begun[0]], time[end - 1], 1000)  # steps are no measure of time
    rate = float(np.polyfit(instants, np.interp(instants, time, largest), 1)[0])
    return Growth(rate, horizon)
