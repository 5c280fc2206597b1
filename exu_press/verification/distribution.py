"""Figures over revolutions: mean, scatter and percentiles, and how well each of them is known.

Two parts make the error of each: the statistics of finitely many revolutions, and what the steps of
a revolution miss, from pairs of revolutions that begin in one state, at the scene's tolerance and
at a finer one.
"""

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
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
from exu_press.verification.estimate import ORDER

__all__ = [
    "BATCHES",
    "FINER",
    "LEAST_REVOLUTIONS",
    "Distribution",
    "distributions",
    "finer",
    "of_steps",
    "percentiles",
]

FINER = 0.1
"""Tolerance (or fixed step) of a revolution that tells what another one misses, over its own."""

FINEST = 1e-8
"""No revolution has a finer tolerance."""

PAIRS = 5
"""Pairs of revolutions that are compared."""

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
        mean: with its error.
        scatter: standard deviation, with its error.
        percentiles: percentile -> the value, and between which values it lies with a confidence of
            90 % by the statistics, each further out by what steps miss.
    """

    revolutions: int
    mean: tuple[float, float]
    scatter: tuple[float, float]
    percentiles: dict[float, tuple[float, float, float]]

    @classmethod
    def of(cls, values: Sequence[float] | Array, missed: float = 0.0) -> Self:
        """Return the distribution of values.

        Args:
            values: one a revolution, two at least, in their order.
            missed: error of each by the steps, as `of_steps` returns it.
        """
        each = np.asarray(values, dtype=float)
        return cls(
            len(each),
            (float(each.mean()), _jackknife(each, _mean) + missed),
            (float(each.std(ddof=1)), _jackknife(each, _deviation) + missed),
            {
                percent: (value, low - missed, high + missed)
                for percent, (value, low, high) in percentiles(each.tolist()).items()
            },
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
    """Return half of a statistic's interval of 95 %, by leaving out one batch after the other.

    Revolutions that follow each other depend on each other, batches of them hardly do (B. Efron,
    The Jackknife, the Bootstrap and Other Resampling Plans, SIAM 1982, 3). NaN of fewer values
    than three.
    """
    if len(values) < 3:
        return math.nan
    parts = np.array_split(np.arange(len(values)), min(BATCHES, len(values)))
    found = np.array([statistic(np.delete(values, part)) for part in parts])
    deviation = math.sqrt((len(parts) - 1) * float(((found - found.mean()) ** 2).mean()))
    return _student(len(parts)) * deviation


def _student(count: int) -> float:
    """Return half of the interval of 95 % over the standard error of a mean of so many values."""
    from scipy.stats import t  # takes as long to import as a short run

    return float(t.ppf(0.975, count - 1))


def of_steps(apart: Sequence[float]) -> float:
    """Return what steps miss of a figure in the mean, from its differences in two pairs or more.

    It is what all of them have in common, and how well that is known: where a motion amplifies
    errors within a revolution, differences scatter.

    >>> round(of_steps([1.0, 1.0]), 3)
    1.462
    """
    values = np.asarray(apart)
    known = _student(len(values)) * values.std(ddof=1) / math.sqrt(len(values))
    return (abs(float(values.mean())) + float(known)) / float(1.0 - FINER**ORDER)


def finer(scene: Scene) -> Scene:
    """Return a scene at FINER times its tolerance, or fixed step."""
    solver = scene.solver
    assert solver is not None
    if solver.tolerance is None:
        assert solver.step is not None
        return scene.replace({"solver.step": FINER * solver.step})
    return scene.replace(
        {
            "solver.tolerance": max(FINER * solver.tolerance, FINEST),
            "solver.max_step_deg": math.sqrt(FINER) * solver.max_step_deg,
        }
    )


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
    apart: dict[str, list[float]] = {name: [] for name in declared}
    found: dict[str, Distribution] = {}
    count, start = 0, 0
    with Progress("distribution", most, "revolutions", quiet=quiet) as progress:
        while values and count < most:
            angle = (scene.start_angle_deg + GOLDEN * start) % 360.0
            run = run_once(scene.replace({"revolutions": AT_A_TIME, "start_angle_deg": angle}))
            _check(run)
            if start < PAIRS:
                one, two = (numbers_of(each, declared) for each in _pair(run))
                for name in apart:
                    apart[name].append(one.get(name, math.nan) - two.get(name, math.nan))
            new = [numbers_of(one, declared) for one in revolutions_of(run)[1:]]
            values = {
                name: [*so_far, *(one[name] for one in new)]
                for name, so_far in values.items()
                if all(name in one for one in new)
            }
            count, start = count + len(new), start + 1
            progress.update(count)
            if start >= 2:
                found = {
                    name: Distribution.of(each, 2.0 * of_steps(apart[name]))  # its state, too
                    for name, each in values.items()
                }
            if start > 1 and count >= least and all(_known(one, within) for one in found.values()):
                break
    return found


def _pair(run: Result) -> Iterator[Result]:
    """Yield the revolution after a run at the run's tolerance and at a finer one."""
    scene = run.scene.replace({"revolutions": 1.0, "settle": 0.0})
    for each in (scene, finer(scene)):
        revolution = run_once(each, start=run.info["state"])
        _check(revolution)
        yield revolution


def _check(run: Result) -> None:
    if not run.completed:
        raise InputError(f"no distribution, as a run {run.info['reason']}")


def _known(found: Distribution, within: float) -> bool:
    median, low, high = found.percentiles[50.0]
    return max(high - median, median - low) <= within * abs(median)
