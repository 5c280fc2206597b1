"""The report of a bifurcation study, and its points as a dataset."""

import dataclasses
from collections.abc import Callable, Iterator, Sequence
from operator import itemgetter
from typing import Any

import numpy as np

from exu_press.errors import required_package
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import COMPLETED
from exu_press.quantities.units import meaning_of, unit_of, with_unit
from exu_press.studies.base import Row
from exu_press.studies.base.report import Column, Points, Report, Table
from exu_press.studies.bifurcation.study import Bifurcation

__all__ = ["BifurcationReport", "Branch"]

MOST_LETTERS = 60
"""Of a reason in the table."""


@dataclasses.dataclass(frozen=True)
class Branch:
    """The rows of one way through the first key's values.

    Attributes:
        name: "up", "down" or "from the start".
        rows: of `run_point`; one that failed has status and reason alone.
    """

    name: str
    values: Sequence[float]
    rows: Sequence[Row]
    second: float | None = None

    def __iter__(self) -> Iterator[tuple[float, Row]]:
        return zip(self.values, self.rows, strict=True)


@dataclasses.dataclass(frozen=True)
class BifurcationReport(Report):
    """The result: the motions in the long run over one key, or over two.

    Attributes:
        branches: one or two, for each value of the second key.
    """

    name = "bifurcation"
    files = ("bifurcation.json",)
    drawn = (("bifurcation", "The diagram."),)

    study: Bifurcation
    branches: Sequence[Branch]

    @property
    def ways(self) -> list[str]:
        """The names of the branches, each once."""
        return list(dict.fromkeys(branch.name for branch in self.branches))

    @property
    def title(self) -> str:
        """Heading of the page."""
        return f"Bifurcation over {' and '.join(self.study.names)}"

    @property
    def subtitle(self) -> str:
        """Number of runs."""
        rows = [row for branch in self.branches for row in branch.rows]
        failed = sum(row["status"] != COMPLETED for row in rows)
        return f"{len(rows)} runs, {failed} without a result"

    def tables(self) -> list[Table]:
        """Return period, exponent and motion at each point."""
        head = (*map(with_unit, self.study.names), "way", "period", "exponent per revolution")
        rows = [
            (
                f"{value:g}",
                *([] if branch.second is None else [f"{branch.second:g}"]),
                branch.name,
                *(text[:MOST_LETTERS] for text in _motion_texts(row)),
            )
            for branch in self.branches
            for value, row in branch
        ]
        return [Table("Runs", (*head, "motion"), rows)]

    def points(self) -> Points | None:
        """Return every point of every section; None where no run has any."""
        rows = [
            ((value, branch.second), branch.name, row, point)
            for branch in self.branches
            for value, row in branch
            if row["status"] == COMPLETED
            for point in row["points"]
        ]
        if not rows:
            return None
        names = self.study.names
        keys = [
            Column(name, unit_of(name), [values[n] for values, *_ in rows])
            for n, name in enumerate(names)
        ]
        texts = [
            Column("way", "", [branch_name for _, branch_name, _, _ in rows]),
            Column("period", "", [str(row["in_words"]) for _, _, row, _ in rows]),
        ]
        sections = [
            Column(f"section, coordinate {k + 1}", "", [float(point[k]) for *_, point in rows])
            for k in range(min(len(point) for *_, point in rows))
        ]
        exponents = [row["exponent"][0] for _, _, row, _ in rows]
        return Points(
            [*keys, *texts],
            [*sections, Column("exponent per revolution", "", exponents)],
            [
                f"{row['in_words']}, {row['motion']}, on the way {branch_name}"
                for _, branch_name, row, _ in rows
            ],
            names[0],
            sections[0].name,
            colour="way",
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the entries of bifurcation.json, without states."""
        branches: dict[str, list[dict[str, Any]]] = {branch_name: [] for branch_name in self.ways}
        for branch in self.branches:
            second = {} if branch.second is None else {"second": branch.second}
            for value, row in branch:
                entries = {name: entry for name, entry in row.items() if name != "state"}
                branches[branch.name].append({"value": value, **second, **entries})
        second_key = {} if self.study.second is None else {"second_key": self.study.second}
        return {"key": self.study.name, **second_key, "branches": branches}

    def to_xarray(self) -> Any:
        """Return every point as an `xarray.Dataset` over way, keys, revolution and coordinate.

        A point that failed is NaN. A period is 0 where there is none, NaN where undecided.
        An exponent is per revolution; its lower end is NaN where only an upper bound is known.

        Raises:
            InputError: xarray is not installed.
        """
        xarray = required_package("xarray", "to_xarray", "xarray")
        study = self.study
        rows = [row for branch in self.branches for _, row in sorted(branch, key=itemgetter(0))]
        size = len(study.seconds), len(self.ways), len(study.values)

        def table(read: Callable[[Row], Any], missing: Any) -> Array:
            """Return what a run has, over way and keys."""
            read_rows = [read(row) if "points" in row else missing for row in rows]
            numbers = np.array(read_rows, dtype=float)
            ordered = np.moveaxis(numbers.reshape(*size, *numbers.shape[1:]), 0, 2)
            return ordered if study.second is not None else ordered[:, :, 0]

        figures = {
            "period": table(lambda row: (row["period"] or 0) if row["decided"] else None, None),
            "error": table(itemgetter("error"), None),
        }
        exponents = table(itemgetter("exponent"), (None, None, None))
        for number, end in enumerate(("", "_low", "_high")):
            figures[f"exponent{end}"] = exponents[..., number]
        completed = [row for row in rows if "points" in row]
        section = (
            np.shape(completed[0]["points"]) if completed else (study.bifurcation.revolutions, 0)
        )
        points = table(itemgetter("points"), np.full(section, np.nan))
        keys = {study.name: list(study.values)}
        if study.second is not None:
            keys[study.second] = [second for second in study.seconds if second is not None]
        axes = "way", *keys
        variables = {name: (axes, values) for name, values in figures.items()}
        attributes = {n: {"units": unit_of(n), "long_name": meaning_of(n)} for n in keys}
        return xarray.Dataset(
            {"points": ((*axes, "revolution", "coordinate"), points), **variables},
            coords={
                "way": self.ways,
                **{name: (name, values, attributes[name]) for name, values in keys.items()},
                "revolution": study.bifurcation.skip + 1 + np.arange(section[0]),
            },
        )


def _motion_texts(row: Row) -> tuple[str, str, str]:
    """Return period, exponent and motion of a point, or why it has none."""
    if row["status"] != COMPLETED:
        return str(row["status"]), str(row["reason"]), ""
    _, low, high = row["exponent"]
    exponent = f"below {high:.3g}" if low is None else f"{low:.3g} to {high:.3g}"
    return str(row["in_words"]), exponent, str(row["motion"])
