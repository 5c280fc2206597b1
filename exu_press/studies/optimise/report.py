"""The report of an optimisation: the front, the chosen point, and all trials."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.files.output_directory import subdirectory
from exu_press.numerics.arrays import Array
from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant, uncertain
from exu_press.quantities.units import with_unit
from exu_press.scene import Scene
from exu_press.schema.csv_table import Value
from exu_press.studies.base import Range
from exu_press.studies.base.evaluation import Evaluation
from exu_press.studies.base.report import Column, Points, Report, Table, quantity_column
from exu_press.studies.optimise.study import Optimise

__all__ = ["OptimiseReport"]

MOST_LINES = 14
"""Most rows of the front: evenly along it, the chosen point always."""

AT_END = 0.01
"""Distance from the end of a key's range, over the range, at which a point lies on it."""


@dataclass(frozen=True)
class OptimiseReport(Report):
    """The result of an optimisation.

    Attributes:
        method: of the search.
        why: it was taken.
        trials: all points, with their objectives and limited quantities.
        places: numbers of the front's trials, by the first objective; of one objective the best.
        chosen: position of the chosen one in the front.
        errors: quantity -> errors of the front's points, NaN where not looked for or unknown.
        finer: quantities of the chosen point at a tenth of the tolerance.
    """

    name = "optimise"
    files = ("optimise.json", "trials.csv", "chosen.toml", "front/")
    heading, scene_file = "Optimum", "chosen.toml"
    drawn = (("front", "The front: all trials, and those that no other one beats."),)

    study: Optimise
    method: str
    why: str
    trials: Evaluation
    places: list[int]
    chosen: int
    errors: Mapping[str, Array]
    finer: dict[str, float]
    run_summary: list[str]

    @property
    def front(self) -> list[Scene]:
        """The scenes of the front."""
        return [self.study.scene_at(self.trials.points[trial]) for trial in self.places]

    def numbers(self, quantity: str) -> Array:
        """Return a quantity along the front, SI."""
        column = self.study.quantities.index(quantity)
        return self.trials.numbers[self.places, column]

    @property
    def at_ends(self) -> list[str]:
        """The keys of the chosen point that lie on an end of their ranges."""
        point = self.trials.points[self.places[self.chosen]]
        shares = {
            name: float(key.share(np.array(point[name])))
            for name, key in self.study.keys.items()
            if isinstance(key, Range)
        }
        return [name for name, share in shares.items() if not AT_END < share < 1.0 - AT_END]

    @property
    def subtitle(self) -> str:
        """Number of trials, and keys at the ends of their ranges."""
        counts = f"{len(self.trials.points)} trials, {len(self.places)} on the front"
        return "; ".join([counts, *map(_at_end_text, self.at_ends)])

    @property
    def scene(self) -> Scene:
        """The chosen scene."""
        return self.front[self.chosen]

    def tables(self) -> list[Table]:
        """Return how it was searched, the front with the chosen point, and all trials."""
        study, count = self.study, len(self.places)
        quantities = {
            name: quantity_of(study.scene, name).quantity.in_scaled_unit(self.numbers(name))
            for name in study.quantities
        }
        heads = (with_unit(name, quantity.display_unit) for name, quantity in quantities.items())
        spread = np.linspace(0, count - 1, MOST_LINES).astype(int).tolist()
        selected = sorted({self.chosen, *spread})
        rows = []
        for n in selected:
            point = self.trials.points[self.places[n]]
            cells = [f"{v:.4g}" if isinstance(v, float) else str(v) for v in point.values()]
            mark = "chosen" if n == self.chosen else f"{n + 1:02}"
            numbers = (self._number(name, n, q.scale) for name, q in quantities.items())
            rows.append((mark, *cells, *numbers))
        below = []
        if len(study.objective) > 1:
            excerpt = f", {len(selected)} of them shown" if len(selected) < count else ""
            below.append(
                f"{count} of {len(self.trials.points)} points are not worse than another in "
                f"everything{excerpt}"
            )
        below += [_at_end_text(name) for name in self.at_ends]
        for name, value in self.finer.items():
            quantity, own = quantities[name], float(self.numbers(name)[self.chosen])
            change = "the same" if value == own else f"{100 * (value / own - 1):+.2g} %"
            below.append(
                f"chosen, at a tenth of the tolerance: {name} "
                f"{significant(value * quantity.scale, 5)} {quantity.display_unit} ({change})"
            )
        above = [*self.run_summary, f"method: {self.method} ({self.why})"]
        head = ("", *map(with_unit, study.keys), *heads)
        return [Table("Front", head, rows, above=above, below=below), self._trial_table()]

    def points(self) -> Points:
        """Return the trials; one of the front opens with its scene."""
        names = list(dict.fromkeys(self.study.quantities))
        kinds = ["trial"] * len(self.trials.points)
        labels = ["a trial that others beat"] * len(kinds)
        for n, trial in enumerate(self.places, 1):
            kinds[trial], labels[trial] = "front", f"exu-press run front/{n:02}.toml"
        trials, keys = self._trial_columns(), list(self.study.keys)
        across, up = (names[0], names[1]) if len(names) > 1 else (keys[0], names[0])
        columns = [Column("front", "", kinds), *(quantity_column(k, trials[k]) for k in keys)]
        quantities = [quantity_column(name, trials[name]) for name in names]
        return Points(columns, quantities, labels, across, up, colour="front")

    def csv_files(self) -> dict[str, Mapping[str, Sequence[Value]]]:
        """Return keys and quantities of all trials, and which lie on the front."""
        marks = [int(n in self.places) for n in range(len(self.trials.points))]
        return {"trials.csv": {**self._trial_columns(), "front": marks}}

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of optimise.json."""
        names = dict.fromkeys(self.study.quantities)
        points = [
            {
                "keys": dict(self.trials.points[trial]),
                "quantities": {
                    name: {"value": self.numbers(name)[n], "error": self.errors[name][n]}
                    for name in names
                },
            }
            for n, trial in enumerate(self.places)
        ]
        return {
            "method": self.method,
            "why": self.why,
            "front": points,
            "chosen": self.chosen,
            "at_ends": self.at_ends,
            "chosen_at_a_tenth_of_the_tolerance": self.finer,
            "trials": len(self.trials.points),
            "runs": self.run_summary,
        }

    def save(self, directory: Path) -> None:
        """Write optimise.json, trials.csv, the chosen scene and those of the front."""
        super().save(directory)
        front = subdirectory(directory, "front")
        for old in front.glob("*.toml"):
            old.unlink()
        for number, scene in enumerate(self.front, 1):
            scene.save(front / f"{number:02}.toml", overwrite=True)

    def _trial_columns(self) -> dict[str, list[Any]]:
        """Return keys and quantities of all trials, SI; None where a run has no number."""
        columns: dict[str, list[Any]] = {
            key: [point[key] for point in self.trials.points] for key in self.study.keys
        }
        for name in dict.fromkeys(self.study.quantities):
            numbers = self.trials.numbers[:, self.study.quantities.index(name)]
            columns[name] = [None if np.isnan(value) else float(value) for value in numbers]
        return columns

    def _trial_table(self) -> Table:
        trials = [quantity_column(name, v) for name, v in self._trial_columns().items()]
        cells = [
            [f"{v:.6g}" if isinstance(v, float) else "-" if v is None else str(v) for v in t.values]
            for t in trials
        ]
        marks = [""] * len(self.trials.points)
        for n, trial in enumerate(self.places):
            marks[trial] = f"{n + 1:02}.toml" + ", chosen" * (n == self.chosen)
        head = [*(with_unit(trial.name, trial.unit) for trial in trials), "front"]
        rows = list(zip(*cells, marks, strict=True))
        return Table("Trials", head, rows, of_points=True, on_terminal=False)

    def _number(self, name: str, position: int, scale: float) -> str:
        """Return a quantity of a point of the front with its error."""
        value, error = float(self.numbers(name)[position]), float(self.errors[name][position])
        stated = {"error": None if np.isnan(error) else error, "determined": True}
        return uncertain(value, stated, scale, 5)


def _at_end_text(name: str) -> str:
    """Return the line of a key whose best value is the last one of its range."""
    return f"chosen: {name} lies on the end of its range; a wider range may have a better point"
