"""A scene as a TOML file that `Scene.load` reads back equal."""

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import replacing
from exu_press.mechanism import Mechanism, mechanism_lines
from exu_press.scene.bodies import Flexible, body_dict
from exu_press.scene.joints import Joints
from exu_press.scene.load import LOAD_KINDS, Load
from exu_press.scene.loads import load_dict
from exu_press.scene.usage import table_keys
from exu_press.schema.table import Table, declared_keys, key_values, plain_value
from exu_press.schema.toml import toml_text

Laws = Mapping[str, Mapping[str, Any] | None]
"""The scene's own "contact", "friction" and "film"."""

__all__ = [
    "body_lines",
    "joint_lines",
    "law_lines",
    "load_lines",
    "save_scene",
    "section_lines",
    "table_lines",
]


def save_scene(
    scene: Table, laws: Laws, path: str | Path, *, comments: bool = False, overwrite: bool = False
) -> None:
    """Write a complete scene: every key that it uses, defaults filled in.

    Args:
        scene: complete.
        laws: of joints that have none of their own.
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
    lines, drawn = table_lines(scene, comments), []
    for field in dataclasses.fields(scene):
        table = getattr(scene, field.name)
        if isinstance(table, Joints):
            lines += joint_lines(table, laws, comments)
        elif field.name == "load":
            for name, load in table.items():
                lines += ["", f"[load.{name}]", *load_lines(load, comments)]
        elif field.name == "bodies":
            for name, body in table.items():
                if body.from_file:  # a scene file has it relative to itself
                    file = "flexible" if body.matrices is None else "matrices"
                    beside = os.path.relpath(body.path, path.parent)
                    body = dataclasses.replace(body, **{file: beside})
                lines += ["", f"[bodies.{name}]", *body_lines(body, comments)]
        elif field.name in laws and table is not None:
            lines += law_lines(field.name, table, comments)
        elif isinstance(table, Table):
            lines += section_lines(field.name, table, comments)
        elif isinstance(table, Mechanism):
            drawn = ["", *mechanism_lines(table, "mechanism.")]
    with replacing(path) as partial:
        partial.write_text("\n".join([*lines, *drawn, ""]), encoding="utf-8")


def section_lines(name: str, table: Table, comments: bool, *, absent: bool = False) -> list[str]:
    """Return one table with its header, and the tables within it behind it.

    Args:
        name: dotted.
        table: of a scene.
        comments: write meaning and unit behind every key.
        absent: name the keys that are not used or given, too, as comments.
    """
    lines = ["", f"[{name}]", *table_lines(table, comments, absent=absent)]
    for key, inside, field in key_values(table):
        if isinstance(inside, Table):
            lines += section_lines(f"{name}.{key}", inside, comments, absent=absent)
        elif "by_name" in field.metadata:
            from exu_press.scene.guides import fields_of  # loaded by these tables

            meanings = {name: _meaning(declared) for name, declared in fields_of().items()}
            lines += ["", f"[{name}.{key}]", *_given_lines(inside, meanings, comments, False)]
    return lines


def table_lines(table: Table, comments: bool, *, absent: bool = False) -> list[str]:
    """Return the keys of one table.

    Args:
        table: of a scene, or the scene.
        comments: write meaning and unit behind every key.
        absent: name the keys that the scene does not use or give, too, as comments.
    """
    meanings = _meanings(table, absent=absent)
    values = {name: value for name, value, _ in key_values(table) if value is not None}
    drawn = {name for name, value in values.items() if isinstance(value, Mechanism)}
    meanings = {name: text for name, text in meanings.items() if name not in drawn}
    return _given_lines(values, meanings, comments, absent)


def law_lines(
    name: str, keys: Mapping[str, Any], comments: bool, *, absent: bool = False
) -> list[str]:
    """Return [contact], [friction] or [film]; arguments as those of `section_lines`."""
    fields = {key: field for key, field in table_keys(name).items() if "meaning" in field.metadata}
    meanings = {key: _meaning(field) for key, field in fields.items()}
    meanings |= {key: "" for key in keys if key not in meanings}
    values = {key: value for key, value in keys.items() if not isinstance(value, Table)}
    meanings = {key: text for key, text in meanings.items() if key in values or key in fields}
    lines = ["", f"[{name}]", *_given_lines(values, meanings, comments, absent)]
    for key, value in keys.items():
        if isinstance(value, Table):
            lines += section_lines(f"{name}.{key}", value, comments, absent=absent)
    return lines


def body_lines(body: Flexible, comments: bool, *, absent: bool = False) -> list[str]:
    """Return the keys of a flexible body; arguments as those of `table_lines`."""
    faces = "joint = face's name, or {radius, z} of its cylinder; guide = {x, y, z}"
    return _given_lines(body_dict(body), {**_meanings(body), "faces": faces}, comments, absent)


def load_lines(load: Load, comments: bool, *, absent: bool = False) -> list[str]:
    """Return the keys of a load; arguments as those of `table_lines`."""
    keys = load_dict(load)
    meanings = {**dict.fromkeys(keys, ""), "kind": " | ".join(LOAD_KINDS), **_meanings(load)}
    return _given_lines(keys, meanings, comments, absent)


def joint_lines(joints: Joints, laws: Laws, comments: bool) -> list[str]:
    """Return the joints with clearance, group by group; without any, all joints are ideal."""
    lines = [] if joints.by_group else ["", "[joints]"]
    for name, joint in joints.by_group.items():
        meanings = _meanings(joint)
        meanings["kind"] = "ideal | dry | lubricated; a joint that is not named is ideal"
        meanings["worn"] = "depths worn off the surfaces, m, by angle from the body's x axis"
        keys = {
            f"{key} = {toml_text(value)}": meanings.get(key, f"where it differs from [{key}]")
            for key, value in joint.to_dict(laws).items()
        }
        lines += ["", f"[joints.{name}]", *_lines(keys, comments)]
    return lines


def _given_lines(
    values: Mapping[str, Any], meanings: Mapping[str, str], comments: bool, absent: bool
) -> list[str]:
    """Return the keys that are given, in the order of their meanings, or all of them."""
    keys = {
        f"{name} = {toml_text(plain_value(values[name]))}"
        if name in values
        else f"# {name} =": meaning
        for name, meaning in meanings.items()
        if absent or name in values
    }
    return _lines(keys, comments)


def _lines(keys: Mapping[str, str], comments: bool) -> list[str]:
    """Return lines, with their meanings behind them where comments are wanted."""
    width = max(map(len, keys), default=0)
    return [f"{key:{width}}  # {meaning}" if comments else key for key, meaning in keys.items()]


def _meanings(table: Table, *, absent: bool = False) -> dict[str, str]:
    """Return the meaning, unit and choices of every key that a table uses, or may use."""
    fields = {name: field for name, _, field in key_values(table)}
    fields = dict(declared_keys(type(table))) | fields if absent else fields
    return {n: _meaning(field) for n, field in fields.items() if "meaning" in field.metadata}


def _meaning(field: dataclasses.Field[Any]) -> str:
    meta = field.metadata
    meaning = ", ".join(filter(None, [meta["meaning"], meta["unit"]]))
    return ": ".join(filter(None, [meaning, " | ".join(meta["choices"])]))
