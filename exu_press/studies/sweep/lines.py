"""A sweep's table as a person reads it in a terminal."""

from collections import Counter
from collections.abc import Sequence

from exu_press.columns import columns
from exu_press.studies.sweep.shown import shown
from exu_press.studies.sweep.table import Table
from exu_press.studies.sweep.units import unit_of

__all__ = ["table_lines"]

MOST_LINES = 24


def table_lines(table: Table, wanted: Sequence[str] = ()) -> list[str]:
    """Return what varies and what came out, at most MOST_LINES runs, and how the runs ended."""
    names = (*table.study.keys, *shown(table, wanted), "status")
    runs = range(min(len(table), MOST_LINES))
    cells = [[_head(name) for name in names]]
    cells += [[table.in_words(name, run, "-") for name in names] for run in runs]
    lines = columns(cells)
    if len(table) > MOST_LINES:
        lines.append(f"... and {len(table) - MOST_LINES} more in table.csv")
    counts = Counter(table["status"])
    lines.append(f"{len(table)} runs: {', '.join(f'{n} {status}' for status, n in counts.items())}")
    reasons = Counter(
        f"{status}: {reason}"
        for status, reason in zip(table["status"], table["reason"], strict=True)
        if reason
    )
    lines += [f"  {number} x {reason}" for reason, number in reasons.most_common(3)]
    return lines


def _head(name: str) -> str:
    unit = unit_of(name)
    return f"{name}, {unit}" if unit and not name.endswith(f"_{unit}") else name
