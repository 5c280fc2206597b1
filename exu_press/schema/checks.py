"""Keys of a scene: their allowed values, and the validation."""

import dataclasses
import difflib
import functools
import itertools
import math
import numbers
import types
import typing
from collections.abc import Collection, Iterable, Mapping, Sized
from typing import Any

from exu_press.errors import InputError

__all__ = [
    "allowed_text",
    "as_float",
    "check_columns",
    "check_increasing",
    "checked_value",
    "demand_at_least_zero",
    "demand_known",
    "demand_name",
    "demand_number",
    "demand_point",
    "key",
    "list_of_tables",
    "nearest",
    "refuse_unknown",
]

SMALLEST, LARGEST = 1e-30, 1e30
"""Magnitudes of a number other than 0: sums and squares within them are numbers, too."""


def key(
    default: Any,
    meaning: str,
    unit: str = "",
    *,
    above: float | None = None,
    at_least: float | None = None,
    at_most: float | None = None,
    choices: tuple[str, ...] = (),
    also: type | None = None,
    numbers: int | None = None,
    source: str = "",
    example: object = None,
) -> Any:
    """Declare one key of a scene table: its default, meaning, unit and allowed range.

    `also` is a class whose objects are allowed as they are; `numbers` says that the value is a list
    of so many numbers, of any number of them where that is 0. `source` says where a default is
    from that decides results; `example` is shown where a key has none and is needed.
    """
    metadata = {
        "meaning": meaning,
        "unit": unit,
        "above": above,
        "at_least": at_least,
        "at_most": at_most,
        "choices": choices,
        "also": also,
        "numbers": numbers,
        "source": source,
        "example": example,
    }
    return dataclasses.field(default=default, metadata=metadata)


def list_of_tables(home: str, meaning: str) -> Any:
    """Declare a key that is a list of tables, [[TABLE.KEY]], each of "module:Class"."""
    metadata = key(None, meaning).metadata
    return dataclasses.field(default=None, metadata={**metadata, "list_of": home})


def allowed_text(field: dataclasses.Field[Any]) -> str:
    """Return which values a key may have."""
    meta = field.metadata
    if "list_of" in meta:
        return f"a list of tables ({meta['meaning']})"
    if meta.get("choices"):
        also = f", or {meta['meaning']}" if meta.get("also") else ""
        return "one of " + ", ".join(repr(choice) for choice in meta["choices"]) + also
    if meta.get("numbers") is not None:
        count = f"{meta['numbers']} numbers" if meta["numbers"] else "numbers"
        return f"a list of {count} ({meta['meaning']}{', ' + meta['unit'] if meta['unit'] else ''})"
    kind = _kind(field)
    noun = {float: "a number", int: "a whole number", bool: "true or false", str: "a text"}[kind]
    bounds = [
        f"{sign} {meta[name]:g}"
        for name, sign in (("above", ">"), ("at_least", ">="), ("at_most", "<="))
        if meta.get(name) is not None
    ]
    text = " ".join([noun, " and ".join(bounds)]).strip()
    return f"{text} ({meta['meaning']}{', ' + meta['unit'] if meta['unit'] else ''})"


def checked_value(field: dataclasses.Field[Any], name: str, value: Any) -> Any:
    """Return the value of one key in its declared type, or raise InputError.

    A whole number is taken for a number; nothing else is converted, clamped or defaulted.
    """
    if value is None and field.default is None:
        return None
    if field.metadata.get("also") and isinstance(value, field.metadata["also"]):
        return value
    if field.metadata.get("numbers") is not None:
        return _numbers(field, name, value)
    kind = _kind(field)
    if not isinstance(value, bool):
        if kind is float and isinstance(value, numbers.Real):
            value = as_float(value)
        elif kind is int and isinstance(value, numbers.Integral):
            value = int(value)
    meta = field.metadata
    right = (
        type(value) is kind
        and (kind is not float or _is_in_range(typing.cast(float, value)))
        and (meta["above"] is None or value > meta["above"])
        and (meta["at_least"] is None or value >= meta["at_least"])
        and (meta["at_most"] is None or value <= meta["at_most"])
        and (not meta["choices"] or value in meta["choices"])
    )
    if not right:
        raise InputError(
            f"{name} = {value!r:.200}: allowed is {allowed_text(field)}{_magnitudes(value)}"
        )
    return value


def _numbers(field: dataclasses.Field[Any], name: str, value: Any) -> tuple[float, ...]:
    """Return a list of finite numbers as a tuple, or raise InputError."""
    count = field.metadata["numbers"]
    if isinstance(value, list | tuple) and (not count or len(value) == count):
        values = [
            as_float(number)
            if isinstance(number, numbers.Real) and not isinstance(number, bool)
            else math.nan
            for number in value
        ]
        if all(map(_is_in_range, values)):
            return tuple(values)
    raise InputError(
        f"{name} = {value!r:.80}: allowed is {allowed_text(field)}{_magnitudes(value)}"
    )


def demand_name(where: str, name: Any) -> None:
    """Raise InputError unless files, tables and commands can hold a name as it is."""
    if not isinstance(name, str) or not (name.isidentifier() and name.isascii()):
        raise InputError(
            f"{where}: {name!r:.80} is no name; allowed are digits, _ and letters from a to z, "
            "large or small"
        )


def demand_number(where: str, value: Any) -> None:
    """Raise InputError unless a value is a number of an allowed magnitude."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not _is_in_range(value):
        raise InputError(f"{where} = {value!r:.80}: allowed is a number{_magnitudes(value)}")


def demand_at_least_zero(where: str, value: Any, unit: str = "", *, positive: bool = False) -> None:
    """Raise InputError unless a value is a number >= 0, or > 0."""
    demand_number(where, value)
    if value < 0.0 or (positive and value == 0.0):
        limit = f"{'>' if positive else '>='} 0{f' ({unit})' if unit else ''}"
        raise InputError(f"{where} = {value!r}: allowed is a number {limit}")


def demand_point(where: str, value: Any) -> None:
    """Raise InputError unless a value is a point, in m."""
    if not isinstance(value, tuple) or len(value) != 2:
        raise InputError(f"{where} = {value!r}: allowed are two numbers, x and y (m)")
    for number in value:
        demand_number(where, number)


def _is_in_range(value: float) -> bool:
    return value == 0.0 or SMALLEST <= abs(value) <= LARGEST


def _magnitudes(value: Any) -> str:
    """Return which magnitudes are allowed, where a number, or one of a list, has none of them."""
    values = value if isinstance(value, list | tuple) else [value]
    if all(
        _is_in_range(number) for number in values if type(number) is float and math.isfinite(number)
    ):
        return ""
    return f"; a number is 0, or its magnitude is within {SMALLEST:g} and {LARGEST:g}"


def as_float(value: Any) -> float:
    """Return a number as a float; infinite where it is larger than any."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def refuse_unknown(where: str, keys: Mapping[str, Any], known: Collection[str]) -> None:
    """Raise InputError for the first key of a table that is not known."""
    for name, value in keys.items():
        if name not in known:
            path = f"{where}.{name}" if where else name
            demand_known(f"{path} = {value!r:.200}: unknown key", name, known)


MOST_NAMES, LIKE = 24, 8
"""Names that a message lists; with more of them so many that are like the one in question."""


def demand_known(
    text: str, name: Any, known: Iterable[str], allowed: Collection[str] | None = None
) -> None:
    """Raise InputError, with the nearest and all known names behind it, unless a name is known.

    Of many names only some that are most like it.

    Args:
        text: begins the message.
        name: that is to be known.
        known: names.
        allowed: those of the known names that the message lists; all of them unless given.
    """
    if name not in (names := list(known)):
        listed, rest = names if allowed is None else [n for n in names if n in allowed], ""
        if (count := len(listed)) > MOST_NAMES:
            like = difflib.get_close_matches(str(name), listed, n=LIKE, cutoff=0.3)
            listed = like or listed[:LIKE]
            rest = f" and {count - len(listed)} others"
        raise InputError(f"{text}{nearest(name, names)}; allowed are {', '.join(listed)}{rest}")


def check_columns(names: tuple[str, str], first: Sized, second: Sized) -> None:
    """Raise InputError unless two columns of a curve are of one length, two or more."""
    if len(first) < 2 or len(first) != len(second):
        raise InputError(
            f"{', '.join(names)}: {len(first)} and {len(second)} values; allowed are at least two, "
            "as many of both"
        )


def check_increasing(name: str, values: Iterable[float]) -> None:
    """Raise InputError for the first value that is not larger than the one before."""
    for previous, following in itertools.pairwise(values):
        if not following > previous:
            raise InputError(f"{name} = {following!r} after {previous!r}: allowed is increasing")


def nearest(name: Any, known: Iterable[str]) -> str:
    """Return a question after the known name that is most like a misspelt one, or nothing.

    >>> nearest("viscocity", ["law", "viscosity"])
    " (did you mean 'viscosity'?)"
    """
    matches = difflib.get_close_matches(str(name), list(known), n=1)
    return f" (did you mean {matches[0]!r}?)" if matches else ""


@functools.cache
def _kind(field: dataclasses.Field[Any]) -> type:
    kinds = typing.get_args(field.type) or (field.type,)
    return next(kind for kind in kinds if isinstance(kind, type) and kind is not types.NoneType)
