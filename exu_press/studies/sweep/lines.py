"""A sweep's table in a terminal: its columns and their form."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from exu_press.errors import InputError
from exu_press.quantities import Owner, Quantity
from exu_press.quantities.catalogue import find_quantity
from exu_press.studies.sweep.table import Table
from exu_press.terminal.columns import columns

__all__ = ["report_lines", "shown"]

MOST_COLUMNS = 4
NO_CHANGE = 1e-6
"""Relative."""
MOST_LINES = 24


def report_lines(table: Table, over: Sequence[str] = (), show: Sequence[str] = ()) -> list[str]:
    """Return keys and quantities of at most MOST_LINES runs, and how the runs ended."""
    names = (*table.study.keys, *shown(table, show), "status")
    runs = range(min(len(table), MOST_LINES))
    lines = columns(list(zip(*(table.in_words(name, runs, "-") for name in names), strict=True)))
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
    return tuple(wanted) or _changing_most(table)


def _changing_most(table: Table) -> tuple[str, ...]:
    """Return the quantities that change most, each at one place, as far as tables show them.

    Of joints those with clearance count, if there are any. The order is the catalogue's.
    """
    loose = table.study.scene.joints.with_clearance
    most: dict[Quantity, tuple[float, str]] = {}
    for name in table.columns:
        placed = find_quantity(name)
        if placed is None or not (placed.quantity.title and placed.quantity.kind.has_error):
            continue
        if placed.quantity.owner is Owner.JOINT and loose and placed.owner not in loose:
            continue
        if (change := _change(table, name)) > NO_CHANGE:
            before, _ = most.get(placed.quantity, (0.0, ""))
            if change > before * (1.0 + NO_CHANGE):
                most[placed.quantity] = change, name
    chosen = {name for _, name in sorted(most.values(), reverse=True)[:MOST_COLUMNS]}
    return tuple(name for name in table.columns if name in chosen)


def _change(table: Table, name: str) -> float:
    if not table.is_numeric(name):
        return 0.0
    values = table.numbers(name)
    values = values[np.isfinite(values)]
    largest = float(np.abs(values).max(initial=0.0))
    return (1.0 if len(values) == 1 else float(np.ptp(values)) / largest) if largest else 0.0
