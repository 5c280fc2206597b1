"""Section 5 inverted: which reading of what the paper leaves open brings its numbers nearest."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.parallel import Batch
from exu_press.scene import Scene, flexible_press
from exu_press.studies.optimise.several import search_front
from exu_press.studies.optimise.study import TPE
from paper.open_keys import BESIDE, FOUND, OPEN, OURS, alternatives, as_read
from paper.published import Number, published
from paper.readings import MODELS
from paper.runs import DEFAULT, paper_runs
from paper.tasks import read

__all__ = ["CAP", "OBSERVED", "Inverse", "Trial", "distance", "inverse"]

CAP = math.log(4.0)
"""Of a number's log ratio, in what the search makes small: how far beyond a factor of four a number
lies tells nothing, and one that no reading reaches must not decide about all others."""

SEARCH: Mapping[str, Any] = {"revolutions": 1.55, "solver.tolerance": 1e-2}
"""Of the runs that readings are compared by: a quarter of the work. Peaks of the printed damping
change by less than 0.5 %, those of a nearly undamped contact by 10 to 30 %, within what the scenes
do not determine. What is told in the end of three trials is run as all of section 5 is."""

TIME_LIMIT = 600.0
"""Of a rigid run, s, on a machine that does other work too; TIME_LIMIT_FLEXIBLE of a flexible one,
which takes a minute or less alone."""

TIME_LIMIT_FLEXIBLE = 3600.0

FREE = 0.01
"""Of the distance: what changes it by less cannot be told."""

OBSERVED = "observation"

RIGID, FLEXIBLE = "rigid", "flexible"


@dataclass(frozen=True)
class Trial:
    """One reading and what it makes of the paper's numbers.

    Attributes:
        reading: name of what is open -> what it is taken for.
        ratios: ours over the paper's, in the order of `Inverse.numbers`; None of a failed run.
        bodies: "rigid" or "flexible".
    """

    reading: Mapping[str, Any]
    ratios: tuple[float, ...] | None
    bodies: str = RIGID

    @property
    def distance(self) -> float:
        """Root mean square of capped log ratios; infinite of a failed one."""
        return math.inf if self.ratios is None else distance(self.ratios, CAP)


def distance(ratios: Sequence[float], cap: float = math.inf) -> float:
    """Return the root mean square of the logarithms of ratios, each capped.

    >>> distance([math.e, 1 / math.e]), round(distance([1e9], CAP), 3)
    (1.0, 1.386)
    """
    logs = [min(abs(math.log(ratio)), cap) for ratio in ratios]
    return math.sqrt(sum(x * x for x in logs) / len(logs))


@dataclass
class Inverse:
    """What was tried.

    Attributes:
        numbers: that the paper computed and prints, in its order.
        trials: all readings, ours and that of an earlier search first.
        ours: with rigid bodies, run as all of section 5 is.
        from_rigid: what rigid bodies recommend, run likewise; the flexible search starts there.
        best: of the search and of the changes by one key.
        alone: name of what is open -> trials that differ from `base` in it alone.
        base: best reading of the search, before the changes by one key.
        flexible: trials of the flexible search, `from_rigid` first.
        ours_flexible: ours with flexible bodies, as in the search.
        recommended: the best of `flexible`, run as all of section 5 is.
        failures: why runs gave no numbers -> how many.
        repeated: runs that were repeated with smaller tolerances.
        runs: how many there were.
    """

    numbers: tuple[Number, ...]
    trials: list[Trial]
    ours: Trial
    best: Trial
    from_rigid: Trial
    alone: Mapping[str, list[Trial]]
    base: Trial
    ours_flexible: Trial
    recommended: Trial
    flexible: list[Trial] = field(default_factory=list)
    failures: Counter[str] = field(default_factory=Counter)
    repeated: int = 0
    runs: int = 0

    @property
    def all(self) -> list[Trial]:
        """Return every trial that has numbers."""
        more = [one for each in self.alone.values() for one in each]
        found = [*self.trials, self.best, self.from_rigid, *more]
        found += [*self.flexible, self.ours_flexible, self.recommended]
        return [one for one in found if one.ratios is not None]

    def nearest(self, place: int) -> Trial:
        """Return the trial that brings one number nearest."""
        return min(self.all, key=lambda one: abs(math.log((one.ratios or ())[place])))

    @property
    def free(self) -> list[str]:
        """Return what is open and changes the distance by less than FREE wherever it is."""
        return [
            name
            for name, each in self.alone.items()
            if all(abs(one.distance - self.base.distance) < FREE for one in each)
        ]

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of inverse.json."""
        return {
            "numbers": [[n.quantity, n.figure, n.published] for n in self.numbers],
            "trials": [[dict(t.reading), t.ratios] for t in self.trials],
            "ours": [dict(self.ours.reading), self.ours.ratios],
            "best": [dict(self.best.reading), self.best.ratios],
            "from_rigid": [dict(self.from_rigid.reading), self.from_rigid.ratios],
            "flexible": [[dict(t.reading), t.ratios] for t in self.flexible],
            "ours_flexible": self.ours_flexible.ratios,
            "recommended": [dict(self.recommended.reading), self.recommended.ratios],
            "alone": {
                name: [[one.reading[name], one.ratios] for one in each]
                for name, each in self.alone.items()
            },
            "failures": dict(self.failures),
            "repeated": self.repeated,
            "runs": self.runs,
        }

    def count(self, judge: "_Judge") -> None:
        """Add a judge's runs."""
        self.failures += judge.failures
        self.repeated += judge.repeated
        self.runs += judge.runs


def _alone(judge: "_Judge", best: Trial, quick: bool) -> dict[str, list[Trial]]:
    """Return trials that differ from the best in one key, by its name; each observed at its best.

    Little damping and resolved peaks go together, as much damping and means do.
    """
    varied = {name: alternatives(name, best.reading[name]) for name in OPEN}
    if quick:
        varied = {name: values[:1] for name, values in list(varied.items())[:3]}
    ways = {name: (best.reading[OBSERVED],) if name == OBSERVED else MODELS for name in varied}
    asked = [
        {**best.reading, OBSERVED: how, name: value}
        for name, values in varied.items()
        for value in values
        for how in ways[name]
    ]
    found = iter(judge.of(asked))
    return {
        name: [min((next(found) for _ in ways[name]), key=lambda one: one.distance) for _ in values]
        for name, values in varied.items()
    }


class _Judge:
    """Runs readings, several side by side, and remembers them."""

    def __init__(
        self, batch: Batch, numbers: Sequence[Number], scenes: Mapping[str, Scene], bodies: str
    ) -> None:
        self._batch, self._numbers, self._scenes, self._bodies = batch, numbers, scenes, bodies
        self._names = list(dict.fromkeys(number.run for number in numbers))
        self.trials: list[Trial] = []
        self.failures: Counter[str] = Counter()
        self._asked: dict[str, Mapping[str, Any]] = {}

    @property
    def runs(self) -> int:
        """How many different ones were asked for."""
        return len(self._asked)

    @property
    def repeated(self) -> int:
        """How many of them needed a smaller tolerance."""
        return sum(row.get("repeated", 0) > 0 for row in self._asked.values())

    def ask(self, points: Sequence[Mapping[str, Any]]) -> tuple[Array, Array]:
        """Return the distances of readings as optuna's samplers ask for them.

        A run is observed in each way at no cost: the best observation counts.
        """
        found = self.best_observed(points)
        self.trials += found
        values = [one.distance if one.ratios else np.nan for one in found]
        return np.array(values)[:, None], np.zeros(len(found))

    def best_observed(self, points: Sequence[Mapping[str, Any]]) -> list[Trial]:
        """Return the trials of readings, each observed as it comes nearest."""
        every = self.of([{**point, OBSERVED: how} for how in MODELS for point in points])
        number = len(points)
        return [min(every[place::number], key=lambda one: one.distance) for place in range(number)]

    def of(self, points: Sequence[Mapping[str, Any]]) -> list[Trial]:
        """Return the trials of readings."""
        tasks: list[dict[str, Any]] = []
        places: list[dict[str, int] | None] = []
        for point in points:
            try:
                scenes = {name: as_read(self._scenes[name], point) for name in self._names}
            except InputError as error:
                self.failures[f"not a scene: {str(error)[:90]}"] += 1
                places.append(None)
                continue
            places.append({name: len(tasks) + n for n, name in enumerate(scenes)})
            tasks += [{"scene": scene.to_dict()} for scene in scenes.values()]
        rows = self._batch.rows(tasks)
        new = {str(task): row for task, row in zip(tasks, rows, strict=True)}
        new = {task: row for task, row in new.items() if task not in self._asked}
        self._asked |= new
        for row in new.values():
            if row["status"] != "completed":
                self.failures[f"{row['status']}: {row['reason'][:90]}"] += 1
        return [
            Trial(dict(point), None if at is None else self._ratios(point, at, rows), self._bodies)
            for point, at in zip(points, places, strict=True)
        ]

    def _ratios(
        self, point: Mapping[str, Any], at: Mapping[str, int], rows: Sequence[Mapping[str, Any]]
    ) -> tuple[float, ...] | None:
        found = []
        for number in self._numbers:
            measure = number.measure
            if measure.startswith("peak_acceleration."):
                measure = f"peak_acceleration.{point[OBSERVED]}"
            value = rows[at[number.run]].get("values", {}).get(measure)
            if value is None or not value > 0.0:
                return None
            found.append(value / number.published)
        return tuple(found)


def inverse(
    directory: Path, *, trials: int, quick: bool = False, workers: int | None = None,
    quiet: bool = True,
) -> Inverse:  # fmt: skip
    """Search readings with rigid bodies, vary the best one by one key, go on with flexible ones.

    Called again after a kill, it goes on.

    Args:
        directory: for the runs.
        trials: readings of the search; 0: flexible bodies alone, from where an earlier search led.
        quick: a fraction of a revolution: tries the machinery only.
        workers: processes; all cores unless told.
        quiet: False shows the progress on standard error.

    Raises:
        InputError: the directory cannot be used, or no reading gives numbers.
    """
    numbers = tuple(number for number in published().numbers if not number.reference)
    scenes = paper_runs(DEFAULT, flexible=False)
    coarse = {**SEARCH, "revolutions": 0.03} if quick else SEARCH
    told: dict[str, Any] = {"workers": workers, "quiet": quiet, "label": "readings"}
    with Batch(read, directory, time_limit=TIME_LIMIT, **told) as batch:
        judge = _Judge(batch, numbers, {n: s.replace(coarse) for n, s in scenes.items()}, RIGID)
        (ours,) = judge.of([OURS])
        judge.ask([OURS, FOUND])
        varying = {name: key for name, key in OPEN.items() if name != OBSERVED}
        search_front(judge.ask, varying, 1, trials, TPE, 0)  # of no trials: nothing
        best = min(judge.trials, key=lambda one: one.distance)
        if best.ratios is None:
            raise InputError(f"no reading gives numbers: {judge.failures.most_common(2)}")
        alone = _alone(judge, best, quick) if trials else {}
        base = best
        best = min([base, *(t for each in alone.values() for t in each)], key=lambda t: t.distance)
        report = Inverse(
            numbers, judge.trials, ours, best, best, alone, base, ours_flexible=ours,
            recommended=best,
        )  # fmt: skip
        reading = {**best.reading, **{name: OURS[name] for name in report.free}}
        (plain,) = judge.of([reading])
        report.from_rigid = plain if plain.distance < best.distance + 2 * FREE else best
        report.count(judge)
        if not quick:
            fine = _Judge(batch, numbers, scenes, RIGID)
            report.ours, report.from_rigid = fine.of([OURS, report.from_rigid.reading])
            report.count(fine)
    bodies = {name: scene.replace({"bodies": flexible_press()}) for name, scene in scenes.items()}
    with Batch(read, directory, time_limit=TIME_LIMIT_FLEXIBLE, **told) as batch:
        judge = _Judge(batch, numbers, {n: s.replace(coarse) for n, s in bodies.items()}, FLEXIBLE)
        (report.ours_flexible,) = judge.of([OURS])
        start_at = report.from_rigid.reading
        beside = BESIDE[:1] if quick else BESIDE
        report.flexible = judge.best_observed([start_at, *({**start_at, **b} for b in beside)])
        start, nearest = report.flexible[0], min(report.flexible, key=lambda one: one.distance)
        better = nearest.distance < start.distance - FREE
        report.recommended = nearest if better else start
        report.count(judge)
        if not quick:
            fine = _Judge(batch, numbers, bodies, FLEXIBLE)
            (report.recommended,) = fine.of([report.recommended.reading])
            report.count(fine)
    return report
