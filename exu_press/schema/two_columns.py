"""A CSV file of two columns, as instruments and spreadsheets write it; # begins a comment."""

import csv
from dataclasses import dataclass
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.input_file import read_text
from exu_press.schema.stored import LARGEST

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

    The delimiter of the head, a comma, a semicolon or a tab, holds for all lines. Numbers have a
    decimal point or, where the delimiter is no comma, all of them a decimal comma.

    Raises:
        InputError: the file cannot be read, or has another number of columns, a line without two
            finite numbers, decimal points and commas, or places that do not increase.
    """
    lines = [(n, line.strip()) for n, line in enumerate(read_text(path).splitlines(), 1)]
    comments = [line for _, line in lines if line.startswith("#")]
    (_, head), *rows = [(n, line) for n, line in lines if line and line[0] != "#"] or [(0, "")]
    try:
        dialect = csv.Sniffer().sniff(head, delimiters=",;\t")
        names = _cells(head, dialect)
        if len(names) != 2:
            raise csv.Error
    except csv.Error:
        raise InputError(
            f"{path}: header {head[:80]!r}; allowed are two names with a comma, a semicolon or a "
            "tab between"
        ) from None
    comma = dialect.delimiter != "," and any("," in line for _, line in rows)
    places: list[float] = []
    values: list[float] = []
    for number, line in rows:
        where = f"{path}, line {number}: {line[:80]!r}"
        try:
            if comma and "." in line:
                raise InputError(f"{where}; allowed is a decimal comma, as on other lines")
            cells = (c.replace(",", ".") if comma else c for c in _cells(line, dialect))
            position, value = map(float, cells)
        except InputError:
            raise
        except (ValueError, csv.Error):
            raise InputError(f"{where}; allowed are two numbers") from None
        if not (abs(position) < LARGEST and abs(value) < LARGEST):
            raise InputError(f"{where}; allowed are finite numbers below {LARGEST:g}")
        if places and not position > places[-1]:
            raise InputError(
                f"{path}, line {number}: {position:g} after {places[-1]:g}; allowed is increasing"
            )
        places.append(position)
        values.append(value)
    return TwoColumns(comments, names, places, values)


def _cells(line: str, dialect: type[csv.Dialect]) -> list[str]:
    return [cell.strip() for cell in next(csv.reader([line], dialect))]
