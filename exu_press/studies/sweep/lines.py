"""What of a sweep's table is shown, and how a person reads it in a terminal."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from exu_press.columns import columns
from exu_press.errors import InputError
from exu_press.studies.sweep.table import Table
from exu_press.studies.sweep.units import unit_of

__all__ = ["shown", "table_lines"]

USUAL = (
    "peak_acceleration.resolved",
    "joints.crank_pin.peak_force",
    "joints.ball_left.peak_force",
    "joints.crank_pin.min_film",
    "bottom_dead_centre",
    "energy.dissipated",
)
MOST_COLUMNS = 4
NO_CHANGE = 1e-6
"""Relative."""
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


def shown(table: Table, wanted: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the columns wanted, or the first few usual ones in which the runs differ.

    Raises:
        InputError: there is no such column of numbers.
    """
    for name in wanted:
        if name not in table.columns or not table.is_numeric(name):
            numeric = [n for n in table.columns if table.is_numeric(n) and "scene." not in n]
            raise InputError(
                f"--show {name}: allowed are {', '.join(numeric) or 'none, as no run has a number'}"
            )
    there = [name for name in USUAL if name in table.columns and _changes(table, name)]
    return tuple(wanted) or tuple(there[:MOST_COLUMNS])


def _changes(table: Table, name: str) -> bool:
    """Return whether a column has numbers that differ by more than rounding."""
    if not table.is_numeric(name):
        return False
    values = table.numbers(name)
    values = values[np.isfinite(values)]
    return bool(len(values) == 1 or np.ptp(values) > NO_CHANGE * np.abs(values).max())


def _head(name: str) -> str:
    unit = unit_of(name)
    return f"{name}, {unit}" if unit and not name.endswith(f"_{unit}") else name
