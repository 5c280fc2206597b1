"""The error of a run at chosen points of a study: the same scenes with refinement runs."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from exu_press.parallel.task import Row
from exu_press.scene import Scene
from exu_press.studies.base.runs import Runs
from exu_press.studies.base.study import Study

__all__ = ["CHECKED", "error_in", "with_errors_of"]

CHECKED = "checked"
"""Directory inside the study's own."""


def with_errors_of(
    study: Study, directory: str | Path, scenes: Sequence[Scene], **how: Any
) -> list[Row]:
    """Return the rows of scenes with their errors.

    Args:
        study: whose runs these are.
        directory: of the study.
        scenes: to run.
        how: workers, dask, quiet of `Runs`.
    """
    plain = dataclasses.replace(study, errors=True, save_runs=False)
    with Runs(plain, Path(directory) / CHECKED, label="errors", **how) as runs:
        return runs.of(scenes)


def error_in(row: Row, quantity: str) -> float | None:
    """Return the absolute error of a quantity in such a row.

    Half the width of its bounds where the scene does not determine it; None where nothing is known.
    """
    told = (row.get("errors") or {}).get(quantity)
    if told is None:
        return None
    if not told["determined"]:
        return float(told["high"] - told["low"]) / 2.0
    return float(told["error"])
