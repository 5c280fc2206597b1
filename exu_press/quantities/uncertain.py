"""A figure with its error, as people write it."""

import math
from collections.abc import Mapping
from typing import Any

__all__ = ["significant", "uncertain"]

MOST_DIGITS = 7
"""Digits to which a figure is exact: with a smaller error it is shown without."""


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
        error: of the summary's `errors`; None where nothing is known.
        scale: to the unit that is shown.
        digits: of a figure without error.

    >>> stated = {"error": 167.3, "determined": True, "low": 846.7, "high": 1181.3}
    >>> uncertain(1014.2, stated)
    '1010 +- 170'
    >>> uncertain(1014.2, {**stated, "determined": False, "low": 860.1, "high": 1084.6})
    '860 to 1080, not determined'
    >>> uncertain(5, {**stated, "error": 0.0})
    '5 exact'
    >>> uncertain(5, {**stated, "determined": False, "low": 4, "high": 7})
    '5 (4 to 7, not determined)'
    """
    if value is None:
        return "-"
    if error is None:
        return significant(value * scale, digits)
    if not error["determined"]:
        low, high = error["low"] * scale, error["high"] * scale
        if isinstance(value, int):
            return f"{value} ({low:.3g} to {high:.3g}, not determined)"
        return f"{_bound_text(low, high)} to {_bound_text(high, high)}, not determined"
    spread, scaled = error["error"] * scale, value * scale
    if spread <= abs(scaled) * 10.0**-MOST_DIGITS:
        return f"{significant(scaled, digits if isinstance(value, float) else MOST_DIGITS)} exact"
    places = 1 - math.floor(math.log10(spread))
    return f"{_places(scaled, places)} +- {_places(spread, places)}"


def _bound_text(value: float, largest: float) -> str:
    """Return a bound with three digits of the larger one."""
    return _places(value, 2 - math.floor(math.log10(abs(largest)))) if largest else f"{value:.3g}"


def _places(value: float, places: int) -> str:
    return f"{round(value, places):.{max(places, 0)}f}"
