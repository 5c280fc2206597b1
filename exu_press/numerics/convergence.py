"""Observed order of convergence, and the error that differences between levels show.

With n steps a result is off by C n^-p. Levels of n, r1 n and r1 r2 n steps differ by
d1 = C n^-p (1 - r1^-p) and d2 = C (r1 n)^-p (1 - r2^-p), so that d1/d2 = (r1^p - 1)/(1 - r2^-p)
gives the order p, and the last level is off by d2/(r2^p - 1) (Roache, Verification and Validation
in Computational Science and Engineering, 1998, chapter 5).
"""

from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["ORDER", "PLAUSIBLE", "SAFETY", "Judgement", "judge"]

PLAUSIBLE = 0.5, 4.0
"""Plausible observed orders."""

ORDER = 2.0
"""Of generalized-alpha: the upper limit of the order that errors are computed with."""

SAFETY = 1.5
"""Stated error over the extrapolated one."""

PEAKS = 3.0
"""The same for peaks: at a few instants two levels may agree by chance."""

SMALL = 0.1
"""Difference over the tolerance below which its order does not matter."""

ORDERS = np.linspace(-10.0, 20.0, 3001) + 1e-4  # never 0


@dataclass(frozen=True)
class Judgement:
    """Error estimate of the last of three levels.

    Stated error of each quantity (relative) and of each sensor's peak (in its unit), the largest
    error, its observed order, and whether all orders that matter are plausible.
    """

    errors: Array
    peaks: Array
    error: float
    order: float
    decided: bool


def judge(
    steps: list[int], differences: list[Array], peaks: list[Array], tolerance: float
) -> Judgement:
    """Return the error estimate of the last of three levels.

    Args:
        steps: of the levels, the coarsest first.
        differences: relative ones of the first two levels, and of the last two, (quantities,).
        peaks: likewise, differences of the sensors where they peak, in their units.
        tolerance: relative.
    """
    r1, r2 = steps[1] / steps[0], steps[2] / steps[1]
    ratios = np.log(np.abs((r1**ORDERS - 1.0) / (1.0 - r2**-ORDERS)))
    with np.errstate(invalid="ignore"):
        first, second = np.log(np.maximum(differences, np.finfo(float).tiny))
        orders = np.interp(np.nan_to_num(first - second), ratios, ORDERS)
    believed = np.clip(orders, PLAUSIBLE[0], ORDER)
    errors = SAFETY * differences[1] / (r2**believed - 1.0)
    matter = orders[differences[1] > SMALL * tolerance]
    of_values = believed[len(believed) - 1 - len(peaks[0]) : -1]
    of_first = peaks[0] / (r1**of_values - 1.0) / r2**of_values
    return Judgement(
        errors=errors,
        peaks=PEAKS * np.maximum(of_first, peaks[1] / (r2**of_values - 1.0)),
        error=float(errors.max()),
        order=float(orders[errors.argmax()]),
        decided=bool(((matter >= PLAUSIBLE[0]) & (matter <= PLAUSIBLE[1])).all()),
    )
