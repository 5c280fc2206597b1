"""Quantities at points of a study's keys, and their errors; a run that failed gives no number."""

import dataclasses
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.files.output_directory import output_directory, subdirectory
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import COMPLETED, Row
from exu_press.quantities import quantity_of
from exu_press.scene import Scene
from exu_press.studies.base.keys import Normal, Range, Values
from exu_press.studies.base.runs import Runs
from exu_press.studies.base.study import Study

__all__ = ["Evaluation", "Point", "error_in", "numbers_in", "require_key_kinds", "with_errors_of"]

Point = Mapping[str, Any]

NO_SCENE = "not a scene"

CHECKED = "checked"
"""Directory inside the study's own."""


class Evaluation:
    """Evaluation of points for a solver or a sample: points in, quantities out.

    Attributes:
        quantities: full names.
    """

    def __init__(
        self,
        study: Study,
        quantities: Sequence[str],
        run: Callable[[Sequence[Scene]], Sequence[Row]],
    ) -> None:
        """Take study, full names of quantities, and `run`, which returns the rows of scenes.

        Raises:
            InputError: the scene has no such quantity.
        """
        for name in quantities:
            quantity_of(study.scene, name)
        self.quantities = tuple(quantities)
        self._points: dict[str, Point] = {}
        self._rows: dict[str, Row] = {}
        self._study, self._run = study, run

    @property
    def points(self) -> list[Point]:
        """The different points, in the order of their first evaluation."""
        return list(self._points.values())

    @property
    def numbers(self) -> Array:
        """Quantities of `points`, (points, quantities), as a call returns them."""
        return self(self.points)

    def __call__(self, points: Sequence[Point]) -> Array:
        """Return quantities, (points, quantities); NaN in all of a row whose run failed."""
        return np.array([numbers_in(row, self.quantities) for row in self.rows_of(points)])

    def rows_of(self, points: Sequence[Point]) -> list[Row]:
        """Return the rows of points; a point is run once."""
        keys = [repr(sorted(point.items())) for point in points]
        new: dict[str, Scene] = {}
        for key, point in zip(keys, points, strict=True):
            if key in self._points:
                continue
            self._points[key] = dict(point)
            try:
                new[key] = self._study.scene_at(point)
            except InputError as error:
                self._rows[key] = {"status": NO_SCENE, "reason": str(error)}
        if new:
            self._rows |= zip(new, self._run(list(new.values())), strict=True)
        return [self._rows[key] for key in keys]

    def run_summary(self) -> list[str]:
        """Return lines: how many runs gave numbers, and why others failed."""
        reasons_by_kind = defaultdict(list)
        for row in self._rows.values():
            if kind := self._failure_kind(row):
                reasons_by_kind[kind].append(str(row["reason"]))
        failed, number = sum(map(len, reasons_by_kind.values())), len(self._rows)
        lines = [f"{number} runs: {number - failed} gave numbers, {failed} did not"]
        for kind, reasons in sorted(reasons_by_kind.items(), key=lambda item: -len(item[1])):
            first = ("; the first: " if len(reasons) > 1 else ": ") + reasons[0]
            lines.append(f"  {len(reasons)} x {kind}{first if reasons[0] else ''}")
        return lines

    def summary_line(self) -> str:
        """Return `run_summary` in one line."""
        return "; ".join(line.strip() for line in self.run_summary())

    def _failure_kind(self, row: Row) -> str:
        if row["status"] != COMPLETED:
            return str(row["status"])
        missing = [name for name in self.quantities if row.get(name) is None]
        return f"too short to have {missing[0]}" if missing else ""


def numbers_in(row: Row, quantities: Sequence[str]) -> list[float]:
    """Return quantities of a row; all NaN where the run failed or lacks one."""
    values = [row.get(name) for name in quantities]
    if row["status"] != COMPLETED or any(value is None for value in values):
        return [np.nan] * len(quantities)
    return [float(value) for value in values if value is not None]


def require_key_kinds(
    study: Study, command: str, kinds: tuple[type, ...] = (Range,)
) -> tuple[str, ...]:
    """Return the names of a study's keys, all of which must be of certain kinds."""
    forms = {
        Range: "{low = a, high = b}, with log = true by its logarithm",
        Normal: "{mean = m, deviation = s}",
        Values: "[value, ...]",
    }
    for name, key in study.keys.items():
        if not isinstance(key, kinds):
            allowed = " or ".join(forms[kind] for kind in kinds)
            raise InputError(
                f"keys.{name} = {key.plain()!r}: allowed in a file for exu-press {command} is "
                f"{allowed}"
            )
    return tuple(study.keys)


def with_errors_of(
    study: Study, directory: str | Path, scenes: Sequence[Scene], **workers: Any
) -> list[Row]:
    """Return the rows of scenes with their errors."""
    plain = dataclasses.replace(study, errors=True, save_runs=False)
    checked = subdirectory(output_directory(directory), CHECKED)
    with Runs(plain, checked, label="errors", **workers) as runs:
        return runs.run_scenes(scenes)


def error_in(row: Row, quantity: str) -> float | None:
    """Return the absolute error of a quantity in a row of `with_errors_of`.

    Half the width of its bounds where the scene does not determine it; None where it is unknown.
    """
    error = (row.get("errors") or {}).get(quantity)
    if error is None:
        return None
    if not error["determined"]:
        return float(error["high"] - error["low"]) / 2.0
    return float(error["error"])
