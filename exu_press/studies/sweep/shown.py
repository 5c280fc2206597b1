"""Which columns of a table are worth a look."""

from collections.abc import Sequence

import numpy as np

from exu_press.errors import InputError
from exu_press.studies.sweep.table import Table

__all__ = ["shown"]

USUAL = (
    "peak_acceleration.resolved",
    "joints.crank_pin.peak_force",
    "joints.ball_left.peak_force",
    "joints.crank_pin.min_film",
    "bottom_dead_centre",
    "energy.dissipated",
)
MOST = 4
ROUNDING = 1e-6
"""Relative."""


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
    return tuple(wanted) or tuple(there[:MOST])


def _changes(table: Table, name: str) -> bool:
    """Return whether a column has numbers that differ by more than rounding."""
    if not table.is_numeric(name):
        return False
    values = table.numbers(name)
    values = values[np.isfinite(values)]
    return bool(len(values) == 1 or np.ptp(values) > ROUNDING * np.abs(values).max())
