"""Quantities over revolutions: mean, scatter and percentiles, with their errors.

Two parts make each error: the statistics of finitely many revolutions, and the discretization error
of a revolution, from pairs of revolutions that begin in one state, at the scene's tolerance and at
a finer one.
"""

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Self

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.run import run_once
from exu_press.result.windows import revolutions_of
from exu_press.scene import Scene
from exu_press.terminal.progress import Progress
from exu_press.verification.estimate import ORDERS
from exu_press.verification.refinement import step_changes

__all__ = [
    "BATCHES",
    "FINER",
    "LEAST_REVOLUTIONS",
    "Distribution",
    "discretization_error",
    "distributions",
    "finer",
    "percentiles",
]

FINER = 0.1
"""Tolerance (or fixed step) of the finer revolution of a pair, over the scene's."""

PAIRS = 5
"""Pairs of revolutions for the discretization error."""

PERCENTILES = (5.0, 50.0, 95.0)

CONFIDENCE = 0.9

BATCHES = 10
"""Batches of revolutions of the jackknife."""

AT_A_TIME = 8
"""Revolutions of a run; the first one, which depends on the start, is left out."""

LEAST_REVOLUTIONS = 59
"""Revolutions: with fewer, the largest one is no upper bound of the 95th percentile with 95 %
confidence."""

MOST_REVOLUTIONS = 126
"""Revolutions at most, however wide the confidence interval still is."""

GOLDEN = 180.0 * (5.0**0.5 - 1.0)
"""deg; its multiples are evenly distributed over a revolution, however many there are."""


@dataclass(frozen=True)
class Distribution:
    """Distribution of a quantity over revolutions, in its unit.

    Attributes:
        mean: with its error.
        scatter: standard deviation, with its error.
        percentiles: percentile -> value and its bounds of 90 % confidence, widened by the
            discretization error.
    """

    revolutions: int
    mean: tuple[float, float]
    scatter: tuple[float, float]
    percentiles: dict[float, tuple[float, float, float]]

    @classmethod
    def from_values(cls, values: Sequence[float] | Array, discretization: float = 0.0) -> Self:
        """Return the distribution of values.

        Args:
            values: of consecutive revolutions, two at least.
            discretization: error of each, see `discretization_error`.
        """
        array = np.asarray(values, dtype=float)
        return cls(
            len(array),
            (float(array.mean()), _jackknife(array, np.mean) + discretization),
            (float(array.std(ddof=1)), _jackknife(array, partial(np.std, ddof=1)) + discretization),
            {
                percent: (value, low - discretization, high + discretization)
                for percent, (value, low, high) in percentiles(array.tolist()).items()
            },
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the entry of a file."""
        return {
            "revolutions": self.revolutions,
            "mean": dict(zip(("value", "error"), self.mean, strict=True)),
            "scatter": dict(zip(("value", "error"), self.scatter, strict=True)),
            "percentiles": {
                f"{percent:g}": dict(zip(("value", "low", "high"), bounds, strict=True))
                for percent, bounds in self.percentiles.items()
            },
        }


def _jackknife(values: Array, statistic: Callable[[Array], Any]) -> float:
    """Return half the 95 % confidence interval of a statistic, by the jackknife over batches.

    Consecutive revolutions are correlated, batches of them hardly are (B. Efron, The Jackknife, the
    Bootstrap and Other Resampling Plans, SIAM 1982, 3). NaN of fewer values than three.
    """
    if len(values) < 3:
        return math.nan
    batches = np.array_split(np.arange(len(values)), min(BATCHES, len(values)))
    estimates = np.array([statistic(np.delete(values, batch)) for batch in batches])
    deviation = math.sqrt((len(batches) - 1) * float(((estimates - estimates.mean()) ** 2).mean()))
    return _student(len(batches)) * deviation


def _student(count: int) -> float:
    """Return Student's t of the 95 % confidence interval of a mean of so many values."""
    from scipy.stats import t  # takes as long to import as a short run

    return float(t.ppf(0.975, count - 1))


def discretization_error(differences: Sequence[float]) -> float:
    """Return the mean discretization error of a quantity, from its differences in pairs of runs.

    It is the mean difference and its confidence interval: where a motion amplifies errors within a
    revolution, differences scatter.

    >>> round(discretization_error([1.0, 1.0]), 3)
    1.335
    """
    values = np.asarray(differences)
    uncertainty = _student(len(values)) * values.std(ddof=1) / math.sqrt(len(values))
    return (abs(float(values.mean())) + float(uncertainty)) / float(
        1.0 - FINER ** ORDERS["tolerance"]
    )


def finer(scene: Scene) -> Scene:
    """Return a scene at FINER times its tolerance, or fixed step."""
    return scene.replace(step_changes(scene, FINER))


def percentiles(values: Sequence[float]) -> dict[float, tuple[float, float, float]]:
    """Return the percentiles of samples, each with its bounds of confidence.

    The number of samples below a percentile is binomial, so that two of the ordered samples are its
    bounds, whatever the distribution (H. A. David, H. N. Nagaraja, Order Statistics, Wiley 2003,
    7.1). Of fewer than LEAST_REVOLUTIONS samples the outermost ones are, with less confidence.
    """
    from scipy.stats import binom  # takes as long to import as a short run

    ordered, count = np.sort(values), len(values)
    tail = 0.5 * (1.0 - CONFIDENCE)
    bounds_by_percent = {}
    for percent in PERCENTILES:
        cumulative = binom.cdf(np.arange(count + 1), count, percent / 100.0)
        low, high = np.searchsorted(cumulative, [tail, 1.0 - tail])
        bounds = float(ordered[max(low - 1, 0)]), float(ordered[min(high, count - 1)])
        bounds_by_percent[percent] = float(np.percentile(ordered, percent)), *bounds
    return bounds_by_percent


def distributions(
    scene: Scene,
    names: Collection[str],
    tolerance: float,
    *,
    minimum: int = LEAST_REVOLUTIONS,
    maximum: int = MOST_REVOLUTIONS,
    quiet: bool = True,
) -> dict[str, Distribution]:
    """Return the distribution of quantities over revolutions and starts.

    Runs from other crank angles are added until there are `minimum` revolutions and the medians are
    known within the tolerance, or until there are `maximum`.

    Args:
        scene: its length and start do not count.
        names: of quantities, dotted; sums over a run, and quantities that one revolution does not
            have, are left out.
        tolerance: relative error of the medians.
        minimum: revolutions.
        maximum: revolutions.

    Raises:
        InputError: a run stopped early.
    """
    declared = {
        name: placed
        for name, placed in quantities_of(scene).items()
        if name in names and not placed.quantity.cumulative
    }
    values: dict[str, list[float]] = {name: [] for name in declared}
    differences: dict[str, list[float]] = {name: [] for name in declared}
    estimates: dict[str, Distribution] = {}
    count, start = 0, 0
    with Progress("distribution", maximum, "revolutions", quiet=quiet) as progress:
        while values and count < maximum:
            angle = (scene.start_angle_deg + GOLDEN * start) % 360.0
            run = run_once(scene.replace({"revolutions": AT_A_TIME, "start_angle_deg": angle}))
            _check(run)
            if start < PAIRS:
                placed, two = (numbers_of(sample, declared) for sample in _pair(run))
                for name in differences:
                    differences[name].append(placed.get(name, math.nan) - two.get(name, math.nan))
            revolutions = [numbers_of(placed, declared) for placed in revolutions_of(run)[1:]]
            values = {
                name: [*so_far, *(placed[name] for placed in revolutions)]
                for name, so_far in values.items()
                if all(name in placed for placed in revolutions)
            }
            count, start = count + len(revolutions), start + 1
            progress.update(count)
            if start >= 2:
                estimates = {
                    name: Distribution.from_values(
                        sample, 2.0 * discretization_error(differences[name])
                    )  # its state, too
                    for name, sample in values.items()
                }
            if (
                start > 1
                and count >= minimum
                and all(_is_median_known(placed, tolerance) for placed in estimates.values())
            ):
                break
    return estimates


def _pair(run: Result) -> Iterator[Result]:
    """Yield the revolution after a run at the run's tolerance and at a finer one."""
    scene = run.scene.replace({"revolutions": 1.0, "settle": 0.0})
    for variant in (scene, finer(scene)):
        revolution = run_once(variant, start=run.info["state"])
        _check(revolution)
        yield revolution


def _check(run: Result) -> None:
    if not run.completed:
        raise InputError(f"no distribution, as a run {run.info['reason']}")


def _is_median_known(distribution: Distribution, tolerance: float) -> bool:
    median, low, high = distribution.percentiles[50.0]
    return max(high - median, median - low) <= tolerance * abs(median)
