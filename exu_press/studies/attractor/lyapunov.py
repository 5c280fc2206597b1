r"""The largest Lyapunov exponent: how fast neighbouring trajectories diverge.

Two neighbouring motions are brought back together after each revolution (Benettin, Galgani,
Giorgilli, Strelcyn, Meccanica 15 (1980) 9-20; Wolf, Swift, Swinney, Vastano, Physica 16D (1985)
285-317):

.. math:: \lambda = \frac{1}{n T} \sum_{i=1}^n \ln\frac{d_i}{d_0}

Where contacts begin and end the tangent jumps, and distances count: several d_0 are taken, and
their difference belongs to the interval. d_0 is to be well above the error of the integration; a
motion that comes back together faster than to that error has only an upper bound of its exponent.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["BATCHES", "Exponent", "combined", "exponent_of"]

BATCHES = 10
"""Parts of the revolutions whose means are taken for independent."""

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Exponent:
    """A largest Lyapunov exponent with its interval of 95 % confidence, per revolution.

    Attributes:
        value: mean logarithm of the growth of a distance in a revolution.
        low: lower end; minus infinity where only an upper bound is known.
        high: upper end.
        distances: from which it was found, without dimension.
        revolutions: of each.
    """

    value: float
    low: float
    high: float
    distances: tuple[float, ...]
    revolutions: int

    @property
    def sign(self) -> str:
        """Its meaning for the motion, in a word or two."""
        if self.low > 0.0:
            return "chaotic"
        return "regular" if self.high < 0.0 else "undecided"


def exponent_of(growths: Array) -> tuple[float, float, float]:
    """Return the mean of logarithmic growths and the ends of its interval, by batch means.

    Growths in revolutions that follow each other depend on each other; the means of BATCHES
    batches hardly do, and Student's distribution gives the interval (Law, Kelton, Simulation
    Modeling and Analysis, 9.5.3).

    Args:
        growths: (n,) ln(d_i / d_0), n at least 2 BATCHES.
    """
    from scipy.stats import t

    batches = np.array([part.mean() for part in np.array_split(growths, BATCHES)])
    half = float(t.ppf(0.5 + 0.5 * CONFIDENCE, BATCHES - 1)) * batches.std(ddof=1)
    mean, half = float(growths.mean()), half / math.sqrt(BATCHES)
    return mean, mean - half, mean + half


def combined(growths: Sequence[Array], distances: Sequence[float], error: float) -> Exponent:
    """Return the exponent of several renormalisation distances.

    Args:
        growths: for each distance, (n,) ln(d_i / d_0).
        distances: d_0.
        error: distance that the integration's error makes of one point in a revolution.
    """
    found = [exponent_of(each) for each in growths]
    floors = [math.log(max(error, 1e-300) / distance) for distance in distances]
    felt = [
        (one, distance)
        for one, floor, distance in zip(found, floors, distances, strict=True)
        if one[0] > floor + 1.0
    ]
    if not felt:  # every distance has shrunk to the error
        least = min(range(len(found)), key=lambda i: found[i][2])
        return Exponent(
            found[least][0], -math.inf, found[least][2], tuple(distances), len(growths[0])
        )
    mean = float(np.mean([one[0] for one, _ in felt]))
    low, high = min(one[1] for one, _ in felt), max(one[2] for one, _ in felt)
    return Exponent(mean, low, high, tuple(d for _, d in felt), len(growths[0]))
