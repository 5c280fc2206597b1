"""Find the keys that make a press best: one objective, or several against each other."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import Row
from exu_press.studies.base import Runs
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.base.evaluation import (
    Evaluation,
    Point,
    error_in,
    numbers_in,
    with_errors_of,
)
from exu_press.studies.optimise.report import OptimiseReport
from exu_press.studies.optimise.several import (
    advise_sampler,
    choose_compromise,
    front,
    search_front,
)
from exu_press.studies.optimise.single import evolve, merit, simplex, spread_points
from exu_press.studies.optimise.study import AUTO, EVOLUTION, NELDER_MEAD, NSGA, TPE, Optimise

__all__ = ["OptimiseCommand", "optimise"]

ROUGH = 0.01
"""Largest error of runs over the objective's spread for a simplex."""

MOST_CHECKED = 12
"""Number of points of a front with errors: evenly along it, and the chosen one."""

FINER = 0.1
"""Tolerance, or step, of the chosen point's second run over the scene's."""

SCREEN = 4
"""Trials over those that are spread over the ranges first, of one objective."""


def optimise(study: Optimise, directory: str | Path, **how: Any) -> OptimiseReport:
    """Do the runs that are missing, write optimise.json, trials.csv and scenes; return the result.

    Arguments and errors are those of `exu_press.studies.base.Runs`.

    Raises:
        InputError: also where optuna is needed and not installed, an objective does not move, or no
            run keeps the limits.
    """
    directory = Path(directory)
    with Runs(study, directory, report=OptimiseReport, **how) as runs:
        trials = Evaluation(study, study.quantities, runs.run_scenes)

        def run_with_errors(points: Sequence[Point]) -> list[Row]:
            return with_errors_of(study, directory, [study.scene_at(p) for p in points], **how)

        method, why = _search(study, trials, run_with_errors)
        values, violations = _rate(study, trials.numbers)
        places = list(map(int, front(values, violations)))
        if not places:
            raise InputError(_none_within(trials, violations))
        weights = [objective.weight for objective in study.objective]
        best = choose_compromise(values[places], weights)
        chosen = study.scene_at(trials.points[places[best]])
        name, value = chosen.solver.accuracy
        (row,) = runs.run_scenes([chosen.replace({f"solver.{name}": FINER * value})])
    names = list(dict.fromkeys(study.quantities))
    few = sorted({best, *np.linspace(0, len(places) - 1, MOST_CHECKED).astype(int).tolist()})
    rows = run_with_errors([trials.points[places[n]] for n in few])
    errors = {name: np.full(len(places), np.nan) for name in names}
    for n, row_with_errors in zip(few, rows, strict=True):
        for name in names:
            error = error_in(row_with_errors, name)
            errors[name][n] = np.nan if error is None else error
    finer = dict(zip(names, numbers_in(row, names), strict=True))
    report = OptimiseReport(
        study, method, why, trials, places, best, errors,
        {name: value for name, value in finer.items() if np.isfinite(value)}, trials.run_summary(),
    )  # fmt: skip
    report.save(directory)
    return report


def _rate(study: Optimise, numbers: Array) -> tuple[Array, Array]:
    """Return objectives (m, s), less is better, and violations of limits (m,) by numbers."""
    count = len(study.objective)
    signs = np.array([objective.sign for objective in study.objective])
    violations = [
        sum(limit.violation(x) for limit, x in zip(study.limit, row[count:], strict=True))
        for row in numbers
    ]
    return numbers[:, :count] * signs, np.array(violations)


def _search(study: Optimise, trials: Evaluation, run_with_errors: Any) -> tuple[str, str]:
    """Run all trials; return the method, and the reason for it."""
    settings, keys = study.optimise, study.keys
    method, number = settings.method, len(study.objective)

    def ask(points: Sequence[Point]) -> tuple[Array, Array]:
        return _rate(study, trials(points))

    if number > 1 or study.has_values or method in (TPE, NSGA):
        why = "asked for"
        if method == AUTO:
            method = advise_sampler(settings.trials)
            why = f"advised for {settings.trials} trials"
        search_front(ask, keys, number, settings.trials, method, settings.seed)
        _demand_movement(study, trials)
        return method, why
    first = spread_points(len(keys), settings.trials // SCREEN, settings.seed)
    values, violations = ask([study.point_of(x) for x in first])
    if not np.isfinite(values).any():
        return NELDER_MEAD if method == AUTO else method, "no run gave numbers"
    _demand_movement(study, trials)
    spread = float(np.nanmax(values) - np.nanmin(values))

    def judge(points: Array) -> Array:
        objectives, excess = ask([study.point_of(x) for x in points])
        return merit(objectives[:, 0], excess, spread)

    why = "asked for"
    if method == AUTO:
        (row,) = run_with_errors([study.point_of(first[0])])
        error = error_in(row, study.objective[0].quantity)
        share = np.inf if error is None else error / spread
        method = EVOLUTION if share > ROUGH else NELDER_MEAD
        why = f"a run's error is {100 * share:.2g} % of the objective's spread"
    remaining = settings.trials - len(first)
    if method == EVOLUTION:
        evolve(judge, len(keys), remaining, settings.seed)
    else:
        start = first[int(merit(values[:, 0], violations, spread).argmin())]
        simplex(judge, start, remaining)
    return method, why


def _demand_movement(study: Optimise, trials: Evaluation) -> None:
    """Raise InputError for an objective that is the same in all runs."""
    for number, objective in enumerate(study.objective):
        values = trials.numbers[:, number]
        values = values[np.isfinite(values)]
        if len(values) > 1 and np.ptp(values) <= 1e-9 * np.abs(values).max():
            raise InputError(
                f"objective {objective.quantity}: is {values[0]:g} in each of {len(values)} runs; "
                "allowed is a quantity that the keys change"
            )


def _none_within(trials: Evaluation, violations: Array) -> str:
    """Return the message that no run keeps the limits, with the nearest one."""
    summary = trials.summary_line()
    if not np.isfinite(trials.numbers).all(axis=1).any():
        return f"{summary}: nothing to choose from"
    nearest = int(np.nanargmin(violations))
    where = ", ".join(f"{name} = {value!r}" for name, value in trials.points[nearest].items())
    return (
        f"no run keeps the limits ({summary}); the nearest one, with {where}, violates them by "
        f"{100 * violations[nearest]:.2g} %; the cure is wider limits or ranges"
    )


class OptimiseCommand(StudyCommand):
    """`exu-press optimise`."""

    example = "exu-press optimise clearances.toml --out out/clearances"
    study = Optimise
    run = staticmethod(optimise)
