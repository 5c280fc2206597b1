"""A mechanism file: one assembled drawing in TOML, read into a `Mechanism`, and back.

name = "slider-crank"
crank = "crank"
output = {body = "slider", direction = [0, 1]}
[bodies.crank]
centre_of_mass = [0.0, 0.0]
mass = 20.0
inertia = 0.05
[joints.shaft]
at = [0.0, 0.0]
journal = "crank"
bearing = "frame"
[guides.slider]
direction = [0, 1]
[groups]
pins = ["crank_pin", "wrist_pin"]
"""

import json
import math
from collections.abc import Collection, Mapping
from dataclasses import fields
from functools import lru_cache
from pathlib import Path
from typing import Any

from exu_press.checks import nearest
from exu_press.errors import InputError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import ROD, Body, Guide, Joint, Output, Point
from exu_press.read_toml import read_toml

__all__ = [
    "SHIPPED",
    "load_mechanism",
    "mechanism_from",
    "mechanism_lines",
    "mechanism_to_dict",
    "shipped_mechanism",
]

FILES = Path(__file__).with_name("files")

SHIPPED = tuple(sorted(path.stem for path in FILES.glob("*.toml")))
"""Names of the mechanisms that the package has as files."""


def load_mechanism(path: str | Path) -> Mechanism:
    """Return the mechanism of a file.

    Raises:
        InputError: the file cannot be read or parsed, or no mechanism can be made of it.
    """
    path = Path(path)
    data = read_toml(path)
    try:
        return mechanism_from(data)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


@lru_cache
def shipped_mechanism(name: str) -> Mechanism:
    """Return a mechanism that the package has as a file, by its name, one of `SHIPPED`."""
    return load_mechanism(FILES / f"{name}.toml")


def mechanism_from(data: Mapping[str, Any]) -> Mechanism:
    """Return the mechanism of a nested mapping, as a mechanism file holds it.

    Raises:
        InputError: a key is unknown or missing or has a wrong type, or the data make no mechanism.
    """
    _known("", data, ("name", "crank", "output", "bodies", "joints", "guides", "groups"))
    _needed("", data, ("name", "crank", "output", "bodies", "joints"))
    output = _table("output", data["output"])
    _known("output", output, ("body", "direction", "origin"))
    _needed("output", output, ("body",))
    return Mechanism(
        name=_text("name", data["name"]),
        bodies=tuple(_body(name, table) for name, table in _tables(data, "bodies")),
        joints=tuple(_joint(name, table) for name, table in _tables(data, "joints")),
        guides=tuple(_guide(name, table) for name, table in _tables(data, "guides")),
        crank=_text("crank", data["crank"]),
        output=Output(
            body=_text("output.body", output["body"]),
            **{name: _point(f"output.{name}", output[name]) for name in output if name != "body"},
        ),
        groups={
            name: _names(f"groups.{name}", members)
            for name, members in _table("groups", data.get("groups", {})).items()
        },
    )


def mechanism_to_dict(mechanism: Mechanism) -> dict[str, Any]:
    """Return a mechanism with ideal guides as a nested mapping, for `mechanism_from`."""
    return {
        "name": mechanism.name,
        "crank": mechanism.crank,
        "output": {
            field.name: _plain(getattr(mechanism.output, field.name)) for field in fields(Output)
        },
        "bodies": {
            body.name: {
                "centre_of_mass": [*body.centre_of_mass],
                "mass": body.mass,
                "inertia": body.inertia,
                "angle": body.angle,
            }
            for body in mechanism.bodies
        },
        "joints": {
            joint.name: {
                "at": [*joint.at],
                "journal": joint.journal,
                "bearing": joint.bearing,
                "shape": joint.shape,
            }
            for joint in mechanism.joints
        },
        "guides": {guide.body: {"direction": [*guide.direction]} for guide in mechanism.guides},
        "groups": {name: [*members] for name, members in mechanism.groups.items()},
    }


def mechanism_lines(mechanism: Mechanism, prefix: str = "") -> list[str]:
    """Return a mechanism with ideal guides as the lines of a TOML file.

    Args:
        mechanism: drawn.
        prefix: what the tables' names begin with, such as "mechanism." in a scene file.
    """
    data = mechanism_to_dict(mechanism)
    lines = [f"{key} = {_toml(data[key])}" for key in ("name", "crank", "output")]
    if prefix:
        lines = [f"[{prefix.removesuffix('.')}]", *lines]
    for kind in ("bodies", "joints", "guides"):
        for name, table in data[kind].items():
            lines += ["", f"[{prefix}{kind}.{name}]"]
            lines += [f"{key} = {_toml(value)}" for key, value in table.items()]
    lines += ["", f"[{prefix}groups]"] if data["groups"] else []
    return lines + [f"{name} = {_toml(members)}" for name, members in data["groups"].items()]


def _toml(value: Any) -> str:
    """Return a value in TOML: JSON's texts and lists are TOML's, and so is Python's float."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key} = {_toml(inner)}" for key, inner in value.items()) + "}"
    return json.dumps(value, ensure_ascii=False)


def _body(name: str, table: Mapping[str, Any]) -> Body:
    where = f"bodies.{name}"
    _known(where, table, ("centre_of_mass", "mass", "inertia", "angle"))
    _needed(where, table, ("centre_of_mass", "mass"))
    return Body(
        name,
        mass=_number(f"{where}.mass", table["mass"]),
        inertia=_number(f"{where}.inertia", table["inertia"]) if "inertia" in table else ROD,
        centre_of_mass=_point(f"{where}.centre_of_mass", table["centre_of_mass"]),
        angle=_number(f"{where}.angle", table.get("angle", 0.0)),
    )


def _joint(name: str, table: Mapping[str, Any]) -> Joint:
    where = f"joints.{name}"
    _known(where, table, ("at", "journal", "bearing", "shape"))
    _needed(where, table, ("at", "journal", "bearing"))
    return Joint(
        name,
        at=_point(f"{where}.at", table["at"]),
        journal=_text(f"{where}.journal", table["journal"]),
        bearing=_text(f"{where}.bearing", table["bearing"]),
        shape=_text(f"{where}.shape", table.get("shape", "revolute")),
    )


def _guide(name: str, table: Mapping[str, Any]) -> Guide:
    where = f"guides.{name}"
    _known(where, table, ("direction",))
    _needed(where, table, ("direction",))
    return Guide(name, _point(f"{where}.direction", table["direction"]))


def _tables(data: Mapping[str, Any], name: str) -> list[tuple[str, Mapping[str, Any]]]:
    tables = _table(name, data.get(name, {}))
    return [(key, _table(f"{name}.{key}", table)) for key, table in tables.items()]


def _table(where: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise InputError(f"{where} = {value!r}: allowed is a table of keys")
    return value


def _known(where: str, table: Mapping[str, Any], known: Collection[str]) -> None:
    for key in table:
        if key not in known:
            path = f"{where}.{key}" if where else key
            raise InputError(
                f"{path} = {table[key]!r}: unknown key{nearest(key, known)}; allowed are "
                f"{', '.join(known)}"
            )


def _needed(where: str, table: Mapping[str, Any], needed: Collection[str]) -> None:
    for key in needed:
        if key not in table:
            raise InputError(f"{f'{where}.{key}' if where else key}: missing")


def _number(where: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise InputError(f"{where} = {value!r}: allowed is a number")
    return float(value)


def _text(where: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise InputError(f"{where} = {value!r}: allowed is a text")
    return value


def _point(where: str, value: Any) -> Point:
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise InputError(f"{where} = {value!r}: allowed are two numbers, [x, y]")
    return _number(where, value[0]), _number(where, value[1])


def _names(where: str, value: Any) -> tuple[str, ...]:
    if not isinstance(value, list | tuple):
        raise InputError(f"{where} = {value!r}: allowed is a list of joints' names")
    return tuple(_text(where, name) for name in value)


def _plain(value: Any) -> Any:
    return [*value] if isinstance(value, tuple) else value
