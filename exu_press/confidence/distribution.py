"""What is determined of a figure where motion is chaotic: its distribution over revolutions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from exu_press.confidence.figures import figures
from exu_press.confidence.windows import revolutions_of
from exu_press.errors import InputError
from exu_press.scene import Scene
from exu_press.simulation import simulate

__all__ = ["CUMULATED", "Distribution", "distribution", "percentiles"]

PERCENTILES = (5.0, 50.0, 95.0)

CONFIDENCE = 0.9

AT_A_TIME = 8
"""Revolutions of a run, of which the first is left out: it still knows how the run began."""

MOST = 64
"""Revolutions after which it is enough, however wide the confidence still is."""

APART = 0.01
"""Relative: by how much the tolerances of runs differ, so that they have nothing in common."""

CUMULATED = ("energy.", "losses.", ".dissipated")
"""In the names of figures that add up over a run."""


@dataclass(frozen=True)
class Distribution:
    """A figure's values over revolutions.

    Attributes:
        revolutions: how many.
        percentiles: percentile -> the value, and between which values it lies with a confidence of
            90 %, in the figure's unit.
    """

    revolutions: int
    percentiles: dict[float, tuple[float, float, float]]


def percentiles(values: Sequence[float]) -> dict[float, tuple[float, float, float]]:
    """Return the percentiles of samples with the bounds of their confidence, by the bootstrap.

    Revolutions that follow each other are not independent of each other for sure; where motion is
    chaotic enough for a distribution, the next one remembers little.
    """
    samples = np.asarray(values)
    random = np.random.default_rng(1)
    drawn = random.choice(samples, (2000, len(samples)))
    found = {}
    for percent in PERCENTILES:
        of_draws = np.percentile(drawn, percent, axis=1)
        low, high = np.quantile(of_draws, [0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2])
        found[percent] = float(np.percentile(samples, percent)), float(low), float(high)
    return found


def distribution(scene: Scene, name: str, within: float, most: int = MOST) -> Distribution:
    """Return the distribution of a figure over revolutions and starts.

    Runs that differ by a hundredth of their tolerance are added until the median is known within
    what is asked for, or there are `most` revolutions.

    Args:
        scene: with the tolerance to run it at; its own length does not count.
        name: dotted, of a figure that does not add up over a run.
        within: relative.
        most: revolutions.

    Raises:
        InputError: a run stopped early, or the figure adds up.
    """
    if any(part in name for part in CUMULATED):
        raise InputError(f"{name}: adds up over a run; allowed are figures of a revolution")
    assert scene.solver is not None
    rate = "solver.step" if scene.solver.tolerance is None else "solver.tolerance"
    usual = scene.solver.step or scene.solver.tolerance
    assert usual is not None
    values: list[float] = []
    start = 0
    while True:
        change = {"revolutions": float(AT_A_TIME), rate: usual * (1.0 + APART * start)}
        run = simulate(scene.replace(change))
        if not run.completed:
            raise InputError(f"{name}: no distribution, as a run {run.info['reason']}")
        values += [figures(one.summary())[name] for one in revolutions_of(run)[1:]]
        found = percentiles(values)
        median, low, high = found[50.0]
        if len(values) >= most or max(high - median, median - low) <= within * abs(median):
            return Distribution(len(values), found)
        start += 1
