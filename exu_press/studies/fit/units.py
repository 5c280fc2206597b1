"""Units of a measurement's columns: the SI unit with a prefix, or an angle."""

import math
import re

from exu_press.errors import InputError

__all__ = ["factor_to"]

PREFIXES = {"n": 1e-9, "u": 1e-6, "\N{MICRO SIGN}": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6}
HEAD = re.compile(r"(?P<name>[\w.]+)\s*[\[(](?P<unit>[^\])]*)[\])]")


def factor_to(where: str, unit: str, wanted: str) -> float:
    """Return what a number in a unit is to be multiplied by.

    Args:
        where: said of a fault.
        unit: that the file states.
        wanted: SI unit of the column; "deg" of a crank angle.

    Raises:
        InputError: the two units are not of one kind.

    >>> factor_to("a.csv", "mm/s", "m/s"), factor_to("a.csv", "kN", "N")
    (0.001, 1000.0)
    """
    unit = unit.strip().replace("\N{SUPERSCRIPT TWO}", "^2")
    if unit == wanted:
        return 1.0
    if (unit, wanted) == ("rad", "deg"):
        return 180.0 / math.pi
    for prefix, factor in PREFIXES.items():
        if unit == prefix + wanted:
            return factor
    raise InputError(
        f"{where} in {unit or 'no unit'}: allowed is {wanted or '1'}, also with a prefix as in "
        f"m{wanted} or k{wanted}"
    )


def head_of(where: str, text: str) -> tuple[str, str]:
    """Return name and unit of a column's head, as in "time (s)".

    Raises:
        InputError: it has another form.
    """
    found = HEAD.fullmatch(text.strip())
    if found is None:
        raise InputError(f"{where}: column {text.strip()!r}; allowed is NAME (UNIT), as time (s)")
    return found["name"], found["unit"].strip()
