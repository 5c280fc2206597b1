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
from exu_press.scene.joint import joint_dict
from exu_press.scene.joints import Joints
from exu_press.scene.load import LOAD_KINDS, Load
from exu_press.scene.loads import load_dict
from exu_press.schema.checks import Table
from exu_press.schema.toml import toml_text

Laws = Mapping[str, Table | None]
"""The scene's own "contact", "friction" and "film"."""

__all__ = ["body_lines", "joint_lines", "load_lines", "save_scene", "section_lines", "table_lines"]


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
                    beside = os.path.relpath(body.flexible, path.parent)
                    body = dataclasses.replace(body, flexible=beside)
                lines += ["", f"[bodies.{name}]", *body_lines(body, comments)]
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
    for field in dataclasses.fields(table):
        if isinstance(inside := getattr(table, field.name), Table):
            lines += section_lines(f"{name}.{field.name}", inside, comments, absent=absent)
    return lines


def table_lines(table: Table, comments: bool, *, absent: bool = False) -> list[str]:
    """Return the keys of one table.

    Args:
        table: of a scene, or the scene.
        comments: write meaning and unit behind every key.
        absent: name the keys that the scene does not use or give, too, as comments.
    """
    values = {name: getattr(table, name) for name in _meanings(table)}
    given = {name: value for name, value in values.items() if value is not None}
    drawn = {name for name, value in given.items() if isinstance(value, Mechanism)}
    told = {name: words for name, words in _meanings(table).items() if name not in drawn}
    return _given_lines(given, told, comments, absent)


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
    lines = [] if joints.grouped else ["", "[joints]"]
    for name, joint in joints.grouped.items():
        meanings = _meanings(joint)
        meanings["kind"] = "ideal | dry | lubricated; a joint that is not named is ideal"
        meanings["worn"] = "depths worn off the surfaces, m, by angle from the body's x axis"
        keys = {
            f"{key} = {toml_text(value)}": meanings.get(key, f"where it differs from [{key}]")
            for key, value in joint_dict(joint, laws).items()
        }
        lines += ["", f"[joints.{name}]", *_lines(keys, comments)]
    return lines


def _given_lines(
    given: Mapping[str, Any], meanings: Mapping[str, str], comments: bool, absent: bool
) -> list[str]:
    """Return the keys that are given, in the order of their meanings, or all of them."""
    keys = {
        f"{name} = {toml_text(given[name])}" if name in given else f"# {name} =": meaning
        for name, meaning in meanings.items()
        if absent or name in given
    }
    return _lines(keys, comments)


def _lines(keys: Mapping[str, str], comments: bool) -> list[str]:
    """Return lines, with their meanings behind them where comments are wanted."""
    width = max(map(len, keys), default=0)
    return [f"{key:{width}}  # {meaning}" if comments else key for key, meaning in keys.items()]


def _meanings(table: Table) -> dict[str, str]:
    """Return the meaning, unit and choices of every key of a table."""
    found = {}
    for name, meta in ((f.name, f.metadata) for f in dataclasses.fields(table)):
        if "meaning" in meta:
            meaning = ", ".join(filter(None, [meta["meaning"], meta["unit"]]))
            found[name] = ": ".join(filter(None, [meaning, " | ".join(meta["choices"])]))
    return found
