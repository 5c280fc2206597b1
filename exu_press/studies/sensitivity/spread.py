"""Spread of a quantity due to tolerances: percentiles, and the range of most presses."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.stats import bootstrap

from exu_press.numerics.arrays import Array

__all__ = ["TORNADO", "Spread", "spread", "tornado"]

TORNADO = (0.05, 0.95)
"""Shares of a key's distribution at the ends of its bar."""

RESAMPLES = 999


@dataclass(frozen=True)
class Spread:
    """The distribution of one quantity, in its unit.

    Attributes:
        low, middle, high: 5, 50 and 95 % lie below.
        half: distance from the median within which the share lies.
        half_error: its standard error, by resampling.
    """

    low: float
    middle: float
    high: float
    mean: float
    deviation: float
    half: float
    half_error: float


def spread(values: Array, share: float) -> Spread:
    """Return the distribution of a sample (m,).

    >>> spread(np.linspace(-1.0, 1.0, 2001), 0.95).half
    0.95
    """
    low, middle, high = np.percentile(values, [5.0, 50.0, 95.0])
    resampled = bootstrap(
        [values], lambda x, axis: _half(x, share, axis), n_resamples=RESAMPLES,
        method="percentile", vectorized=True, rng=0,
    )  # fmt: skip
    return Spread(
        float(low),
        float(middle),
        float(high),
        float(values.mean()),
        float(values.std(ddof=1)),
        round(float(_half(values, share, -1)), 15),
        float(resampled.standard_error),
    )


def _half(values: Array, share: float, axis: int) -> Array:
    """Return the distance from the median within which a share of the values lies."""
    distance = np.abs(values - np.median(values, axis=axis, keepdims=True))
    return np.asarray(np.quantile(distance, share, axis=axis))


def tornado(evaluate: Callable[[Array], Array], keys: int) -> tuple[Array, Array]:
    """Return the values with all keys at their medians (s,), and with each at its ends alone.

    Args:
        evaluate: from shares (m, keys) to values (m, s); NaN where a run failed.

    Returns:
        (s,) and (keys, 2, s).
    """
    points = np.full((1 + 2 * keys, keys), 0.5)
    for key in range(keys):
        points[1 + 2 * key : 3 + 2 * key, key] = TORNADO
    values = evaluate(points)
    return values[0], values[1:].reshape(keys, 2, -1)
