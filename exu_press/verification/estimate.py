"""The error of a quantity, from its values in runs at other tolerances."""

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from exu_press.quantities import Extreme
from exu_press.quantities.kind import ROUNDING
from exu_press.result.info import Error
from exu_press.scene import Scene

__all__ = [
    "OF_COUNTS",
    "ORDERS",
    "convergent_error",
    "error_ratio",
    "extreme_over_parts",
    "prediction_interval",
    "single_difference_factor",
    "whole_error",
]

ORDERS = {"tolerance": 0.6, "step": 0.8}
"""Powers of the tolerance, or of a fixed step, to which errors are taken to be proportional. Most
are so to the tolerance itself; runs at half and at 4 times it then state them 2.3 times too large.
But peaks of vibrations behind impacts, and counts of touches, go with its root, and three runs may
agree by chance. Errors of smooth motion go with the step's square, those behind impacts with the
step itself. scripts/calibrate_errors.py measures what such powers cover."""

PREDICTION_FACTORS = {1: 11.0, 2: 3.85, 3: 2.9, 4: 2.55}
"""Number of differences -> half the width of the interval that holds 95 % of further samples, over
the root mean square of a normal sample's differences (tests/verification/test_estimate.py)."""

OF_COUNTS = 1.0
"""Least root mean square difference of counts in diverged runs: they may agree by chance."""

DETERMINED = 0.05
"""Relative error within which a quantity is determined, however chaotic the motion is."""


def convergent_error(
    values: Sequence[float],
    ratios: Sequence[float],
    least: float = 0.0,
    nearest: float = 0.0,
    earlier: Sequence[Sequence[float]] = (),
) -> Error:
    """Return the error of a quantity that converges with the tolerance (or the step).

    Of each pair of runs the difference over that of the ratios is an estimate; the largest one
    counts.

    Args:
        values: of the quantity at several tolerances; the first one is reported.
        ratios: of the errors there to the first one's, see `error_ratio`.
        least: error, in the quantity's unit.
        nearest: least error over the difference from the second run, where only that one still
            follows the first one's motion.
        earlier: values at earlier instants of a quantity that oscillates; the largest error counts.

    >>> round(convergent_error([1.01, 1.02, 1.03], [1.0, 2.0, 3.0])["error"], 6)
    0.01
    """
    error = 0.0
    for figures in (values, *earlier):
        pairs = combinations(zip(figures, ratios, strict=True), 2)
        largest = max(abs(a - b) / abs(i - j) for (a, i), (b, j) in pairs)
        error = max(error, largest, nearest * abs(figures[1] - figures[0]))
    return _about(values[0], error + least, determined=True)


def error_ratio(scene: Scene, ratio: float) -> float:
    """Return the errors of a scene at `ratio` times its tolerance, or fixed step, over its own."""
    return float(ratio ** ORDERS[scene.solver.accuracy[0]])


def single_difference_factor(ratio: float) -> float:
    """Return the bound of an error over the run's difference from one refinement alone.

    Both errors are normal, the refinement's `ratio` times as large: 95 % of errors are within the
    bound (tails of the Cauchy distribution).

    Args:
        ratio: of the errors, below 1.

    >>> round(single_difference_factor(0.5), 1)
    5.2
    """
    mean = 1.0 / (1.0 + ratio**2)  # of the error over the difference, and the scale about it
    scale = ratio / (1.0 + ratio**2) / (0.05 * math.pi)
    return scale + math.hypot(scale, mean)


def prediction_interval(
    values: Sequence[float],
    least: float = 0.0,
    shares: Sequence[float] | None = None,
    *,
    scatter: float = 0.0,
) -> Error:
    """Return the 95 % prediction interval of a quantity whose motions have diverged.

    Args:
        values: of diverged runs, normally distributed; the first one is reported.
        least: error, in the quantity's unit, on top.
        shares: distance of each further run from the first, over that of the exact motion: half of
            it shows half of the scatter; None: all are as far.
        scatter: least root mean square of the differences.
    """
    differences = np.asarray(values[1:]) - values[0]
    if shares is not None:
        differences = differences / np.minimum(shares, 1.0)
    factor = PREDICTION_FACTORS.get(len(differences), 2.4)
    scatter = max(scatter, float(np.sqrt(np.mean(differences**2))))
    error = factor * scatter + ROUNDING * abs(values[0]) + least
    return _about(values[0], error, determined=error <= DETERMINED * abs(values[0]))


def whole_error(value: float, error: Error, doubtful: bool) -> Error:
    """Return the error of a count, which is none or one at least.

    Args:
        value: whole.
        error: from other runs.
        doubtful: whether one more or less is possible although they agree.

    >>> one = {"error": 0.77, "determined": True, "low": 11.23, "high": 12.77}
    >>> whole_error(12.0, one, doubtful=False)["high"]
    13.0
    >>> whole_error(12.0, {**one, "error": 1e-8}, doubtful=False)["error"]
    0.0
    """
    most = float(max(math.ceil(error["error"] - ROUNDING * (1.0 + abs(value))), doubtful))
    return _about(value, most, determined=error["determined"])


def extreme_over_parts(value: float, first: Error, second: Error, extreme: Extreme) -> Error:
    """Return the error of an extreme over two parts of a motion."""
    outer = max if extreme is Extreme.LARGEST else min
    low, high = outer(first["low"], second["low"]), outer(first["high"], second["high"])
    error = max(high - value, value - low)
    determined = error <= DETERMINED * abs(value)
    return {"error": error, "determined": determined, "low": low, "high": high}


def _about(value: float, error: float, *, determined: bool) -> Error:
    return {"error": error, "determined": determined, "low": value - error, "high": value + error}
