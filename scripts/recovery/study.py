"""Fit synthetic measurements of each scene, and count the intervals that hold the true keys."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.studies.base import Runs, Study
from exu_press.studies.base.evaluation import with_errors_of
from exu_press.studies.fit import Fit, FitReport
from exu_press.studies.fit.problem import Problem
from exu_press.studies.fit.run import fit_problem
from recovery.cases import CASES, Case

__all__ = ["Recovered", "recover", "synthetic"]


@dataclass(frozen=True)
class Recovered:
    """What the fits of one scene gave.

    Attributes:
        truth: the true keys.
        reports: of each measurement.
        runs: how many different ones there were.
    """

    truth: Mapping[str, float]
    reports: list[FitReport]
    runs: int

    def held(self, key: str) -> int:
        """Return in how many measurements the interval of a key holds its true value."""
        return sum(one.low[key] <= self.truth[key] <= one.high[key] for one in self.reports)


def synthetic(case: Case, exact: Mapping[str, float], rng: Any) -> list[dict[str, Any]]:
    """Return a measurement: exact numbers with normal noise."""
    found = []
    for name, part in case.numbers.items():
        deviation = part * abs(exact[name])
        value = exact[name] + deviation * float(rng.standard_normal())
        found.append({"quantity": name, "value": value, "uncertainty": deviation})
    return found


def recover(
    name: str, directory: Path, *, measurements: int | None = None, **how: Any
) -> Recovered:
    """Return what fits of a scene's synthetic measurements give.

    Measurements share their runs: equal scenes are run once, as in one study.

    Args:
        name: of a case.
        directory: of its runs.
        measurements: fewer than the case has.
        how: workers, quiet.
    """
    case = CASES[name]
    wrong = case.scene.replace(
        {
            key: (each["low"] * each["high"]) ** 0.5 if each.get("log") else each["low"]
            for key, each in case.keys.items()
        }
    )
    base = Study(scene=wrong, keys=case.keys)
    rng = np.random.default_rng(1)
    with Runs(base, directory, label=name, **how) as runs:
        (row,) = runs.run_scenes([case.scene])
        reports = []
        for _ in range(measurements or case.measurements):
            numbers = synthetic(case, row, rng)
            given: dict[str, Any] = {"keys": case.keys, "measured": numbers, "fit": {"starts": 1}}
            study = Fit(scene=wrong, **given)
            problem = Problem(study, directory, runs.run_scenes)
            reports.append(
                fit_problem(
                    problem,
                    lambda x, p=problem: with_errors_of(base, directory, p.scenes(x), **how),
                )
            )
    lines = (directory / "runs.jsonl").read_text(encoding="utf-8").splitlines()
    return Recovered(case.truth, reports, len(lines))
