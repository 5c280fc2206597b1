"""Run a fit."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.stats import chi2

from exu_press.errors import InputError
from exu_press.files.output_directory import write_json
from exu_press.numerics.arrays import Array
from exu_press.scene import Scene
from exu_press.studies.base import Runs
from exu_press.studies.base.evaluation import with_errors_of
from exu_press.studies.fit.curve import Matched
from exu_press.studies.fit.determined import Determined, determined
from exu_press.studies.fit.jacobian import Failed, jacobian, steps
from exu_press.studies.fit.minimum import Minimum, evolved, screened, searched
from exu_press.studies.fit.problem import Problem, file_of
from exu_press.studies.fit.profile import Interval, profile
from exu_press.studies.fit.study import EVOLUTION, Fit

__all__ = ["Report", "fit", "fitted"]

WRITTEN = ("fit.json", "fitted.toml")

SEARCHES_AGAIN = 2
"""At most, where an interval has met a better point."""


@dataclass(frozen=True)
class Report:
    """The result of a fit; keys in the study's order.

    Attributes:
        study: whose report this is.
        values: key -> best value.
        low, high: key -> ends of its interval.
        remarks: key -> what a reader has to know of the low and of the high end; mostly empty.
        minima: other minima too, best first.
        lost: starts that led nowhere.
        determined: identifiability of the keys.
        effect: change of all residuals over a key's whole range, (keys,).
        profiles: key -> its values and chi-square above the least, (points, 2).
        count: independent numbers less the sensors' parameters.
        numbers: computed beside [[measured]].
        curves: measured and computed beside [[curve]].
        errors: of runs over the uncertainties, of numbers and of samples of curves, (numbers,).
        scene: fitted.
        told: how many runs gave numbers, in lines.
    """

    study: Fit
    values: dict[str, float]
    low: dict[str, float]
    high: dict[str, float]
    remarks: dict[str, tuple[str, str]]
    minima: list[Minimum]
    lost: int
    determined: Determined
    effect: Array
    profiles: dict[str, Array]
    count: float
    numbers: list[float]
    curves: list[tuple[Array, Matched]]
    errors: Array
    scene: Scene
    told: list[str]

    @property
    def largest_error(self) -> float:
        """Return that of a run in a number or a sample of a curve, over its uncertainty."""
        return float(self.errors.max(initial=0.0))

    @property
    def chi_square(self) -> float:
        """Sum of squared residuals over their uncertainties."""
        return self.minima[0].chi_square

    @property
    def freedom(self) -> float:
        """Numbers less the combinations of keys that they determine."""
        return self.count - self.determined.rank

    @property
    def probability(self) -> float | None:
        """Return the probability that chance makes chi-square as large; None without a degree of
        freedom."""
        return float(chi2.sf(self.chi_square, self.freedom)) if self.freedom > 0.0 else None

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of fit.json."""
        keys = {
            name: {
                "value": value,
                "low": self.low[name],
                "high": self.high[name],
                "low_remark": self.remarks[name][0],
                "high_remark": self.remarks[name][1],
            }
            for name, value in self.values.items()
        }
        correlation = [
            [None if np.isnan(x) else float(x) for x in row] for row in self.determined.correlation
        ]
        return {
            "keys": keys,
            "level": self.study.fit.level,
            "chi_square": self.chi_square,
            "degrees_of_freedom": self.freedom,
            "probability": self.probability,
            "correlation": correlation,
            "not_determined": [one.vector.tolist() for one in self.determined.open],
            "singular_values": self.determined.singular.tolist(),
            "minima": [[one.chi_square, one.times] for one in self.minima],
            "measured": [
                {"name": one.name, "value": one.value, "uncertainty": one.uncertainty,
                 "computed": number, "error_over_uncertainty": float(error)}
                for one, number, error in zip(
                    self.study.measured, self.numbers, self.errors, strict=False
                )
            ],
            "sensors": {
                one.name: told.plain()
                for one, (_, told) in zip(self.study.curve, self.curves, strict=True)
            },
            "curves": {
                one.name: {
                    "channel": one.read.name,
                    "unit": told.unit,
                    "across": "time, s" if one.read.over == "time" else "crank angle, deg",
                    "at": one.read.at.tolist(),
                    "measured": wanted.tolist(),
                    "computed": told.values.tolist(),
                }
                for one, (wanted, told) in zip(self.study.curve, self.curves, strict=True)
            },
            "profiles": {name: points.tolist() for name, points in self.profiles.items()},
            "largest_error_over_uncertainty": self.largest_error,
            "runs": self.told,
        }  # fmt: skip


def fit(study: Fit, directory: str | Path, **how: Any) -> Report:
    """Do the runs that are missing, write fit.json and fitted.toml, and return the result.

    Called again after a kill or Ctrl-C, it goes on.

    Args:
        study: to be run.
        directory: of this study alone.
        how: workers, dask, quiet of `exu_press.studies.base.Runs`.

    Raises:
        InputError: the directory cannot be used or belongs to another study, no scheduler answers,
            a curve is not in a run, or no run gives numbers.
    """
    directory = Path(directory)
    with Runs(study, directory, written=WRITTEN, label="fit", **how) as runs:

        def run(scenes: Any) -> Any:
            return runs.of(scenes, [file_of(scene) for scene in scenes] if study.curve else ())

        problem = Problem(study, directory, run)

        def checked(x: Array) -> Any:
            return with_errors_of(study, directory, problem.scenes(x), **how)

        report = fitted(problem, checked)
    write_json(directory / "fit.json", report.to_dict())
    report.scene.save(directory / "fitted.toml", overwrite=True)
    return report


def fitted(problem: Problem, checked: Any) -> Report:
    """Search, look for the intervals, and search again where these met a better point.

    Args:
        problem: to be fitted.
        checked: returns the rows with errors at a scaled point, one for each place of measuring.

    Raises:
        InputError: a curve is not in a run, or no run gives numbers.
    """
    study = problem.study
    names, asked = list(study.keys), study.fit
    start = np.full(len(names), 0.5)
    for place, name in enumerate(names):
        if name in study.start:
            start[place] = problem.scaled(name, study.start[name])
    if study.curve:
        problem(start[None])
        problem.check_curves(start, checked(start))
    starts = screened(problem, len(names), asked.starts, asked.seed, start)
    if not starts:
        raise InputError(
            f"{'; '.join(problem.evaluation.told())}: no start; the cure is narrower ranges, or "
            "what the runs' reasons say"
        )
    first = starts[0]
    problem.renew_errors(first.x, checked)
    starts = _evaluated(problem, starts)
    step = steps(problem, first.x, starts[0].residuals, problem.errors)
    lost = 0
    if asked.method == EVOLUTION:
        found = evolved(problem, len(names), asked.generations, asked.seed)
        minima = [found] if found is not None else []
    else:
        minima, lost = searched(problem, starts, step)
    if not minima:
        raise InputError(
            f"{'; '.join(problem.evaluation.told())}: no search came to an end; the cure is "
            "narrower ranges, or what the runs' reasons say"
        )
    for _ in range(SEARCHES_AGAIN + 1):
        if problem.renew_errors(minima[0].x, checked):
            minima, _ = searched(problem, _evaluated(problem, minima), step)
        best = minima[0]
        try:
            derivative = jacobian(problem, best.x, best.residuals, step)
        except Failed:
            raise InputError(
                f"all runs beside the best point failed ({'; '.join(problem.evaluation.told())}); "
                "the cure is narrower ranges"
            ) from None
        intervals = [profile(problem, best, derivative, k, asked.level) for k in range(len(names))]
        better = [one.better for one in intervals if one.better is not None]
        if not better:
            break
        lower = min(better, key=lambda one: one.chi_square)
        again, _ = searched(problem, [lower], step)
        minima = sorted([*again, lower, *minima[1:]], key=lambda one: one.chi_square)
    return _report(problem, minima, lost, derivative, intervals)


def _evaluated(problem: Problem, minima: list[Minimum]) -> list[Minimum]:
    """Return points with their residuals as the runs' errors are known now, best first."""
    residuals = problem(np.array([one.x for one in minima]))
    new = [replace(one, residuals=row) for one, row in zip(minima, residuals, strict=True)]
    return sorted(new, key=lambda one: one.chi_square)


def _report(
    problem: Problem, minima: list[Minimum], lost: int, derivative: Array,
    intervals: list[Interval],
) -> Report:  # fmt: skip
    study, best = problem.study, minima[0]
    names = list(study.keys)

    def value(place: int, share: float) -> float:
        x = best.x.copy()
        x[place] = share
        return problem.point(x)[names[place]]

    numbers, curves = problem.computed(best.x)
    profiles = {}
    for n, name in enumerate(names):
        table = intervals[n].points
        profiles[name] = np.column_stack([[value(n, s) for s in table[:, 0]], table[:, 1]])
    return Report(
        study=study,
        values=problem.point(best.x),
        low={name: value(n, intervals[n].low.value) for n, name in enumerate(names)},
        high={name: value(n, intervals[n].high.value) for n, name in enumerate(names)},
        remarks={
            name: (interval.low.remark, interval.high.remark)
            for name, interval in zip(names, intervals, strict=True)
        },
        minima=minima,
        lost=lost,
        determined=determined(derivative, study.fit.level),
        effect=np.linalg.norm(derivative, axis=0),
        profiles=profiles,
        count=problem.count,
        numbers=numbers,
        curves=[(wanted, told) for wanted, told in curves if told is not None],
        errors=np.abs(problem.errors),
        scene=study.scene_at(problem.point(best.x)),
        told=problem.evaluation.told(),
    )
