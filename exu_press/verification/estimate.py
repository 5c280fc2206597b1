"""The error of a figure, from the same figure of runs at other tolerances."""

import math
from collections.abc import Sequence
from itertools import combinations

import numpy as np

from exu_press.quantities import Extreme
from exu_press.quantities.kind import ROUNDING
from exu_press.result.info import Error

__all__ = ["ORDER", "converging", "of_both", "of_one", "scattered"]

ORDER = 0.5
"""Power of the tolerance (or step) that errors are taken to go with. Most go with the tolerance
itself, and are stated three times too large then by runs at half and at 4 times it. But peaks of
vibrations behind impacts, and what is counted over touches, go with its root, and three runs may
agree by chance; scripts/calibrate_errors.py has shown ORDER."""

NINETEEN_IN_TWENTY = {1: 11.0, 2: 3.85, 3: 2.9, 4: 2.55}
"""Over the root mean square of a normal sample's differences to so many others: within this of it
nineteen in twenty further samples lie (drawn ones; tests/confidence/test_estimate.py)."""

LITTLE = 0.05
"""Over the figure: within this a figure counts as determined, however chaotic the motion is."""


def converging(
    values: Sequence[float],
    ratios: Sequence[float],
    least: float = 0.0,
    nearest: float = 0.0,
    earlier: Sequence[Sequence[float]] = (),
) -> Error:
    """Return the error of a figure whose error falls with the tolerance (or the step).

    The first value is the figure itself, its ratio 1; of each pair of runs the difference over that
    of the ratios' powers is an estimate, and the largest counts.

    Args:
        values: the figure at several tolerances.
        ratios: of these tolerances to the first.
        least: error, in the figure's unit.
        nearest: error over the difference from the second run at least, where only this one still
            has the first one's motion; the others' differences do not go with the tolerance then.
        earlier: the values at instants before, of a figure that swings: the largest error counts.

    >>> round(converging([1.01, 1.02, 1.03], [1.0, 4.0, 9.0])["error"], 6)  # goes with the root
    0.01
    """
    powers = [ratio**ORDER for ratio in ratios]
    error = 0.0
    for found in (values, *earlier):
        pairs = combinations(zip(found, powers, strict=True), 2)
        largest = max(abs(a - b) / abs(i - j) for (a, i), (b, j) in pairs)
        error = max(error, largest, nearest * abs(found[1] - found[0]))
    return _about(values[0], error + least, determined=True)


def of_one(ratio: float) -> float:
    """Return an error over the difference of the run from one refinement alone.

    Two errors that are normal, of either sign, the refinement's `ratio` times as large: nineteen
    in twenty are within this of their difference (the tails of Cauchy's distribution).

    Args:
        ratio: of the tolerances, below 1.

    >>> round(of_one(0.5), 1)
    5.2
    """
    mean = 1.0 / (1.0 + ratio**2)  # of the error over the difference, and the scale about it
    scale = ratio / (1.0 + ratio**2) / (0.05 * math.pi)
    return scale + math.hypot(scale, mean)


def scattered(
    values: Sequence[float], least: float = 0.0, shares: Sequence[float] | None = None
) -> Error:
    """Return between which bounds a figure lies that depends on what nobody knows.

    Nineteen in twenty further runs lie there, if such figures scatter normally.

    Args:
        values: of runs that have nothing in common any more; the first one is reported.
        least: error, in the figure's unit, on top.
        shares: how far each of the others has got from the first, over the distance of motions
            that have nothing in common: half of it shows half of the scatter. All of it unless
            told.
    """
    apart = np.asarray(values[1:]) - values[0]
    if shares is not None:
        apart = apart / np.minimum(shares, 1.0)
    factor = NINETEEN_IN_TWENTY.get(len(apart), 2.4)
    error = factor * float(np.sqrt(np.mean(apart**2))) + ROUNDING * abs(values[0]) + least
    return _about(values[0], error, determined=error <= LITTLE * abs(values[0]))


def of_both(value: float, one: Error, other: Error, extreme: Extreme) -> Error:
    """Return the error of an extreme over two parts of a motion, each with its own.

    A part whose extreme is far from that of the whole does not count; one that scatters beyond it
    does, although none of the runs has been there.

    Args:
        value: of the whole.
        one: error of the extreme of one part.
        other: of the other part.
        extreme: whether it is the largest or the least.
    """
    outer = max if extreme is Extreme.LARGEST else min
    low, high = outer(one["low"], other["low"]), outer(one["high"], other["high"])
    error = max(high - value, value - low)
    determined = error <= LITTLE * abs(value)
    return {"error": error, "determined": determined, "low": low, "high": high}


def _about(value: float, error: float, *, determined: bool) -> Error:
    return {
        "error": error,
        "determined": determined,
        "low": value - error,
        "high": value + error,
    }
