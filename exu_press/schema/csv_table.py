"""A table as a CSV file: numbers with all their digits, nothing where there is none."""

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import replacing

__all__ = ["Value", "flat", "write_csv"]

Value = str | float | bool | None


def write_csv(path: Path, columns: Mapping[str, Sequence[Value]]) -> None:
    """Write columns of equal lengths under their names."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_text(value) for value in row] for row in zip(*columns.values(), strict=True))
    with replacing(path) as partial:
        partial.write_text(text.getvalue(), encoding="utf-8")


def flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return nested tables as one, names joined by a dot; raise InputError for one given twice.

    >>> flat({"film": {"viscosity": 0.1}, "revolutions": 2.0})
    {'film.viscosity': 0.1, 'revolutions': 2.0}
    """
    columns: dict[str, Any] = {}
    for name, value in table.items():
        is_table = isinstance(value, Mapping)
        inner = flat(value, f"{prefix}{name}.") if is_table else {prefix + name: value}
        if both := columns.keys() & inner.keys():
            raise InputError(f"{both.pop()}: given twice")
        columns |= inner
    return columns


def _text(value: Value) -> str:
    """Return the text of a cell; `repr` shows all digits of a number."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else repr(value)
