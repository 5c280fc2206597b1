"""TOML: read from a file, or say in one line why it cannot be; and values as it has them."""

import json
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.input_file import read_text

__all__ = ["parse_toml", "read_toml", "toml_text"]

MOST_LEVELS = 100
"""Most tables and lists within each other."""

DECIMAL_COMMA = re.compile(r"^\s*[\w.]+\s*=\s*[-+]?\d+,\d+", re.MULTILINE)


def read_toml(path: Path) -> dict[str, Any]:
    """Return the content of a TOML file.

    Raises:
        InputError: the file cannot be read or parsed, or is a result's.
    """
    if path.suffix == ".nc":
        raise InputError(
            f"{path}: is a stored result, which `exu-press report {path}` shows; allowed is a TOML "
            "file"
        )
    return parse_toml(read_text(path), str(path))


def parse_toml(text: str, where: str) -> dict[str, Any]:
    """Return the content of a text in TOML.

    Raises:
        InputError: the text is no TOML, nests too deep, or has a number of too many digits.
    """
    too_deep = InputError(f"{where}: nests too deep; allowed are {MOST_LEVELS} levels")
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise too_deep from None
    except tomllib.TOMLDecodeError as error:
        comma = DECIMAL_COMMA.search(text)
        cure = f"; {comma[0]!r} has a decimal comma, TOML a point" if comma else ""
        raise InputError(f"{where}: not a TOML file ({error}{cure})") from None
    except ValueError:  # Python's own limit on whole numbers
        raise InputError(f"{where}: a number has too many digits; allowed are 4300") from None
    if _deeper(data, MOST_LEVELS):
        raise too_deep
    return data


def _deeper(value: Any, levels: int) -> bool:
    """Return whether tables and lists lie within each other on more levels."""
    layer = [value]
    for _ in range(levels):
        tables = (table.values() if isinstance(table, Mapping) else table for table in layer)
        layer = [inner for table in tables for inner in table if isinstance(inner, Mapping | list)]
        if not layer:
            return False
    return True


def toml_text(value: Any) -> str:
    """Return a value in TOML: JSON's texts and switches are TOML's, and so is Python's float."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key} = {toml_text(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    if type(value) is float and float(short := f"{value:g}") == value:
        return short if set(short) & set(".e") else f"{short}.0"
    return repr(value) if type(value) in (float, int) else json.dumps(value, ensure_ascii=False)
