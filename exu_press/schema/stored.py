"""Stored JSON, checked against the type that it was written as."""

import json
import reprlib
from types import NoneType
from typing import Any, TypeVar, cast, get_args, get_origin, get_type_hints, is_typeddict

from exu_press.errors import InputError

__all__ = ["LARGEST", "from_json", "short_text"]

T = TypeVar("T")

LARGEST = 1e100
"""Largest number that is taken for a quantity: its square is a number too."""

MOST_DIGITS = 4000
"""Of a whole number: Python itself refuses more than 4300, without saying which number it is."""

NOUNS = {
    str: "a text",
    bool: "true or false",
    int: "a whole number",
    float: "a number",
    dict: "a table",
    list: "a list",
    tuple: "a list",
}


def from_json(kind: type[T], text: str | bytes, where: str) -> T:
    """Return the content of a JSON text; a whole number does for a number.

    Args:
        kind: str, bool, int, float, dict[str, ...], list[...], tuple[...], a typed dictionary;
            one of them or None; Any for whatever is made of texts, numbers, lists and dictionaries.
        text: JSON.
        where: the text stands, for messages.

    Raises:
        InputError: the text is no JSON, or its content is of another kind.
    """
    try:
        return cast(T, _check_value(kind, json.loads(text, parse_int=_whole_number), where))
    except InputError:
        raise
    except (ValueError, RecursionError):  # too many nested lists
        raise InputError(f"{where} = {short_text(text)}: allowed is JSON") from None


def _whole_number(digits: str) -> float:
    """Return a whole number; one of too many digits is infinite, which is refused by its name."""
    return int(digits) if len(digits) < MOST_DIGITS else float(digits)


def short_text(value: object) -> str:
    """Return a value from a file for a message: cut short, in one line."""
    return reprlib.repr(value)


def _check_value(kind: Any, value: Any, where: str) -> Any:
    """Return a value of a kind, see `from_json`."""
    if NoneType in get_args(kind):
        return value if value is None else _check_value(get_args(kind)[0], value, where)
    plain = type(value) if kind is Any else dict if is_typeddict(kind) else get_origin(kind) or kind
    if plain is float and type(value) is int and abs(value) < LARGEST:
        value = float(value)
    right = type(value) is (list if plain is tuple else plain)
    if not right or (isinstance(value, int | float) and not abs(value) < LARGEST):
        raise InputError(f"{where} = {short_text(value)}: allowed is {NOUNS[plain]}")
    if isinstance(value, str):
        _check_text(value, where)
    if is_typeddict(kind):
        return _table(kind, value, where)
    if isinstance(value, dict):
        inner = get_args(kind)[1] if get_args(kind) else Any
        return {name: _check_value(inner, value[name], _inside(where, name)) for name in value}
    if isinstance(value, list):
        inner = get_args(kind) or (Any, ...)
        if plain is list or inner[-1] is ...:
            inner = inner[:1] * len(value)
        if len(inner) != len(value):
            raise InputError(f"{where} = {short_text(value)}: allowed are {len(inner)} values")
        values = [
            _check_value(kind_of_item, item, where)
            for kind_of_item, item in zip(inner, value, strict=True)
        ]
        return tuple(values) if plain is tuple else values
    return value


def _table(kind: Any, value: dict[str, Any], where: str) -> dict[str, Any]:
    """Return a dictionary that has all keys of a typed one, and no others."""
    kinds = get_type_hints(kind)
    for name in kind.__required_keys__ - value.keys():
        raise InputError(f"{where}: has no {name}")
    for name in value.keys() - kinds.keys():
        raise InputError(f"{_inside(where, name)}: unknown key; allowed are {', '.join(kinds)}")
    return {
        name: _check_value(kinds[name], kind_of_item, f"{where}.{name}")
        for name, kind_of_item in value.items()
    }


def _inside(where: str, name: str) -> str:
    _check_text(name, where)
    return f"{where}.{name}" if name.isidentifier() else f"{where}[{short_text(name)}]"


def _check_text(text: str, where: str) -> None:
    """Refuse half characters, which no file, picture or terminal takes."""
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{where} = {short_text(text)}: allowed is a text in UTF-8") from None
