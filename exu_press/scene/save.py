"""A scene as a TOML file that `load_scene` reads back equal."""

import dataclasses
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.output import replacing
from exu_press.scene.checks import Table

__all__ = ["save_scene"]


def save_scene(
    scene: Table, path: str | Path, *, comments: bool = False, overwrite: bool = False
) -> None:
    """Write a complete scene: every key that it uses, defaults filled in.

    Args:
        scene: a `Scene`.
        path: of the file.
        comments: write meaning and unit behind every key.
        overwrite: replace an existing file, whose own comments would be lost.

    Raises:
        InputError: the file exists, or cannot be written.
    """
    path = Path(path)
    if path.exists() and not overwrite:
        raise InputError(
            f"{path}: exists, and its comments would be lost; allowed is another name, or "
            "overwrite=True"
        )
    lines = _lines(scene, comments)
    for field in dataclasses.fields(scene):
        table = getattr(scene, field.name)
        if isinstance(table, Table):
            lines += ["", f"[{field.name}]", *_lines(table, comments)]
    with replacing(path) as partial:
        partial.write_text("\n".join([*lines, ""]), encoding="utf-8")


def _lines(table: Table, comments: bool) -> list[str]:
    """Return the keys of one table; None is what the scene does not use."""
    values = {field: getattr(table, field.name) for field in dataclasses.fields(table)}
    keys = {
        f"{field.name} = {_text(value)}": field.metadata
        for field, value in values.items()
        if value is not None and "meaning" in field.metadata
    }
    if not comments:
        return list(keys)
    width = max(map(len, keys), default=0)
    return [f"{key:{width}}  # {_meaning(metadata)}" for key, metadata in keys.items()]


def _text(value: Any) -> str:
    """Return a value in TOML: JSON's texts and switches are TOML's, and so is Python's float."""
    return repr(value) if type(value) in (float, int) else json.dumps(value, ensure_ascii=False)


def _meaning(metadata: Mapping[str, Any]) -> str:
    """Return what a key means, its unit and what it may be."""
    meaning = ", ".join(filter(None, [metadata["meaning"], metadata["unit"]]))
    return ": ".join(filter(None, [meaning, " | ".join(metadata["choices"])]))
