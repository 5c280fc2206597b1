"""Find keys of a scene from a measurement: best values, intervals, undetermined keys."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.studies.base import Runs
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.base.evaluation import with_errors_of
from exu_press.studies.fit.identifiability import identifiability
from exu_press.studies.fit.jacobian import EvaluationError, jacobian, steps
from exu_press.studies.fit.minimum import Minimum, evolve, search_minima, select_starts
from exu_press.studies.fit.problem import Problem, file_of
from exu_press.studies.fit.profile import Interval, profile
from exu_press.studies.fit.report import FitReport
from exu_press.studies.fit.study import EVOLUTION, Fit

__all__ = ["FitCommand", "fit", "fit_problem"]

REPEATED_SEARCHES = 2
"""Most further searches, from better points of a profile."""


def fit(study: Fit, directory: str | Path, **how: Any) -> FitReport:
    """Do the runs that are missing, write fit.json and fitted.toml, and return the result.

    Arguments and errors are those of `exu_press.studies.base.Runs`.

    Raises:
        InputError: also where a curve is not in a run, or no run gives numbers.
    """
    directory = Path(directory)
    with Runs(study, directory, report=FitReport, **how) as runs:

        def run(scenes: Any) -> Any:
            return runs.run_scenes(
                scenes, [file_of(scene) for scene in scenes] if study.curve else ()
            )

        problem = Problem(study, directory, run)

        def run_with_errors(x: Array) -> Any:
            return with_errors_of(study, directory, problem.scenes(x), **how)

        report = fit_problem(problem, run_with_errors)
    report.save(directory)
    return report


def fit_problem(problem: Problem, run_with_errors: Any) -> FitReport:
    """Search minima and intervals, and repeat the search from better points of the intervals.

    Args:
        run_with_errors: returns the rows with errors at a scaled point, one for each condition of
            measurement.
    """
    study = problem.study
    names, settings = list(study.keys), study.fit
    start = np.full(len(names), 0.5)
    for number, name in enumerate(names):
        if name in study.start:
            start[number] = problem.scale(name, study.start[name])
    if study.curve:
        problem(start[None])
        problem.check_curves(start, run_with_errors(start))
    starts = select_starts(problem, len(names), settings.starts, settings.seed, start)
    if not starts:
        raise InputError(
            f"{problem.evaluation.summary_line()}: no start; the cure is narrower ranges, or "
            "what the runs' reasons say"
        )
    first = starts[0]
    problem.renew_errors(first.x, run_with_errors)
    starts = _reevaluate(problem, starts)
    step = steps(problem, first.x, starts[0].residuals, problem.errors)
    diverged = 0
    if settings.method == EVOLUTION:
        minimum = evolve(problem, len(names), settings.generations, settings.seed)
        minima = [] if minimum is None else [minimum]
    else:
        minima, diverged = search_minima(problem, starts, step)
    if not minima:
        raise InputError(
            f"{problem.evaluation.summary_line()}: no search came to an end; the cure is "
            "narrower ranges, or what the runs' reasons say"
        )
    for _ in range(REPEATED_SEARCHES + 1):
        if problem.renew_errors(minima[0].x, run_with_errors):
            minima, _ = search_minima(problem, _reevaluate(problem, minima), step)
        best = minima[0]
        try:
            derivative = jacobian(problem, best.x, best.residuals, step)
        except EvaluationError:
            raise InputError(
                f"all runs beside the best point failed ({problem.evaluation.summary_line()}); "
                "the cure is narrower ranges"
            ) from None
        intervals = [
            profile(problem, best, derivative, k, settings.level) for k in range(len(names))
        ]
        better = [interval.better for interval in intervals if interval.better is not None]
        if not better:
            break
        lower = min(better, key=lambda m: m.chi_square)
        further, _ = search_minima(problem, [lower], step)
        minima = sorted([*further, lower, *minima[1:]], key=lambda m: m.chi_square)
    return _report(problem, minima, diverged, derivative, intervals)


def _reevaluate(problem: Problem, minima: list[Minimum]) -> list[Minimum]:
    """Return points with residuals by the present errors of runs, best first."""
    residuals = problem(np.array([m.x for m in minima]))
    new = [replace(m, residuals=row) for m, row in zip(minima, residuals, strict=True)]
    return sorted(new, key=lambda m: m.chi_square)


def _report(
    problem: Problem,
    minima: list[Minimum],
    diverged: int,
    derivative: Array,
    intervals: list[Interval],
) -> FitReport:
    study, best = problem.study, minima[0]
    names = list(study.keys)

    def value(number: int, share: float) -> float:
        x = best.x.copy()
        x[number] = share
        return study.point_of(x)[names[number]]

    numbers, curves = problem.compute(best.x)
    profiles = {}
    for n, name in enumerate(names):
        table = intervals[n].points
        profiles[name] = np.column_stack([[value(n, s) for s in table[:, 0]], table[:, 1]])
    return FitReport(
        study=study,
        values=study.point_of(best.x),
        low={name: value(n, intervals[n].low.value) for n, name in enumerate(names)},
        high={name: value(n, intervals[n].high.value) for n, name in enumerate(names)},
        remarks={
            name: (interval.low.remark, interval.high.remark)
            for name, interval in zip(names, intervals, strict=True)
        },
        minima=minima,
        diverged=diverged,
        identifiability=identifiability(derivative, study.fit.level),
        effect=np.linalg.norm(derivative, axis=0),
        profiles=profiles,
        count=problem.count,
        numbers=numbers,
        curves=[(measured, model) for measured, model in curves if model is not None],
        errors=np.abs(problem.errors),
        run_summary=problem.evaluation.run_summary(),
    )


class FitCommand(StudyCommand):
    """`exu-press fit`."""

    example = "exu-press fit measured.toml --out out/measured"
    study = Fit
    run = staticmethod(fit)
