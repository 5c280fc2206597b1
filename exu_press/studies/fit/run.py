"""Find keys of a scene from a measurement: best values, intervals, keys left undetermined."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.studies.base import Runs
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.base.evaluation import with_errors_of
from exu_press.studies.fit.determined import determined
from exu_press.studies.fit.jacobian import Failed, jacobian, steps
from exu_press.studies.fit.minimum import Minimum, evolved, screened, searched
from exu_press.studies.fit.problem import Problem, file_of
from exu_press.studies.fit.profile import Interval, profile
from exu_press.studies.fit.report import FitReport
from exu_press.studies.fit.study import EVOLUTION, Fit

__all__ = ["FitCommand", "fit", "fitted"]

SEARCHES_AGAIN = 2
"""At most, where an interval has met a better point."""


def fit(study: Fit, directory: str | Path, **how: Any) -> FitReport:
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
    with Runs(study, directory, report=FitReport, **how) as runs:

        def run(scenes: Any) -> Any:
            return runs.of(scenes, [file_of(scene) for scene in scenes] if study.curve else ())

        problem = Problem(study, directory, run)

        def checked(x: Array) -> Any:
            return with_errors_of(study, directory, problem.scenes(x), **how)

        report = fitted(problem, checked)
    report.save(directory)
    return report


def fitted(problem: Problem, checked: Any) -> FitReport:
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
) -> FitReport:  # fmt: skip
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
    return FitReport(
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
        run_summary=problem.evaluation.told(),
    )


class FitCommand(StudyCommand):
    """`exu-press fit`."""

    example = "exu-press fit measured.toml --out out/measured"
    study = Fit
    run = staticmethod(fit)
