"""TOML: read from a file, or say in one line why it cannot be; and values as it has them."""

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.errors import InputError

__all__ = ["read_toml", "toml_text"]


def read_toml(path: Path) -> dict[str, Any]:
    """Return what a TOML file holds.

    Raises:
        InputError: the file cannot be read or parsed.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a TOML file ({error})") from None


def toml_text(value: Any) -> str:
    """Return a value in TOML: JSON's texts and switches are TOML's, and so is Python's float."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key} = {toml_text(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    if type(value) is float and float(short := f"{value:g}") == value:
        return short if set(short) & set(".e") else f"{short}.0"
    return repr(value) if type(value) in (float, int) else json.dumps(value, ensure_ascii=False)
