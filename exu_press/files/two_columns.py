"""A CSV file of two columns: a head, then two numbers a line; # begins a comment."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.input_file import read_text

__all__ = ["TwoColumns", "read_two_columns"]


@dataclass(frozen=True)
class TwoColumns:
    """The content of a file.

    Attributes:
        comments: its lines that begin with #.
        head: of the two columns.
        places: numbers of the first column, increasing.
        values: numbers of the second one.
    """

    comments: list[str]
    head: list[str]
    places: list[float]
    values: list[float]


def read_two_columns(path: Path) -> TwoColumns:
    """Return the columns of a file; empty lines are left out.

    Raises:
        InputError: the file cannot be read, or has another number of columns, a line without two
            finite numbers, or places that do not increase.
    """
    lines = [(n, line.strip()) for n, line in enumerate(read_text(path).splitlines(), 1)]
    comments = [line for _, line in lines if line.startswith("#")]
    (_, head), *rows = [(n, line) for n, line in lines if line and line[0] != "#"] or [(0, "")]
    if head.count(",") != 1:
        raise InputError(f"{path}: header {head[:80]!r}; allowed are two names with a comma")
    places: list[float] = []
    values: list[float] = []
    for number, line in rows:
        where = f"{path}, line {number}"
        try:
            place, value = map(float, next(csv.reader([line])))
        except (ValueError, csv.Error):
            raise InputError(f"{where}: {line[:80]!r}; allowed are two numbers") from None
        if not (math.isfinite(place) and math.isfinite(value)):
            raise InputError(f"{where}: {line[:80]!r}; allowed are finite numbers")
        if places and not place > places[-1]:
            raise InputError(f"{where}: {place:g} after {places[-1]:g}; allowed is increasing")
        places.append(place)
        values.append(value)
    return TwoColumns(comments, [cell.strip() for cell in head.split(",")], places, values)
