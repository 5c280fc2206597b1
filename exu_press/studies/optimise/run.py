"""Find the keys that make a press best: one objective, or several against each other."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import Row
from exu_press.scene import Scene
from exu_press.studies.base import Range, Runs
from exu_press.studies.base.command import StudyCommand
from exu_press.studies.base.evaluation import (
    Evaluation,
    Point,
    error_in,
    numbers_in,
    with_errors_of,
)
from exu_press.studies.optimise.report import OptimiseReport
from exu_press.studies.optimise.several import advised, chosen, front, searched
from exu_press.studies.optimise.single import evolved, judged, simplex, spread_points
from exu_press.studies.optimise.study import AUTO, EVOLUTION, NELDER_MEAD, NSGA, TPE, Optimise

__all__ = ["OptimiseCommand", "optimise"]

ROUGH = 0.01
"""Error of runs over the objective's spread: with a larger one a simplex goes astray."""

MOST_CHECKED = 12
"""Points of a front that get their errors: evenly along it, the chosen one always."""

FINER = 0.1
"""Tolerance, or step, of the chosen point's second run over the scene's."""

SCREEN = 4
"""Part of the trials of one objective that is spread over the ranges first, as 1 / SCREEN."""


def optimise(study: Optimise, directory: str | Path, **how: Any) -> OptimiseReport:
    """Do the runs that are missing, write optimise.json, trials.csv and scenes; return the result.

    Called again after a kill or Ctrl-C, it goes on.

    Args:
        study: to be run.
        directory: of this study alone.
        how: workers, dask, quiet of `exu_press.studies.base.Runs`.

    Raises:
        InputError: the directory cannot be used or belongs to another study, no scheduler answers,
            optuna is needed and not installed, an objective does not move, or no run keeps the
            limits.
    """
    directory = Path(directory)
    with Runs(study, directory, report=OptimiseReport, **how) as runs:
        trials = Evaluation(study, study.quantities, runs.of)

        def checked(points: Sequence[Point]) -> list[Row]:
            return with_errors_of(study, directory, [study.scene_at(p) for p in points], **how)

        method, why = _search(study, trials, checked)
        values, violations = _compared(study, trials.numbers)
        places = list(map(int, front(values, violations)))
        if not places:
            raise InputError(_none_within(trials, violations))
        best = chosen(values[places], [one.weight for one in study.objective])
        (row,) = runs.of([_finer(study.scene_at(trials.points[places[best]]))])
    names = list(dict.fromkeys(study.quantities))
    few = sorted({best, *np.linspace(0, len(places) - 1, MOST_CHECKED).astype(int).tolist()})
    rows = checked([trials.points[places[n]] for n in few])
    errors = {name: np.full(len(places), np.nan) for name in names}
    for n, each in zip(few, rows, strict=True):
        for name in names:
            found = error_in(each, name)
            errors[name][n] = np.nan if found is None else found
    finer = dict(zip(names, numbers_in(row, names), strict=True))
    report = OptimiseReport(
        study, method, why, trials, places, best, errors,
        {name: value for name, value in finer.items() if np.isfinite(value)}, trials.told(),
    )  # fmt: skip
    report.save(directory)
    return report


def _compared(study: Optimise, numbers: Array) -> tuple[Array, Array]:
    """Return objectives (m, s), less is better, and violations of limits (m,) of numbers."""
    count = len(study.objective)
    signs = np.array([one.sign for one in study.objective])
    beyond = [
        sum(limit.violation(x) for limit, x in zip(study.limit, row[count:], strict=True))
        for row in numbers
    ]
    return numbers[:, :count] * signs, np.array(beyond)


def _search(study: Optimise, trials: Evaluation, checked: Any) -> tuple[str, str]:
    """Ask for all trials; return the method, and why it was taken."""
    asked, keys = study.optimise, study.keys
    method, number = asked.method, len(study.objective)

    def ask(points: Sequence[Point]) -> tuple[Array, Array]:
        return _compared(study, trials(points))

    if number > 1 or study.has_values or method in (TPE, NSGA):
        why = "asked for"
        if method == AUTO:
            method, why = advised(asked.trials), f"advised for {asked.trials} trials"
        searched(ask, keys, number, asked.trials, method, asked.seed)
        _demand_movement(study, trials)
        return method, why
    names, ranges = list(keys), [each for each in keys.values() if isinstance(each, Range)]

    def point(x: Array) -> dict[str, float]:
        shares = np.clip(x, 0.0, 1.0)
        return {n: float(r.at(s)) for n, r, s in zip(names, ranges, shares, strict=True)}

    first = spread_points(len(names), asked.trials // SCREEN, asked.seed)
    values, violations = ask([point(x) for x in first])
    if not np.isfinite(values).any():
        return NELDER_MEAD if method == AUTO else method, "no run gave numbers"
    _demand_movement(study, trials)
    spread = float(np.nanmax(values) - np.nanmin(values))

    def judge(points: Array) -> Array:
        found, beyond = ask([point(x) for x in points])
        return judged(found[:, 0], beyond, spread)

    why = "asked for"
    if method == AUTO:
        error = error_in(checked([point(first[0])])[0], study.objective[0].quantity)
        part = np.inf if error is None else error / spread
        method = EVOLUTION if part > ROUGH else NELDER_MEAD
        why = f"a run's error is {100 * part:.2g} % of the objective's spread"
    left = asked.trials - len(first)
    if method == EVOLUTION:
        evolved(judge, len(names), left, asked.seed)
    else:
        simplex(judge, first[int(judged(values[:, 0], violations, spread).argmin())], left)
    return method, why


def _demand_movement(study: Optimise, trials: Evaluation) -> None:
    """Raise InputError for an objective that is the same in all runs."""
    for place, one in enumerate(study.objective):
        found = trials.numbers[:, place]
        found = found[np.isfinite(found)]
        if len(found) > 1 and np.ptp(found) <= 1e-9 * np.abs(found).max():
            raise InputError(
                f"objective {one.quantity}: is {found[0]:g} in each of {len(found)} runs; allowed "
                "is a quantity that the keys change"
            )


def _none_within(trials: Evaluation, violations: Array) -> str:
    """Say that no run keeps the limits, and which comes nearest."""
    told = "; ".join(line.strip() for line in trials.told())
    if not np.isfinite(trials.numbers).all(axis=1).any():
        return f"{told}: nothing to choose from"
    nearest = int(np.nanargmin(violations))
    where = ", ".join(f"{name} = {value!r}" for name, value in trials.points[nearest].items())
    return (
        f"no run keeps the limits ({told}); the nearest one, with {where}, violates them by "
        f"{100 * violations[nearest]:.2g} %; the cure is wider limits or ranges"
    )


def _finer(scene: Scene) -> Scene:
    """Return a scene with a tenth of its tolerance or step."""
    assert scene.solver is not None
    name = "tolerance" if scene.solver.step is None else "step"
    return scene.replace({f"solver.{name}": FINER * getattr(scene.solver, name)})


class OptimiseCommand(StudyCommand):
    """`exu-press optimise`."""

    example = "exu-press optimise clearances.toml --out out/clearances"
    study = Optimise
    run = staticmethod(optimise)
