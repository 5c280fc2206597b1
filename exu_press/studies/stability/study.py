"""The study: every case judged, several at a time; it goes on where it was stopped."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from exu_press.parallel import run_batch
from exu_press.scene.custom import custom_modules
from exu_press.studies.base import arguments_of
from exu_press.studies.stability.cases import Case
from exu_press.studies.stability.judge import WRONG, judge
from exu_press.studies.stability.report import Report, Row

__all__ = ["TIME_LIMIT", "stability"]

TIME_LIMIT = 300.0
"""s for one case; its budget of steps ends it long before, so that a case that gets here hangs."""


def stability(
    table: Sequence[Case],
    directory: str | Path,
    *,
    quick: bool = False,
    workers: int | None = None,
    quiet: bool = True,
) -> Report:
    """Judge cases and return the report.

    Args:
        table: of a user's scene from `extremes`, or one of your own.
        directory: rows are kept in it as they come; called again, finished ones are not run again.
        quick: whether the table is a sample of a larger one.
        workers: number of processes; all cores unless told.
        quiet: False shows the progress on standard error.

    Raises:
        InputError: the directory cannot be used.
    """
    arguments = [{"name": case.name, **arguments_of(case.scene)} for case in table]
    rows = run_batch(
        judge,
        arguments,
        directory,
        workers=workers,
        time_limit=TIME_LIMIT,
        modules=custom_modules({"cases": arguments}),
        label="stability",
        quiet=quiet,
    )
    return Report(quick, tuple(_row(case, row) for case, row in zip(table, rows, strict=True)))


def _row(case: Case, found: Mapping[str, Any]) -> Row:
    told: dict[str, Any] = {"name": case.name, "axis": case.axis, "value": case.value}
    told["parameters"] = case.scene.to_dict()
    if "verdict" not in found:
        reason = f"{found['status']}: {found['reason']}"
        return Row(**told, verdict=WRONG, status=found["status"], reason=reason)
    names = ("verdict", "status", "reason", "checks", "residual", "steps", "wall_time")
    return Row(**told, **{name: found[name] for name in names})
