"""The error of a figure, from the same figure of runs at other tolerances."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

__all__ = ["ROUNDING", "SAFETY", "SAFETY_OF_STEPS", "FigureError", "converging", "scattered"]

SAFETY = 1.8
"""Of errors that go with the tolerance. Calibrated by scripts/calibrate_errors.py: with 1.5 95 % of
figures are covered, with 2 97 %, at 4.2 and 4.7 times the true error in the median."""

SAFETY_OF_STEPS = 3.0
"""Of errors that go with a fixed step: impacts and films that it leaps over are not sampled better
by half of it."""

STUDENT = {1: 6.31, 2: 2.92, 3: 2.35, 4: 2.13, 5: 2.02, 6: 1.94, 7: 1.89}
"""Student's t for 90 % on both sides together, over the degrees of freedom."""

LITTLE = 0.05
"""Over the figure: within this a figure counts as determined, however chaotic the motion is."""

ROUNDING = 1e-9
"""Of a figure, what no two runs agree to better than."""


@dataclass(frozen=True)
class FigureError:
    """What is known of a figure's error, in the figure's unit.

    Attributes:
        error: that the figure is off by, at most.
        determined: whether the scene determines the figure; if not, runs that differ by nothing
            that is known of the scene lie between `low` and `high`.
        low: the least that it may be.
        high: the most.
    """

    error: float
    determined: bool
    low: float
    high: float


def converging(
    values: Sequence[float], ratios: Sequence[float], least: float = 0.0, safety: float = SAFETY
) -> FigureError:
    """Return the error of a figure whose error goes with the tolerance (or the step).

    The first value is the figure itself, its ratio 1; of each pair of runs the difference over that
    of the ratios is an estimate, and the largest counts: two values may agree by chance.

    Args:
        values: the figure at several tolerances.
        ratios: of these tolerances to the first.

        least: error, in the figure's unit.
        safety: factor on what the differences say.

    >>> round(converging([1.01, 1.04, 1.08], [1.0, 4.0, 8.0]).error, 6)  # SAFETY times 1.01 - 1
    0.018
    """
    pairs = combinations(zip(values, ratios, strict=True), 2)
    largest = max(abs(a - b) / abs(i - j) for (a, i), (b, j) in pairs)
    error = safety * largest + least
    return FigureError(error, True, values[0] - error, values[0] + error)


def scattered(values: Sequence[float], least: float = 0.0) -> FigureError:
    """Return between which bounds a figure lies that depends on what nobody knows.

    Nine in ten further runs lie there, if such figures scatter normally.

    Args:
        values: of runs that have nothing in common any more; the first one is reported.
        least: error, in the figure's unit, on top.
    """
    samples = np.asarray(values)
    count = len(samples)
    factor = STUDENT.get(count - 1, 1.65) * math.sqrt(1.0 + 1.0 / count)
    middle, half = float(samples.mean()), factor * float(samples.std(ddof=1))
    half += ROUNDING * abs(middle) + least
    low, high = min(middle - half, values[0]), max(middle + half, values[0])
    error = max(high - values[0], values[0] - low)
    return FigureError(error, error <= LITTLE * abs(values[0]), low, high)
