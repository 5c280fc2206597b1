"""A measured curve as a CSV file that states its units and its length."""

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from exu_press.errors import InputError
from exu_press.files.input_file import read_text
from exu_press.numerics.arrays import Array
from exu_press.studies.fit.units import factor_to, head_of

__all__ = ["OVER", "CurveFile", "read_curve"]

OVER = {"time": "s", "crank_angle": "deg"}
"""First column -> the unit that it is converted to."""

STATED = re.compile(r"#\s*samples\s*[=:]\s*(\d+)\s*")
FEWEST = 4


@dataclass(frozen=True)
class CurveFile:
    """The contents of a file.

    Attributes:
        over: "time" (s) or "crank_angle" (deg, from top dead centre, going on over revolutions).
        at: (m,), increasing.
        name: of the second column.
        unit: that it states.
        values: (m,), in that unit.
    """

    over: str
    at: Array
    name: str
    unit: str
    values: Array


def read_curve(path: Path) -> CurveFile:
    """Return the curve of a file.

    Its first line may be "# samples = N". Then come a head, "time (s),slider_velocity (m/s)", and
    two numbers a line.

    Raises:
        InputError: it cannot be read, states another length than it has, has another head, a line
            without two finite numbers, or places that do not increase.
    """
    lines = [
        (number, line.strip())
        for number, line in enumerate(read_text(path).splitlines(), 1)
        if line.strip()
    ]
    stated = [found[1] for _, line in lines if (found := STATED.fullmatch(line))]
    lines = [(number, line) for number, line in lines if not line.startswith("#")]
    if not lines:
        raise InputError(f"{path}: empty; allowed is a head and two numbers a line")
    heads = lines[0][1].split(",")
    if len(heads) != 2:
        raise InputError(
            f"{path}: {len(heads)} columns; allowed are two, as time (s),slider_velocity (m/s)"
        )
    (over, over_unit), (name, unit) = (head_of(str(path), head) for head in heads)
    if over not in OVER:
        raise InputError(f"{path}: first column {over!r}; allowed are {', '.join(OVER)}")
    factor = factor_to(f"{path}: {over}", over_unit, OVER[over])
    rows = np.array([_numbers(f"{path}, line {number}", line) for number, line in lines[1:]])
    if len(rows) < FEWEST:
        raise InputError(f"{path}: {len(rows)} samples; allowed are at least {FEWEST}")
    if stated and stated[0].lstrip("0") != str(len(rows)):
        raise InputError(
            f"{path}: states {stated[0]} samples and has {len(rows)}; allowed is the same number"
        )
    falls = np.flatnonzero(np.diff(rows[:, 0]) <= 0.0)
    if len(falls):
        line = lines[int(falls[0]) + 2][0]
        raise InputError(f"{path}, line {line}: {over} does not increase; allowed is increasing")
    return CurveFile(over, rows[:, 0] * factor, name, unit, rows[:, 1])


def _numbers(where: str, line: str) -> tuple[float, float]:
    try:
        at, value = map(float, next(csv.reader([line])))
    except (ValueError, csv.Error):
        raise InputError(f"{where}: {line[:80]!r}; allowed are two numbers") from None
    if not np.isfinite([at, value]).all():
        raise InputError(f"{where}: {line[:80]!r}; allowed are finite numbers")
    return at, value
