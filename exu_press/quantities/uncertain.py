"""A figure with its error, as people write it."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

__all__ = ["CELL", "UNDERFLOW", "bracket_legend", "bracket_text", "significant", "uncertain"]

MOST_DIGITS = 6
"""Significant digits of a figure in a narrow cell."""

MOST_PLACES = 8
"""Places behind the first digit of a figure and its error; a smaller error is rounded up."""

CELL = 11
"""Letters of a narrow cell."""

FORMS = (
    (r".*\(", "857.3(9): within 0.9 of 857.3 at 95 %, in units of the last digit"),
    (r".*\.\.", "830..1540: not determined, between these at 95 %"),
    (r"=", "=5: exact"),
    (r"-$", "-: has none"),
    (r"(?!.*\.\.)[^=(]*\d[^=(]*$", "without brackets: error not known"),
)
"""Patterns of the texts that `bracket_text` returns, with their meanings."""

UNDERFLOW = 1e-30
"""SI: a smaller figure is what a fading force has left, and is shown as 0."""

LARGEST_WRITTEN_OUT = 1e12
"""Larger numbers keep their exponent."""


def significant(value: float, digits: int) -> str:
    """Return a number with so many significant digits; a large one is written out.

    >>> significant(331.7, 2), significant(167100.0, 4), significant(3.2e-7, 2)
    ('330', '167100', '3.2e-07')
    """
    text = f"{value:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(value) < LARGEST_WRITTEN_OUT else text


def uncertain(
    value: float | None, error: Mapping[str, Any] | None, scale: float = 1.0, digits: int = 4
) -> str:
    """Return a figure with its error, or its bounds where the scene does not determine it.

    Args:
        value: SI, None where there is none.
        error: of the summary's `errors`, or its entry of a quantity; without an error nothing is
            known.
        scale: to the unit that is shown.
        digits: of a figure without error.

    >>> stated = {"error": 167.3, "determined": True, "low": 846.7, "high": 1181.3}
    >>> uncertain(1014.2, stated)
    '1010 +- 170'
    >>> uncertain(1014.2, {**stated, "determined": False, "low": 860.1, "high": 1084.6})
    '860 to 1080, not determined'
    >>> uncertain(5, {**stated, "error": 0.0}), uncertain(5, {**stated, "error": 1.0})
    ('5 exact', '5 +- 1')
    >>> uncertain(5, {**stated, "determined": False, "low": 4, "high": 7})
    '5 (4 to 7, not determined)'
    >>> uncertain(-9.41e-94, None), uncertain(9.41e-94, {**stated, "error": 1e-95})
    ('0', '0 exact')
    """
    if value is None:
        return "-"
    value, error = _without_underflow(value, error)
    if error is None or error["error"] is None:
        return str(value) if isinstance(value, int) else significant(value * scale, digits)
    if not error["determined"]:
        low, high = error["low"] * scale, error["high"] * scale
        if isinstance(value, int):
            return f"{value} ({low:.3g} to {high:.3g}, not determined)"
        return f"{_bound_text(low, high)} to {_bound_text(high, high)}, not determined"
    if error["error"] == 0.0:
        return f"{value if isinstance(value, int) else significant(value * scale, digits)} exact"
    spread, scaled = error["error"] * scale, value * scale
    if isinstance(value, int):
        return f"{value} +- {math.ceil(spread)}"
    places = 1 - _exponent(spread)
    most = MOST_PLACES - _exponent(scaled)
    if places > most:
        return f"{_places(scaled, most)} +- {_places(10.0**-most, most)}"
    return f"{_places(scaled, places)} +- {_places(spread, places)}"


def bracket_text(
    value: float | None, error: Mapping[str, Any] | None, scale: float = 1.0, digits: int = 4
) -> str:
    """Return a figure in at most CELL letters: with one digit of its error, or as a range.

    The error is rounded up, and by as much as the figure itself is rounded; bounds are rounded
    outwards, to three digits, or to two where three do not fit. Arguments as of `uncertain`.

    >>> stated = {"error": 0.83, "determined": True, "low": 856.5, "high": 858.1}
    >>> bracket_text(857.31, stated), bracket_text(26.38393712, {**stated, "error": 1e-9})
    ('857.3(9)', '26.3839(1)')
    >>> bracket_text(1014.2, {**stated, "determined": False, "low": 830.4, "high": 1535.0})
    '830..1540'
    >>> bracket_text(5, {**stated, "error": 0.0}), bracket_text(5, None), bracket_text(None, None)
    ('=5', '5', '-')
    """
    if value is None:
        return "-"
    value, error = _without_underflow(value, error)
    scaled, whole = value * scale, isinstance(value, int)
    if error is not None and error["error"] is None:
        error = None
    if error is None or error["error"] == 0.0:
        digits = digits if error is None else MOST_DIGITS
        text = _narrow(scaled, 0 if whole else max(digits - 1 - _exponent(scaled), 0))
        return text if error is None else f"={text}"
    if whole or not error["determined"]:
        return _range(error["low"] * scale, error["high"] * scale, whole=whole)
    spread = error["error"] * scale
    forms = [(False, most) for most in (MOST_DIGITS, MOST_DIGITS - 1)]
    forms += [(True, most) for most in range(MOST_DIGITS, 0, -1)]
    texts = (_with_last_digit(scaled, spread, most, power) for power, most in forms)
    return next(text for text in texts if len(text) <= CELL)


def bracket_legend(rows: Iterable[Sequence[str]]) -> str:
    """Return what the forms of `bracket_text` mean that rows of a title and cells have.

    >>> bracket_legend([["impacts", "=7", "-"]]), bracket_legend([["energy residual", "0.00033"]])
    ('=5: exact; -: has none.', 'without brackets: error not known.')
    """
    cells = [cell for _, *row in rows for cell in row]
    present = (
        meaning for pattern, meaning in FORMS if any(re.match(pattern, cell) for cell in cells)
    )
    return f"{'; '.join(present)}."


def _without_underflow(
    value: float, error: Mapping[str, Any] | None
) -> tuple[float, Mapping[str, Any] | None]:
    """Return a figure and its error, both 0 where they are smaller than any figure."""
    stated = 0.0 if error is None or error["error"] is None else error["error"]
    if not abs(value) + stated < UNDERFLOW:  # nor what is no number
        return value, error
    return 0 * abs(value), {**error, "error": 0.0} if error is not None and stated else error


def _with_last_digit(value: float, spread: float, most: int, power: bool) -> str:
    """Return a figure of at most `most` digits with its error in brackets, also as a power."""
    places = min(-_exponent(spread), most - 1 - _exponent(value))
    while True:
        missed = spread + abs(value - round(value, places))
        last = math.ceil(missed * 10.0**places * (1.0 - 1e-9))
        if last < 10:
            break
        places -= 1
    if not power:
        return f"{_places(value, places)}({last * 10 ** max(-places, 0)})"
    exponent = max(_exponent(value), -places)
    return f"{value / 10.0**exponent:.{exponent + places}f}({last})e{exponent}"


def _range(low: float, high: float, *, whole: bool) -> str:
    """Return bounds, rounded outwards, in at most CELL letters."""
    exponent = _exponent(max(abs(low), abs(high)))
    forms = [(0, 0)] if whole else []  # power of ten in the text, places behind the point
    forms += [(0, digits - 1 - exponent) for digits in (3, 2)]
    forms += [(exponent - digits + 1, 0) for digits in (3, 2, 1)]
    texts = (
        f"{_outwards(low / 10.0**power, places, up=False)}.."
        f"{_outwards(high / 10.0**power, places, up=True)}{f'e{power}' if power else ''}"
        for power, places in forms
    )
    return next(text for text in texts if len(text) <= CELL)


def _outwards(bound: float, places: int, *, up: bool) -> str:
    """Return a bound, rounded up or down; a whole number of units stays."""
    units = bound * 10.0**places
    whole = math.ceil(units - 1e-9) if up else math.floor(units + 1e-9)
    return _places(whole / 10.0**places, places)


def _narrow(value: float, places: int) -> str:
    """Return a figure with so many places, in at most CELL letters less one."""
    if not value:
        return "0"
    text = _places(value, places)
    if len(text) < CELL and float(text):
        return text
    return f"{value:.3g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def _exponent(value: float) -> int:
    """Return the power of ten of a figure's first digit."""
    return math.floor(math.log10(abs(value))) if value else 0


def _bound_text(value: float, largest: float) -> str:
    """Return a bound with three digits of the larger one."""
    return _places(value, 2 - _exponent(largest)) if largest else f"{value:.3g}"


def _places(value: float, places: int) -> str:
    return f"{round(value, places) + 0.0:.{max(places, 0)}f}"
