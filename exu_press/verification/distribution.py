"""Figures over revolutions: mean, scatter and percentiles, and how well each of them is known."""

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result.run import run_once
from exu_press.result.windows import revolutions_of
from exu_press.scene import Scene
from exu_press.terminal.progress import Progress

__all__ = ["BATCHES", "LEAST_REVOLUTIONS", "Distribution", "distributions", "percentiles"]

PERCENTILES = (5.0, 50.0, 95.0)

CONFIDENCE = 0.9

BATCHES = 10
"""Parts of the revolutions that are left out in turn, to see by how much mean and scatter move."""

AT_A_TIME = 8
"""Revolutions of a run, of which the first is left out: it still knows how the run began."""

LEAST_REVOLUTIONS = 59
"""Revolutions: the largest of fewer is below the 95th percentile in more than one case of twenty,
so that this has no upper bound of that confidence."""

MOST_REVOLUTIONS = 126
"""Revolutions after which it is enough, however wide the confidence still is."""

GOLDEN = 180.0 * (5.0**0.5 - 1.0)
"""deg; multiples of it lie evenly about a revolution, however many there are."""


@dataclass(frozen=True)
class Distribution:
    """A figure's values over revolutions, in its unit.

    Attributes:
        revolutions: how many.
        mean: with its standard error.
        scatter: standard deviation, with its standard error.
        percentiles: percentile -> the value, and between which values it lies with a confidence of
            90 %.
    """

    revolutions: int
    mean: tuple[float, float]
    scatter: tuple[float, float]
    percentiles: dict[float, tuple[float, float, float]]

    @classmethod
    def of(cls, values: Sequence[float] | Array) -> Self:
        """Return the distribution of values, one a revolution, two at least, in their order."""
        each = np.asarray(values, dtype=float)
        return cls(
            len(each),
            (float(each.mean()), _jackknife(each, _mean)),
            (float(each.std(ddof=1)), _jackknife(each, _deviation)),
            percentiles([float(value) for value in each]),
        )

    def to_dict(self) -> dict[str, Any]:
        """Return it as files have it."""
        return {
            "revolutions": self.revolutions,
            "mean": dict(zip(("value", "error"), self.mean, strict=True)),
            "scatter": dict(zip(("value", "error"), self.scatter, strict=True)),
            "percentiles": {
                f"{percent:g}": dict(zip(("value", "low", "high"), told, strict=True))
                for percent, told in self.percentiles.items()
            },
        }


def _mean(values: Array) -> float:
    return float(values.mean())


def _deviation(values: Array) -> float:
    return float(values.std(ddof=1))


def _jackknife(values: Array, statistic: Callable[[Array], float]) -> float:
    """Return the standard error of a statistic, by leaving out one batch after the other.

    Revolutions that follow each other depend on each other, batches of them hardly do (B. Efron,
    The Jackknife, the Bootstrap and Other Resampling Plans, SIAM 1982, 3). NaN of fewer values
    than three.
    """
    if len(values) < 3:
        return math.nan
    parts = np.array_split(np.arange(len(values)), min(BATCHES, len(values)))
    found = np.array([statistic(np.delete(values, part)) for part in parts])
    return math.sqrt((len(parts) - 1) * float(((found - found.mean()) ** 2).mean()))


def percentiles(values: Sequence[float]) -> dict[float, tuple[float, float, float]]:
    """Return the percentiles of samples, each with the bounds of its confidence.

    As many samples lie below a percentile as successes are among so many trials, whatever the
    distribution is; so two of the ordered samples are its bounds (H. A. David, H. N. Nagaraja,
    Order Statistics, Wiley 2003, 7.1). Of fewer than LEAST_REVOLUTIONS samples the outermost ones
    are, with less confidence. Revolutions that follow each other are not independent of each other
    for sure; where motion is chaotic, the next one remembers little.
    """
    from scipy.stats import binom  # takes as long to import as a short run

    ordered, count = np.sort(values), len(values)
    tail = 0.5 * (1.0 - CONFIDENCE)
    found = {}
    for percent in PERCENTILES:
        below = binom.cdf(np.arange(count + 1), count, percent / 100.0)
        low, high = np.searchsorted(below, [tail, 1.0 - tail])
        bounds = float(ordered[max(low - 1, 0)]), float(ordered[min(high, count - 1)])
        found[percent] = float(np.percentile(ordered, percent)), *bounds
    return found


def distributions(
    scene: Scene,
    names: Collection[str],
    within: float,
    *,
    least: int = LEAST_REVOLUTIONS,
    most: int = MOST_REVOLUTIONS,
    quiet: bool = True,
) -> dict[str, Distribution]:
    """Return the distribution of figures over revolutions and starts.

    Runs from other crank angles are added until there are `least` revolutions, and the medians are
    known within what is asked for, or there are `most`.

    Args:
        scene: with the tolerance to run it at; its own length and start do not count.
        names: dotted, of figures; those that add up over a run, and those that one revolution does
            not have, are left out.
        within: relative.
        least: revolutions.
        most: revolutions.
        quiet: False shows the progress.

    Raises:
        InputError: a run stopped early.
    """
    declared = {
        name: one
        for name, one in quantities_of(scene).items()
        if name in names and not one.quantity.cumulative
    }
    values: dict[str, list[float]] = {name: [] for name in declared}
    found: dict[str, Distribution] = {}
    count, start = 0, 0
    with Progress("distribution", most, "revolutions", quiet=quiet) as progress:
        while values and count < most:
            angle = (scene.start_angle_deg + GOLDEN * start) % 360.0
            run = run_once(scene.replace({"revolutions": AT_A_TIME, "start_angle_deg": angle}))
            if not run.completed:
                raise InputError(f"no distribution, as a run {run.info['reason']}")
            new = [numbers_of(one, declared) for one in revolutions_of(run)[1:]]
            values = {
                name: [*so_far, *(one[name] for one in new)]
                for name, so_far in values.items()
                if all(name in one for one in new)
            }
            count, start = count + len(new), start + 1
            progress.update(count)
            found = {name: Distribution.of(each) for name, each in values.items()}
            if count >= least and all(_known(one, within) for one in found.values()):
                break
    return found


def _known(found: Distribution, within: float) -> bool:
    median, low, high = found.percentiles[50.0]
    return max(high - median, median - low) <= within * abs(median)
