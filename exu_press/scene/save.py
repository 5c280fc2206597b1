"""A scene as a TOML file that `Scene.load` reads back equal."""

import dataclasses
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import replacing
from exu_press.mechanism import Mechanism, mechanism_lines
from exu_press.scene.bodies import Flexible
from exu_press.scene.joints import Joints
from exu_press.scene.load import LOAD_KINDS, Load
from exu_press.scene.usage import LAWS, table_keys
from exu_press.schema.table import Table, declared_keys, key_values, plain_value
from exu_press.schema.toml import toml_text

__all__ = ["field_lines", "save_scene", "table_lines"]

Fields = Mapping[str, dataclasses.Field[Any]]


def save_scene(
    scene: Any, path: str | Path, *, comments: bool = False, overwrite: bool = False
) -> None:
    """Write a complete scene: every key that it uses, defaults filled in.

    Args:
        scene: complete.
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
    lines = table_lines(scene, comments)
    for field in dataclasses.fields(scene):
        lines += field_lines(scene, field.name, comments, folder=path.parent)
    if isinstance(scene.mechanism, Mechanism):
        lines += ["", *mechanism_lines(scene.mechanism, "mechanism.")]
    with replacing(path) as partial:
        partial.write_text("\n".join([*lines, ""]), encoding="utf-8")


def field_lines(
    scene: Any, name: str, comments: bool, *, absent: bool = False, folder: Path | None = None
) -> list[str]:
    """Return the tables of one field of a scene, none of one that has no table.

    Args:
        scene: complete.
        name: of the field.
        comments: write meaning and unit behind every key.
        absent: name the keys that are not used or given, too, as comments.
        folder: from which files of bodies have their paths.
    """
    value = getattr(scene, name)
    if isinstance(value, Joints):
        return _joint_lines(value, scene.laws, comments)
    if name in LAWS and value is not None:
        return _section_lines(name, value, table_keys(name), comments, absent)
    if isinstance(value, Table):
        return _table_section(name, value, comments, absent)
    lines = []
    for inner, table in value.items() if name in ("load", "bodies") else ():
        if isinstance(table, Flexible) and table.from_file and folder is not None:
            file = "flexible" if table.matrices is None else "matrices"
            beside: dict[str, Any] = {file: os.path.relpath(table.path, folder)}
            table = dataclasses.replace(table, **beside)
        lines += ["", f"[{name}.{inner}]", *table_lines(table, comments, absent=absent)]
    return lines


def _table_section(name: str, table: Table, comments: bool, absent: bool) -> list[str]:
    """Return one table with its header, and the tables within it behind it."""
    values = {key: value for key, value, _ in key_values(table)}
    return _section_lines(name, values, _fields(table, absent=absent), comments, absent)


def _section_lines(
    name: str, values: Mapping[str, Any], fields: Fields, comments: bool, absent: bool
) -> list[str]:
    """Return the same of keys with their declarations; a key of a user's law may have none."""
    by_name = [key for key, field in fields.items() if "by_name" in field.metadata]
    inside = [key for key, value in values.items() if isinstance(value, Table) or key in by_name]
    own = {k: v for k, v in values.items() if v is not None and k not in inside}
    meanings = _meanings(fields)
    meanings |= {key: "" for key in own if key not in meanings}
    lines = ["", f"[{name}]", *_given_lines(own, meanings, comments, absent)]
    for key in inside:
        if key in by_name:
            from exu_press.scene.guides import fields_of  # loaded by these tables

            meanings = _meanings(fields_of())
            lines += ["", f"[{name}.{key}]", *_given_lines(values[key], meanings, comments, False)]
        else:
            lines += _table_section(f"{name}.{key}", values[key], comments, absent)
    return lines


def table_lines(table: Table, comments: bool, *, absent: bool = False) -> list[str]:
    """Return the keys of one table, or of a scene, without tables within it.

    Args:
        table: of a scene, or the scene.
        comments: write meaning and unit behind every key.
        absent: name the keys that are not used or given, too, as comments.
    """
    values = {name: value for name, value, _ in key_values(table) if value is not None}
    meanings = _meanings(_fields(table, absent=absent))
    if isinstance(table, Flexible):
        values = table.to_dict()
        meanings["faces"] = "joint = face's name, or {radius, z} of its cylinder; guide = {x, y, z}"
    elif isinstance(table, Load):
        values = table.to_dict()
        meanings = {**dict.fromkeys(values, ""), "kind": " | ".join(LOAD_KINDS), **meanings}
    elif isinstance(values.get("mechanism"), Mechanism):
        del meanings["mechanism"]
    return _given_lines(values, meanings, comments, absent)


def _joint_lines(joints: Joints, laws: Mapping[str, Any], comments: bool) -> list[str]:
    """Return the joints with clearance, group by group; without any, all joints are ideal."""
    lines = [] if joints.by_group else ["", "[joints]"]
    for name, joint in joints.by_group.items():
        meanings = _meanings(_fields(joint))
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


def _fields(table: Table, *, absent: bool = False) -> Fields:
    """Return the declarations of the keys that a table uses, or may use."""
    fields = {name: field for name, _, field in key_values(table)}
    return {**declared_keys(type(table)), **fields} if absent else fields


def _meanings(fields: Fields) -> dict[str, str]:
    """Return the meaning, unit and choices of keys that have one."""
    meanings = {}
    for name, field in fields.items():
        if "meaning" in (meta := field.metadata):
            meaning = ", ".join(filter(None, [meta["meaning"], meta["unit"]]))
            meanings[name] = ": ".join(filter(None, [meaning, " | ".join(meta["choices"])]))
    return meanings
