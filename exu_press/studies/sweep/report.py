"""The report of a sweep: a table with one row a run, however the run ended."""

import json
import re
import shlex
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.files.output_directory import replacing
from exu_press.integrate import SolverStatus
from exu_press.plots.sweep_words import in_unit
from exu_press.quantities import Owner, Quantity
from exu_press.quantities.catalogue import find_quantity
from exu_press.quantities.cost import COSTS
from exu_press.quantities.kind import COST, ENERGY
from exu_press.quantities.uncertain import uncertain
from exu_press.quantities.units import meaning_of, shown_unit, unit_of, with_unit
from exu_press.scene import Scene
from exu_press.schema.csv_table import Value, flat
from exu_press.schema.stored import short_text
from exu_press.schema.toml import toml_text
from exu_press.studies.base.report import (
    Column,
    Picture,
    Points,
    Report,
    Table,
    command_text,
    quantity_column,
)
from exu_press.studies.sweep.study import Sweep

__all__ = ["RUN_TIMES", "SweepReport", "cell_value", "report_of"]

MOST_COLUMNS = 4
"""Quantities that are shown unless some are chosen."""

NO_CHANGE = 1e-6
"""Relative."""

MOST_LINES = 24
"""Runs in a terminal."""

MOST_ROWS = 500
"""Runs in the table of a page."""

MOST_REASONS = 3

FORMAT = "exu_press sweep 1"

COLUMN_NAME = re.compile(r"[\w.-]+", re.ASCII)
"""Name of a column that NetCDF takes."""

REACHED_END = frozenset(status.value for status in SolverStatus if status.reached_end)

RUN_TIMES = tuple(quantity.name for quantity in COSTS if quantity.unit == "s")
"""Columns that differ from run to run of the same scene; they stand last."""


@dataclass(frozen=True)
class SweepReport(Report):
    """The result of a sweep.

    Attributes:
        columns: name -> values, one a run in the study's order, None where a run has none. First
            the keys that vary, then status and reason, then the scalars of the summaries.
        axes: keys on the picture's axes; the first two numbers that vary where none is chosen.
        selected: columns that are shown; the first few usual ones in which the runs differ.
    """

    name = "sweep"
    files = ("table.csv", "table.nc")
    heading = "Sweep"

    study: Sweep
    columns: Mapping[str, tuple[Value, ...]]
    axes: Sequence[str] = ()
    selected: Sequence[str] = ()

    def __getitem__(self, name: str) -> tuple[Value, ...]:
        return self.columns[name]

    def __len__(self) -> int:
        return len(self.study.points)

    def numbers(self, name: str) -> NDArray[np.float64]:
        """Return a column of numbers, (runs,); NaN where a run has none."""
        return np.array([np.nan if v is None else v for v in self.columns[name]], dtype=float)

    def is_numeric(self, name: str) -> bool:
        """Return whether a column has at least one number, and no texts."""
        values = [value for value in self.columns[name] if value is not None]
        return bool(values) and not any(isinstance(value, (str, bool)) for value in values)

    def error(self, name: str, run: int) -> dict[str, Any] | None:
        """Return the error of a number as a summary has it, or None."""
        parts = ("error", "determined", "low", "high")
        columns = [self.columns.get(f"errors.{name}.{entry}") for entry in parts]
        error = {p: c[run] for p, c in zip(parts, columns, strict=True) if c is not None}
        return error if None not in error.values() and len(error) == len(parts) else None

    @property
    def subtitle(self) -> str:
        """Number of runs, and how they ended."""
        return f"{len(self)} runs over {', '.join(self.study.keys)}: {self.ends}"

    @property
    def scenes(self) -> Sequence[Scene]:
        """The scenes of all runs."""
        return self.study.scenes

    @property
    def failures(self) -> list[str]:
        """The reason of the first run where none reached an end."""
        reached = REACHED_END.intersection(map(str, self["status"]))
        return [] if reached else [f"no run reached its end: {self['reason'][0]}"]

    def quantities(self) -> tuple[str, ...]:
        """Return the columns that are shown: the selected ones, or those that change most.

        Raises:
            InputError: a selected one is no column of numbers.
        """
        for name in self.selected:
            if name not in self.columns or not self.is_numeric(name):
                numeric = [n for n in self.columns if self.is_numeric(n) and "scene." not in n]
                allowed = ", ".join(numeric) or "none, as no run has a number"
                raise InputError(f"--show {name}: allowed are {allowed}")
        return tuple(self.selected) or self._changing_most()

    def tables(self) -> list[Table]:
        """Return keys and quantities of the runs, and how these ended."""
        count = min(len(self), MOST_ROWS)
        names = (*self.study.keys, *self.quantities(), "status")
        cells = [self._cells(name, count) for name in names]
        below = []
        if len(self) > MOST_LINES:
            below.append(f"... and {len(self) - MOST_LINES} more in table.csv")
        below.append(f"{len(self)} runs: {self.ends}")
        reasons = Counter(
            f"{status}: {reason}"
            for status, reason in zip(self["status"], self["reason"], strict=True)
            if reason
        )
        below += [f"  {n} x {reason}" for reason, n in reasons.most_common(MOST_REASONS)]
        head, *rows = zip(*cells, strict=True)
        excerpt = list(range(min(count, MOST_LINES)))
        return [Table("Runs", head, rows, below=below, excerpt=excerpt, of_points=True)]

    def pictures(self) -> list[Picture]:
        """Return the quantities over the keys."""
        caption = f"Over {' and '.join(self.study.keys)}."
        return [Picture("sweep", caption, "exu_press.studies.sweep.figure:sweep_picture")]

    def points(self) -> Points | None:
        """Return the runs over keys and quantities; None where no number varies."""
        numeric = [
            name
            for name in self.columns
            if (placed := find_quantity(name)) is not None
            and placed.quantity.kind is not COST
            and self.is_numeric(name)
            and len(set(self[name])) > 1
        ]
        names = list(dict.fromkeys([*self.quantities(), *numeric]))
        if not names:
            return None
        labels = [self._command(run) for run in range(len(self))]
        keys = [*self.study.keys]
        varied = [name for name in keys if len(set(self[name])) > 1]
        return Points(
            [self._key_column(name) for name in varied or keys],
            [self._column(name) for name in names],
            labels,
        )

    def csv_files(self) -> dict[str, Mapping[str, Sequence[Value]]]:
        """Return all columns; a cell is empty where a run has no value."""
        return {"table.csv": self.columns}

    def save(self, directory: Path) -> None:
        """Write table.csv, table.nc, and the file of which a page is made."""
        super().save(directory)
        self.save_netcdf(directory / "table.nc")

    def _cells(self, name: str, count: int) -> list[str]:
        """Return a column's head and its first values, numbers with their errors."""
        column = self.columns[name]
        unit, scale = shown_unit(name, [value for value in column if isinstance(value, float)])
        cells = [with_unit(name, unit)]
        for run, value in enumerate(column[:count]):
            if isinstance(value, float):
                cells.append(uncertain(value, self.error(name, run), scale, digits=6))
            else:
                cells.append("-" if value is None else str(value))
        return cells

    @property
    def ends(self) -> str:
        """How many runs ended in each way."""
        counts = Counter(self["status"])
        return ", ".join(f"{count} {status}" for status, count in counts.items())

    def _changing_most(self) -> tuple[str, ...]:
        """Return the quantities that change most, each of one joint, as far as tables show them.

        Of joints those with clearance count, if there are any, and no energies. The order is the
        catalogue's.
        """
        loose = self.study.scene.joints.with_clearance
        largest: dict[Quantity, tuple[float, str]] = {}
        for name in self.columns:
            placed = find_quantity(name)
            if placed is None or not (placed.quantity.title and placed.quantity.kind.has_error):
                continue
            quantity, owner = placed.quantity, placed.owner
            if quantity.owner is Owner.JOINT and (
                (loose and owner not in loose) or quantity.kind is ENERGY
            ):
                continue
            if (change := self._change(name)) > NO_CHANGE:
                known, _ = largest.get(placed.quantity, (0.0, ""))
                if change > known * (1.0 + NO_CHANGE):
                    largest[placed.quantity] = change, name
        names = {name for _, name in sorted(largest.values(), reverse=True)[:MOST_COLUMNS]}
        return tuple(name for name in self.columns if name in names)

    def _change(self, name: str) -> float:
        """Return by how much a column varies, relative to its largest magnitude."""
        if not self.is_numeric(name):
            return 0.0
        values = self.numbers(name)
        values = values[np.isfinite(values)]
        largest = float(np.abs(values).max(initial=0.0))
        return (1.0 if len(values) == 1 else float(np.ptp(values)) / largest) if largest else 0.0

    def _column(self, name: str) -> Column:
        """Return a column with the bounds of its values, where they are known."""
        errors = [self.error(name, run) for run in range(len(self))]
        if not any(errors):
            return quantity_column(name, self[name])
        low, high = ([e[end] if e else None for e in errors] for end in ("low", "high"))
        return quantity_column(name, self[name], low, high)

    def _key_column(self, name: str) -> Column:
        """Return the column of a key, numbers in the unit that the picture has."""
        if not self.is_numeric(name):
            return quantity_column(name, self[name])
        values, unit = in_unit(name, self.numbers(name))
        return Column(name, unit, values.tolist())

    def _command(self, run: int) -> str:
        """Return the command that shows a run again: its file's, or the one that computes it."""
        if "file" in self.columns:
            return f"exu-press view {shlex.quote(str(self['file'][run]))}"
        return command_text({name: self[name][run] for name in self.study.keys})

    def save_netcdf(self, path: Path) -> None:
        """Write one dimension, numbers as numbers (NaN where a run has none), others as text."""
        from scipy.io import netcdf_file  # takes longer to load than a short run

        with replacing(path) as partial, netcdf_file(partial, "w", version=2) as file:
            file.format = FORMAT
            file.study = json.dumps(self.study.to_dict())
            file.createDimension("run", len(self))
            for name, values in self.columns.items():
                if self.is_numeric(name):
                    variable = file.createVariable(name, "d", ("run",))
                    variable[:] = self.numbers(name)
                else:
                    letters = _letters(["" if value is None else str(value) for value in values])
                    dimension = f"letters_{letters.shape[1]}"
                    if dimension not in file.dimensions:
                        file.createDimension(dimension, letters.shape[1])
                    variable = file.createVariable(name, "c", ("run", dimension))
                    variable[:] = letters
                    variable._Encoding = "utf-8"
                if unit_of(name):
                    variable.units = unit_of(name)
                if meaning_of(name):
                    variable.long_name = meaning_of(name)


def report_of(study: Sweep, rows: Sequence[Mapping[str, Any]], files: Sequence[str]) -> SweepReport:
    """Return the report of a study's rows.

    Args:
        rows: as the runs gave them, nested, in the study's order.
        files: where the runs are, or nothing.
    """
    lines: list[dict[str, Value]] = []
    for point, scene, row in zip(study.points, study.scenes, rows, strict=True):
        head = {name: cell_value(value) for name, value in point.items()}
        head |= {name: row[name] for name in ("status", "reason")}
        if files:
            head["file"] = files[len(lines)]
        lines.append({**head, **_scalars({**row, "scene": scene.to_dict()}), **head})
    names = dict.fromkeys(name for line in lines for name in line)
    ordered = sorted(names, key=lambda name: name in RUN_TIMES)
    return SweepReport(study, {name: tuple(line.get(name) for line in lines) for name in ordered})


def cell_value(value: Any) -> Value:
    """Return a key's value as a cell: a list or a table as TOML."""
    return toml_text(value) if isinstance(value, (Mapping, list, tuple)) else value


def _scalars(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return single values, nested names joined by a dot; lists are left to run.nc."""
    scalars = {name: value for name, value in flat(row).items() if not isinstance(value, list)}
    for name in scalars:
        if not COLUMN_NAME.fullmatch(name):
            raise InputError(f"{short_text(name)}: allowed is the name of a column")
    return scalars


def _letters(texts: list[str]) -> "np.ndarray[tuple[int, int], np.dtype[np.bytes_]]":
    """Return texts as single bytes, (texts, longest)."""
    padded = np.array([text.encode() for text in texts])
    return padded.view("S1").reshape(len(texts), -1)
