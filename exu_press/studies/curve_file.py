"""A measured curve as a CSV file that states its units and its length."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from exu_press.errors import InputError, error_prefix
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import eno_cubic, evaluate, hermite
from exu_press.result import Result
from exu_press.result.column import column_of
from exu_press.schema.two_columns import read_two_columns

__all__ = ["OVER", "CurveFile", "channel_polynomials", "factor_to", "line_over_rows", "read_curve"]

OVER = {"time": "s", "crank_angle": "deg"}
"""First column -> the unit that it is converted to."""

RATES = {
    "crank_angle": "crank_speed",
    "slider_position": "slider_velocity",
    "slider_velocity": "slider_acceleration",
}
"""Channel -> the channel of its rate."""

STATED = re.compile(r"#\s*samples\s*[=:]\s*(\d+)\s*")
FEWEST = 4

PREFIXES = {"n": 1e-9, "u": 1e-6, "\N{MICRO SIGN}": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}
HEAD = re.compile(r"(?P<name>[\w.]+)\s*[\[(](?P<unit>[^\])]*)[\])]")


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

    @property
    def axis_label(self) -> str:
        """Label of its axis, with its unit."""
        return f"{self.over.replace('_', ' ')}, {OVER[self.over]}"


def read_curve(path: Path) -> CurveFile:
    """Return the curve of a file.

    Its first line may be "# samples = N". Then come a head, "time (s),slider_velocity (m/s)", and
    two numbers a line.

    Raises:
        InputError: it cannot be read, states another length than it has, has another head, a line
            without two finite numbers, or places that do not increase.
    """
    read = read_two_columns(path)
    (over, over_unit), (name, unit) = (head_of(str(path), head) for head in read.head)
    if over not in OVER:
        raise InputError(f"{path}: first column {over!r}; allowed are {', '.join(OVER)}")
    factor = factor_to(f"{path}: {over}", over_unit, OVER[over])
    count = len(read.places)
    if count < FEWEST:
        raise InputError(f"{path}: {count} samples; allowed are at least {FEWEST}")
    stated = [match[1] for line in read.comments if (match := STATED.fullmatch(line))]
    if stated and stated[0].lstrip("0") != str(count):
        raise InputError(
            f"{path}: states {stated[0]} samples and has {count}; allowed is the same number"
        )
    return CurveFile(over, factor * np.array(read.places), name, unit, np.array(read.values))


def channel_polynomials(where: str, curve: CurveFile, result: Result) -> tuple[Array, Array, str]:
    """Return what a run has of the quantity that a curve shows, over places that increase.

    Between steps it is Hermite's polynomial where the run has the channel's rate; else, as forces
    have corners and jumps, `eno_cubic`.

    Args:
        where: the file, said of a fault.
        curve: whose second column names a channel, or NAME.x, a column of one.

    Returns:
        the run's times, s, or crank angles, deg, (n,); coefficients of the polynomials between
        them, for `numerics.piecewise.evaluate`; their SI unit.

    Raises:
        InputError: the run has no such channel, or the channel no such column, or its crank
            stands or turns back where the curve is over the crank angle.
    """
    name = curve.name
    with error_prefix(f"{where}: "):
        values, unit = column_of(result, name)
    angle = curve.over == "crank_angle"
    at = np.degrees(result["crank_angle"]) if angle else result.time
    back = (at[1:] <= at[:-1]) & (at[1:] <= curve.at[-1]) & (at[:-1] >= curve.at[0])
    if back.any():
        first = int(np.argmax(back))
        raise InputError(
            f"{where}: over crank_angle; the run's crank stands or turns back at "
            f"{at[first]:.6g} deg, t = {result.time[first]:.6g} s; allowed is a curve over time"
        )
    if name not in RATES:
        return at, eno_cubic(at, values), unit
    rate = result[RATES[name]]
    if angle:
        with np.errstate(divide="ignore", invalid="ignore"):  # where the crank stands
            rate = rate / np.degrees(result["crank_speed"])
    return at, hermite(at, values, rate), unit


def line_over_rows(
    at: Array, polynomials: Array, samples: Array, shift: float = 0.0
) -> tuple[Array, Array]:
    """Return places and values of a computed curve, for its line over a measured one.

    They are the run's own rows between the first and the last sample, and the samples.

    Args:
        at, polynomials: of the run, as `channel_polynomials` has them.
        samples: places of the measured curve, (m,).
        shift: place in the run less that in the measured curve.
    """
    inside = (at > samples[0] + shift) & (at < samples[-1] + shift)
    places = np.union1d(at[inside], samples + shift)
    return places - shift, evaluate(at, polynomials, places)


def factor_to(where: str, unit: str, si_unit: str) -> float:
    """Return the factor from a unit to another one; a product is written with a space or without.

    Args:
        where: said of a fault.
        unit: that the file states.
        si_unit: SI unit of the column; "deg" of a crank angle.

    Raises:
        InputError: the two units are not of one kind.

    >>> factor_to("a.csv", "mm/s", "m/s"), factor_to("a.csv", "kNm", "N m")
    (0.001, 1000.0)
    """
    unit = unit.strip().replace("\N{SUPERSCRIPT TWO}", "^2").replace("\N{DEGREE SIGN}", "deg")
    forms = [si_unit.replace(" ", sign) for sign in (" ", "", "*", "\N{MIDDLE DOT}")]
    if unit in forms:
        return 1.0
    degrees = math.degrees(1.0)
    for angle, angle_unit, factor in (("rad", "deg", degrees), ("deg", "rad", 1.0 / degrees)):
        if unit in [form.replace(angle_unit, angle) for form in forms if angle_unit in form]:
            return factor
    for prefix, factor in PREFIXES.items():
        if unit in [prefix + form for form in forms]:
            return factor
    raise InputError(
        f"{where} in {unit or 'no unit'}: allowed is {si_unit or '1'}, also with a prefix as in "
        f"m{si_unit} or k{si_unit}"
    )


def head_of(where: str, text: str) -> tuple[str, str]:
    """Return name and unit of a column's head, as in "time (s)".

    Raises:
        InputError: it has another form.
    """
    match = HEAD.fullmatch(text.strip())
    if match is None:
        raise InputError(f"{where}: column {text.strip()!r}; allowed is NAME (UNIT), as time (s)")
    return match["name"], match["unit"].strip()
