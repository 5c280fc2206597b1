"""A load's table as a CSV file: a header of two names, then two numbers a line."""

import csv
import math
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.input_file import read_text
from exu_press.scene.load import COLUMNS

__all__ = ["MOVED", "read_load_table"]

MOVED = "is height now, which counts from bottom dead centre, and acts = 'both' for a spring"
"""The key that replaces the position of the slider."""

HEADERS = " or ".join(f"'{name},force'" for name in COLUMNS)


def read_load_table(path: str | Path) -> dict[str, list[float]]:
    """Return the two columns of a file by their names.

    Lines that are empty or begin with # are left out.

    Raises:
        InputError: the file cannot be read, has another header, a line without two numbers, or
            places that do not increase.
    """
    path = Path(path)
    text = read_text(path)
    lines = [
        (number, line.strip())
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.startswith("#")
    ]
    header = [name.strip() for name in lines[0][1].split(",")] if lines else []
    if len(header) != 2 or header[0] not in COLUMNS or header[1] != "force":
        shown = lines[0][1][:80] if lines else ""
        moved = f" (slider_position {MOVED})" if "slider_position" in header else ""
        raise InputError(f"{path}: header {shown!r}; allowed is {HEADERS}{moved}")
    rows: list[tuple[float, float]] = []
    for number, line in lines[1:]:
        rows.append(_numbers(f"{path}, line {number}", line))
        if len(rows) > 1 and not rows[-1][0] > rows[-2][0]:
            raise InputError(
                f"{path}, line {number}: {header[0]} = {rows[-1][0]:g} after {rows[-2][0]:g}; "
                "allowed is increasing"
            )
    if len(rows) < 2:
        raise InputError(f"{path}: {len(rows)} lines of numbers; allowed are at least two")
    places, forces = zip(*rows, strict=True)
    return {header[0]: list(places), "force": list(forces)}


def _numbers(where: str, line: str) -> tuple[float, float]:
    try:
        place, force = map(float, next(csv.reader([line])))
    except (ValueError, csv.Error):
        raise InputError(f"{where}: {line[:80]!r}; allowed are two numbers") from None
    if not (math.isfinite(place) and math.isfinite(force)):
        raise InputError(f"{where}: {line[:80]!r}; allowed are finite numbers")
    return place, force
