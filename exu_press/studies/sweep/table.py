"""The table of a sweep: one row a run, whatever became of it."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.files.output_directory import replacing
from exu_press.quantities.cost import COSTS
from exu_press.quantities.uncertain import uncertain
from exu_press.schema.csv_table import Value, flat, write_csv
from exu_press.schema.stored import shown
from exu_press.schema.toml import toml_text
from exu_press.studies.sweep.study import Sweep
from exu_press.studies.sweep.units import meaning_of, shown_unit, unit_of, with_unit

__all__ = ["RUN_TIMES", "Table", "cell", "table_of"]

FORMAT = "exu_press sweep 1"

COLUMN_NAME = re.compile(r"[\w.-]+", re.ASCII)
"""Name of a column that NetCDF takes."""

RUN_TIMES = tuple(quantity.name for quantity in COSTS if quantity.unit == "s")
"""Columns that differ from run to run of the same scene; they stand last."""


@dataclass(frozen=True)
class Table:
    """The result of a sweep.

    Attributes:
        study: of the runs.
        columns: name -> values, one a run in the study's order, None where a run has none. First
            the keys that vary, then status and reason, then the scalars of the summaries.
    """

    study: Sweep
    columns: Mapping[str, tuple[Value, ...]]

    def __getitem__(self, name: str) -> tuple[Value, ...]:
        return self.columns[name]

    def __len__(self) -> int:
        return len(self.study.points)

    def numbers(self, name: str) -> NDArray[np.float64]:
        """Return a column of numbers, (runs,); NaN where a run has none."""
        return np.array([np.nan if v is None else v for v in self.columns[name]], dtype=float)

    def is_numeric(self, name: str) -> bool:
        """Return whether a column has numbers alone, at least one."""
        values = [value for value in self.columns[name] if value is not None]
        return bool(values) and not any(isinstance(value, (str, bool)) for value in values)

    def error(self, name: str, run: int) -> dict[str, Any] | None:
        """Return a number's error, as in a summary, or None."""
        parts = ("error", "determined", "low", "high")
        columns = [self.columns.get(f"errors.{name}.{part}") for part in parts]
        found = {p: c[run] for p, c in zip(parts, columns, strict=True) if c is not None}
        return found if None not in found.values() and len(found) == len(parts) else None

    def in_words(self, name: str, runs: range, none: str = "") -> list[str]:
        """Return a column's head and its values of some runs, numbers in the unit that is shown.

        Args:
            name: of the column.
            runs: whose values are returned; a number has its error where that is known.
            none: said where a run has no value.
        """
        column = self.columns[name]
        numbers = [value for value in column if isinstance(value, float)]
        unit, scale = shown_unit(name, numbers)
        found = [with_unit(name, unit)]
        for run in runs:
            value = column[run]
            if isinstance(value, float):
                found.append(uncertain(value, self.error(name, run), scale, digits=6))
            else:
                found.append(none if value is None else str(value))
        return found

    def save_csv(self, path: Path) -> None:
        """Write the table; numbers with all their digits, nothing where a run has none."""
        write_csv(path, self.columns)

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


def table_of(study: Sweep, rows: Sequence[Mapping[str, Any]], files: Sequence[str]) -> Table:
    """Return the table of a study's rows.

    Args:
        study: of the runs.
        rows: as the runs gave them, nested, in the study's order.
        files: where the runs are, or nothing.
    """
    each = []
    for number, (point, scene, row) in enumerate(
        zip(study.points, study.scenes, rows, strict=True)
    ):
        scalars = _scalars({**row, "scene": scene.to_dict()})
        given = {name: cell(value) for name, value in point.items()}
        head = {**given, "status": scalars.pop("status"), "reason": scalars.pop("reason")}
        if files:
            head["file"] = files[number]
        times = {name: scalars.pop(name) for name in RUN_TIMES if name in scalars}
        each.append((head, scalars, times))
    names = dict.fromkeys(
        name for some in zip(*each, strict=True) for part in some for name in part
    )
    lines: list[dict[str, Value]] = [{**times, **scalars, **head} for head, scalars, times in each]
    return Table(study, {name: tuple(line.get(name) for line in lines) for name in names})


def cell(value: Any) -> Value:
    """Return a key's value as a cell: a list or a table as TOML."""
    return toml_text(value) if isinstance(value, (Mapping, list, tuple)) else value


def _scalars(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return single values, nested names joined by a dot; lists are left to run.nc."""
    scalars = {name: value for name, value in flat(row).items() if not isinstance(value, list)}
    for name in scalars:
        if not COLUMN_NAME.fullmatch(name):
            raise InputError(f"{shown(name)}: allowed is the name of a column")
    return scalars


def _letters(texts: list[str]) -> "np.ndarray[tuple[int, int], np.dtype[np.bytes_]]":
    """Return texts as single bytes, (texts, longest)."""
    encoded = [text.encode() for text in texts]
    longest = max(1, *(len(text) for text in encoded))
    padded = np.array([text.ljust(longest, b"\0") for text in encoded], dtype=f"S{longest}")
    return padded.view("S1").reshape(len(texts), longest)
