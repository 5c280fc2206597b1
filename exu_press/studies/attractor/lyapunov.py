r"""The largest Lyapunov exponent: how fast neighbouring trajectories diverge.

Two neighbouring motions are brought back together after each revolution (Benettin, Galgani,
Giorgilli, Strelcyn, Meccanica 15 (1980) 9-20; Wolf, Swift, Swinney, Vastano, Physica 16D (1985)
285-317):

.. math:: \lambda = \frac{1}{n T} \sum_{i=1}^n \ln\frac{d_i}{d_0}

Where contacts begin and end the tangent jumps, and distances count: several d_0 are taken, and
their difference belongs to the interval. So does what finer steps of both neighbours change of the
growth in the revolutions whose errors are measured, but no more than if each were off by the error
of a point, one to either side. A motion that comes back together faster than to its own error has
only an upper bound of its exponent.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["BATCHES", "Exponent", "combine_exponents", "exponent_of"]

BATCHES = 10
"""Parts of the revolutions whose means are taken for independent."""

CONFIDENCE = 0.95

RESOLVED = math.e
"""Times the error: neighbours that come nearer have no lower bound of their exponent."""


@dataclass(frozen=True)
class Exponent:
    """A largest Lyapunov exponent with its interval of 95 % confidence, per revolution.

    Attributes:
        value: mean logarithm of the growth of a distance in a revolution.
        low: lower end; minus infinity where only an upper bound is known.
        distances: of renormalisation, without dimension.
        revolutions: of each.
    """

    value: float
    low: float
    high: float
    distances: tuple[float, ...]
    revolutions: int

    @property
    def sign(self) -> str:
        """The kind of motion: chaotic, regular or undecided."""
        if self.low > 0.0:
            return "chaotic"
        return "regular" if self.high < 0.0 else "undecided"


def exponent_of(growths: Array) -> tuple[float, float, float]:
    """Return the mean of logarithmic growths and the ends of its interval, by batch means.

    Growths in revolutions that follow each other depend on each other; the means of BATCHES
    batches hardly do, and Student's distribution gives the interval (Law, Kelton, Simulation
    Modeling and Analysis, 9.5.3). While neighbours turn into the direction that grows most, the
    growth changes: what the later half differs by belongs to the interval.

    Args:
        growths: (n,) ln(d_i / d_0), n at least 2 BATCHES.
    """
    from scipy.stats import t

    batches = np.array([batch.mean() for batch in np.array_split(growths, BATCHES)])
    half = float(t.ppf(0.5 + 0.5 * CONFIDENCE, BATCHES - 1)) * batches.std(ddof=1)
    mean, half = float(growths.mean()), half / math.sqrt(BATCHES)
    half += abs(float(growths[len(growths) // 2 :].mean()) - mean)
    return mean, mean - half, mean + half


def combine_exponents(
    growths: Sequence[Array],
    distances: Sequence[float],
    error: float,
    growth_errors: Sequence[float],
) -> Exponent:
    """Return the exponent of several renormalisation distances.

    Args:
        growths: for each distance, (n,) ln(d_i / d_0).
        error: distance that the integration's error makes of one point in a revolution.
        growth_errors: for each distance, the integration's error of the mean logarithm.
    """
    intervals = []
    for series, distance, measured in zip(growths, distances, growth_errors, strict=True):
        mean, low, high = exponent_of(series)
        final_distance = distance * math.exp(mean)
        error_of_growth = min(measured, math.log1p(2.0 * error / final_distance))
        intervals.append(
            (
                mean,
                low - error_of_growth if final_distance > RESOLVED * error else -math.inf,
                high + error_of_growth,
            )
        )
    revolutions = len(growths[0])
    above_error = [n for n, (_, low, _) in enumerate(intervals) if math.isfinite(low)]
    if not above_error:  # every distance has shrunk to the error
        mean, low, high = min(intervals, key=lambda interval: interval[2])
        return Exponent(mean, low, high, tuple(distances), revolutions)
    means, lows, highs = zip(*(intervals[n] for n in above_error), strict=True)
    distances_used = tuple(distances[n] for n in above_error)
    return Exponent(float(np.mean(means)), min(lows), max(highs), distances_used, revolutions)
