"""Run an optimum."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.files.output_directory import subdirectory, write_json
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import Row
from exu_press.scene import Scene
from exu_press.schema.csv_table import write_csv
from exu_press.studies.base import Range, Runs
from exu_press.studies.base.evaluation import (
    Evaluation,
    Point,
    error_in,
    numbers_in,
    with_errors_of,
)
from exu_press.studies.optimise.several import advised, chosen, front, searched
from exu_press.studies.optimise.single import evolved, judged, simplex, spread_points
from exu_press.studies.optimise.study import AUTO, EVOLUTION, NELDER_MEAD, NSGA, TPE, Optimise

__all__ = ["Report", "optimise"]

WRITTEN = ("optimise.json", "trials.csv", "chosen.toml")

ROUGH = 0.01
"""Error of runs over the objective's spread: with a larger one a simplex goes astray."""

MOST_CHECKED = 12
"""Points of a front that get their errors: evenly along it, the chosen one always."""

FINER = 0.1
"""Tolerance, or step, of the chosen point's second run over the scene's."""

AT_END = 0.01
"""Distance from the end of a key's range, over the range, at which a point lies on it."""

SCREEN = 4
"""Part of the trials of one objective that is spread over the ranges first, as 1 / SCREEN."""


@dataclass(frozen=True)
class Report:
    """The result of an optimisation.

    Attributes:
        study: whose report this is.
        method: of the search.
        why: it was taken.
        trials: all points, with their objectives and limited quantities.
        places: of the front among them, by the first objective; of one objective the best point.
        chosen: place of the chosen one among these.
        errors: quantity -> errors of the front's points, NaN where not looked for or unknown.
        finer: quantities of the chosen point at a tenth of the tolerance.
        told: how many runs gave numbers, in lines.
    """

    study: Optimise
    method: str
    why: str
    trials: Evaluation
    places: list[int]
    chosen: int
    errors: Mapping[str, Array]
    finer: dict[str, float]
    told: list[str]

    @property
    def scenes(self) -> list[Scene]:
        """Return the scenes of the front."""
        return [self.study.scene_at(self.trials.points[place]) for place in self.places]

    def numbers(self, quantity: str) -> Array:
        """Return a quantity along the front, SI."""
        place = self.study.quantities.index(quantity)
        return self.trials.numbers[self.places, place]

    @property
    def at_ends(self) -> list[str]:
        """Return the keys of the chosen point that lie on an end of their ranges."""
        point = self.trials.points[self.places[self.chosen]]
        shares = {
            name: float(key.share(np.array(point[name])))
            for name, key in self.study.keys.items()
            if isinstance(key, Range)
        }
        return [name for name, share in shares.items() if not AT_END < share < 1.0 - AT_END]

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of optimise.json."""
        names = dict.fromkeys(self.study.quantities)
        points = [
            {
                "keys": dict(self.trials.points[place]),
                "quantities": {
                    name: {
                        "value": float(self.numbers(name)[n]),
                        "error": None if np.isnan(error := self.errors[name][n]) else float(error),
                    }
                    for name in names
                },
            }
            for n, place in enumerate(self.places)
        ]
        return {
            "method": self.method,
            "why": self.why,
            "front": points,
            "chosen": self.chosen,
            "at_ends": self.at_ends,
            "chosen_at_a_tenth_of_the_tolerance": self.finer,
            "trials": len(self.trials.points),
            "runs": self.told,
        }


def optimise(study: Optimise, directory: str | Path, **how: Any) -> Report:
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
    with Runs(study, directory, written=WRITTEN, label="optimise", **how) as runs:
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
    report = Report(
        study, method, why, trials, places, best, errors,
        {name: value for name, value in finer.items() if np.isfinite(value)}, trials.told(),
    )  # fmt: skip
    _save(report, directory)
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


def _save(report: Report, directory: Path) -> None:
    """Write optimise.json, trials.csv, the chosen scene and those of the front."""
    write_json(directory / "optimise.json", report.to_dict())
    trials, study = report.trials, report.study
    on_front = set(report.places)
    columns = {key: [point[key] for point in trials.points] for key in study.keys}
    for name in dict.fromkeys(study.quantities):
        numbers = trials.numbers[:, study.quantities.index(name)]
        columns[name] = [None if np.isnan(value) else float(value) for value in numbers]
    columns["front"] = [int(place in on_front) for place in range(len(trials.points))]
    write_csv(directory / "trials.csv", columns)
    scenes = report.scenes
    scenes[report.chosen].save(directory / "chosen.toml", overwrite=True)
    front = subdirectory(directory, "front")
    for old in front.glob("*.toml"):
        old.unlink()
    for number, scene in enumerate(scenes, 1):
        scene.save(front / f"{number:02}.toml", overwrite=True)
