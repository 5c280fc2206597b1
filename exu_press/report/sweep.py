"""The report of a sweep: its runs as a table and a picture."""

import shlex
from collections import Counter
from pathlib import Path

from exu_press.errors import InputError
from exu_press.page import Live
from exu_press.page.study import Column, study_viewer
from exu_press.plots.file import save_figures
from exu_press.plots.sweep import sweep_figures
from exu_press.plots.words import ONE_LINE, describe
from exu_press.quantities.catalogue import find_quantity
from exu_press.quantities.kind import COST
from exu_press.report.html import page, paragraph, picture, stills, table, warnings
from exu_press.report.run import scene_parts
from exu_press.report.study import command_of, reading, shown_column
from exu_press.scene.warnings import scene_warnings
from exu_press.schema.checks import table_from
from exu_press.schema.csv_table import read_csv
from exu_press.studies.sweep import Sweep, Table
from exu_press.studies.sweep.lines import shown
from exu_press.studies.sweep.table import cell
from fe_models.temporary import TemporaryFolder

__all__ = ["sweep_report"]

MOST_ROWS = 500


def sweep_report(file: Path) -> str:
    """Return the page of a sweep, from table.csv and study.json beside it."""
    runs = _table(file)
    counts = Counter(str(status) for status in runs["status"])
    ends = ", ".join(f"{number} {status}" for status, number in counts.items())
    ended = ("status", "reason") if any(runs["reason"]) else ("status",)
    names = (*runs.study.keys, *ended, *shown(runs))  # how it ended is seen at once
    count = min(len(runs), MOST_ROWS)
    numbers = "run", *map(str, range(count))
    shown_runs = (runs.in_words(name, range(count)) for name in names)
    head, *rows = zip(numbers, *shown_runs, strict=True)
    more = "" if count == len(runs) else paragraph(f"{len(runs) - count} more in {file.name}.")
    nothing = paragraph("No number varies, or none came out.")
    with TemporaryFolder() as folder:
        pictures = [
            picture(path, f"Over {' and '.join(runs.study.keys)}.")
            for path in save_figures(sweep_figures(runs), folder)
        ]
    reasons = Counter(str(reason) for reason in runs["reason"] if reason)
    reasons += Counter(warning for scene in runs.study.scenes for warning in scene_warnings(scene))
    told = [f"{number} x {reason}" for reason, number in reasons.most_common(10)]
    live = _live(runs)
    return page(
        f"Sweep: {describe(runs.study.scenes, ONE_LINE)}",
        f"{len(runs)} runs over {', '.join(runs.study.keys)}: {ends}; "
        f"{file.parent.name}/{file.name}",
        [
            ("Points", live),
            ("Runs", table(head, rows, name="runs") + more),
            ("Warnings", warnings(told)),
            ("Pictures", stills("\n".join(pictures) or nothing, live)),
            *scene_parts(runs.study.scene),
        ],
    )


def _live(runs: Table) -> Live | None:
    """Return the runs as points that open; nothing without the extra `page`, or without numbers."""
    shown_first = shown(runs)
    numeric = [
        name
        for name in runs.columns
        if (placed := find_quantity(name)) is not None
        and placed.quantity.kind is not COST
        and runs.is_numeric(name)
        and len(set(runs[name])) > 1
    ]
    names = list(dict.fromkeys([*shown_first, *numeric]))
    if not names:
        return None

    def column(name: str) -> Column:
        errors = [runs.error(name, run) for run in range(len(runs))]
        if not any(errors):
            return shown_column(name, runs[name])
        low, high = ([e[end] if e else None for e in errors] for end in ("low", "high"))
        return shown_column(name, runs[name], low, high)

    opens = [_command(runs, run) for run in range(len(runs))]
    keys = [column(name) for name in runs.study.keys]
    return study_viewer(keys, [column(name) for name in names], opens)


def _command(runs: Table, run: int) -> str:
    """Return the command that shows a run again: its file's, or the one that computes it."""
    if "file" in runs.columns:
        return f"exu-press view {shlex.quote(str(runs['file'][run]))}"
    return command_of({name: runs[name][run] for name in runs.study.keys})


def _table(file: Path) -> Table:
    """Return the table that a sweep wrote; columns that its runs lack stay empty."""
    with reading(file, "a sweep of exu_press", "study.json") as told:
        study, columns = table_from(Sweep, "", told), read_csv(file)
    asked = {name: tuple(cell(point[name]) for point in study.points) for name in study.keys}
    if not {"status", "reason"} <= set(columns) or any(columns.get(n) != asked[n] for n in asked):
        raise InputError(f"{file}: does not belong to the study.json beside it")
    return Table(study, columns)
