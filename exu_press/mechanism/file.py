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
[defaults]
radius = 0.03
clearance = 5e-5
"""

import copy
import math
from collections.abc import Collection, Mapping
from dataclasses import fields
from functools import lru_cache
from pathlib import Path
from typing import Any

from exu_press.errors import InputError, prefixed
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import Body, Guide, Joint, Output
from exu_press.schema.checks import as_float, nearest, refuse_unknown
from exu_press.schema.toml import read_toml, toml_text

__all__ = [
    "SHIPPED",
    "load_mechanism",
    "mechanism_changed",
    "mechanism_from",
    "mechanism_lines",
    "mechanism_to_dict",
    "shipped_mechanism",
    "unit_in_mechanism",
]

FILES = Path(__file__).with_name("files")

SHIPPED = tuple(sorted(path.stem for path in FILES.glob("*.toml")))
"""Names of the mechanisms that the package has as files."""

PARTS: dict[str, tuple[type, tuple[str, ...], tuple[str, ...]]] = {
    "bodies": (Body, ("centre_of_mass", "mass"), ("inertia", "angle")),
    "joints": (Joint, ("at", "journal", "bearing"), ("shape",)),
    "guides": (Guide, ("direction",), ()),
}
"""Tables of tables -> what each is made of, the keys it needs, and those it may have."""

UNITS = {"mass": "kg", "inertia": "kg m^2", "angle": "rad", "at": "m", "centre_of_mass": "m"}
COORDINATES = "x", "y"

OUTPUT = ("body",), ("direction", "origin")
TOP = (
    ("name", "crank", "output", "bodies", "joints"),
    ("guides", "groups", "counterweight", "defaults"),
)
"""The same of the output's table and of the whole file."""


def load_mechanism(path: str | Path) -> Mechanism:
    """Return the mechanism of a file.

    Raises:
        InputError: the file cannot be read or parsed, or no mechanism can be made of it.
    """
    path = Path(path)
    data = read_toml(path)
    with prefixed(f"{path}: "):
        return mechanism_from(data)


@lru_cache
def shipped_mechanism(name: str) -> Mechanism:
    """Return a mechanism that the package has as a file, by its name, one of `SHIPPED`."""
    return load_mechanism(FILES / f"{name}.toml")


def mechanism_from(data: Mapping[str, Any]) -> Mechanism:
    """Return the mechanism of a nested mapping, as a mechanism file holds it.

    Raises:
        InputError: a key is unknown or missing or has a wrong type, or the data make no mechanism.
    """
    top = _keys("", data, *TOP)
    parts: dict[str, Any] = {
        kind: tuple(
            made(name, **_keys(f"{kind}.{name}", table, needed, others))
            for name, table in _table(kind, top.pop(kind, {})).items()
        )
        for kind, (made, needed, others) in PARTS.items()
    }
    output = Output(**_keys("output", top.pop("output"), *OUTPUT))
    groups = _table("groups", top.pop("groups", {}))
    groups = {name: _value(members) for name, members in groups.items()}
    return Mechanism(**top, **parts, output=output, groups=groups)


def mechanism_to_dict(mechanism: Mechanism) -> dict[str, Any]:
    """Return a mechanism with ideal guides as a nested mapping, for `mechanism_from`.

    Uniform rods have no inertia there: it follows from mass and length, and changes with them.
    """
    data: dict[str, Any] = {"name": mechanism.name, "crank": mechanism.crank}
    if mechanism.counterweight:
        data["counterweight"] = [*mechanism.counterweight]
    data["output"] = _plain(mechanism.output, *OUTPUT)
    for kind, (made, needed, others) in PARTS.items():
        name = fields(made)[0].name
        parts = getattr(mechanism, kind)
        data[kind] = {getattr(part, name): _plain(part, needed, others) for part in parts}
    for body in mechanism.bodies:
        if body.inertia == mechanism.rod_inertia(body):
            del data["bodies"][body.name]["inertia"]
    data["groups"] = {name: [*members] for name, members in mechanism.groups.items()}
    if mechanism.defaults:
        data["defaults"] = {
            key: dict(value) if isinstance(value, Mapping) else value
            for key, value in mechanism.defaults.items()
        }
    return data


def mechanism_changed(data: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return a mechanism's nested mapping with other values.

    Args:
        data: as of `mechanism_to_dict`, or of a file.
        changes: dotted name, as in "bodies.rod.mass", "joints.pin.at" or "joints.pin.at.x" -> its
            value; None leaves it out.

    Raises:
        InputError: a part has another name.
    """
    found = copy.deepcopy(dict(data))
    for name, value in changes.items():
        *tables, key = name.split(".")
        inner: Any = found
        for place, table in enumerate(tables):
            outer, inner = inner, inner.get(table)
            last = place == len(tables) - 1
            of_point = last and key in COORDINATES and isinstance(inner, list) and len(inner) == 2
            if not (of_point or isinstance(inner, dict)):
                why = nearest(table, [part for part, one in outer.items() if isinstance(one, dict)])
                raise InputError(
                    f"{name} = {value!r}: no table {'.'.join(tables[: place + 1])}{why}"
                )
        if isinstance(inner, list):
            inner[COORDINATES.index(key)] = value
        elif value is None:
            inner.pop(key, None)
        else:
            inner[key] = value
    return found


def unit_in_mechanism(name: str) -> str:
    """Return the SI unit of a mechanism's key by its dotted name, or nothing.

    >>> unit_in_mechanism("bodies.rod.mass"), unit_in_mechanism("joints.pin.at.x")
    ('kg', 'm')
    """
    parts = name.split(".")
    return UNITS.get(parts[-2] if parts[-1] in COORDINATES else parts[-1], "")


def mechanism_lines(mechanism: Mechanism, prefix: str = "") -> list[str]:
    """Return a mechanism with ideal guides as the lines of a TOML file.

    Args:
        mechanism: drawn.
        prefix: of the tables' names, such as "mechanism." in a scene file.
    """
    data = mechanism_to_dict(mechanism)
    tables = {kind: data.pop(kind) for kind in (*PARTS, "groups")}
    defaults = data.pop("defaults", {})
    lines = [f"[{prefix.removesuffix('.')}]"] if prefix else []
    lines += [f"{key} = {toml_text(value)}" for key, value in data.items()]
    for kind in PARTS:
        for name, table in tables[kind].items():
            lines += ["", f"[{prefix}{kind}.{name}]"]
            lines += [f"{key} = {toml_text(value)}" for key, value in table.items()]
    sizes = {key: value for key, value in defaults.items() if not isinstance(value, Mapping)}
    tables = {"groups": tables["groups"], "defaults": sizes}
    tables |= {f"defaults.{key}": value for key, value in defaults.items() if key not in sizes}
    for name, table in tables.items():
        lines += ["", f"[{prefix}{name}]"] if table else []
        lines += [f"{key} = {toml_text(value)}" for key, value in table.items()]
    return lines


def _keys(
    where: str, given: Any, needed: Collection[str], others: Collection[str]
) -> dict[str, Any]:
    """Return the keys of a table; the mechanism checks their values itself."""
    table, known = _table(where, given), (*needed, *others)
    refuse_unknown(where, table, known)
    for key, value in table.items():
        if isinstance(value, float) and math.isnan(value):  # `ROD`, which is left out here
            raise InputError(f"{where}.{key} = {value!r}: allowed is a number")
    for key in needed:
        if key not in table:
            raise InputError(f"{f'{where}.{key}' if where else key}: missing")
    return {key: _value(value) if where else value for key, value in table.items()}


def _table(where: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise InputError(f"{where} = {value!r}: allowed is a table of keys")
    return value


def _value(value: Any) -> Any:
    """Return lists as tuples, and whole numbers as the numbers that they stand for."""
    if isinstance(value, list | tuple):
        return tuple(map(_value, value))
    return as_float(value) if type(value) is int else value


def _plain(part: Any, needed: tuple[str, ...], others: tuple[str, ...]) -> dict[str, Any]:
    """Return the keys of a body, joint, guide or output, points as lists."""
    values = {key: getattr(part, key) for key in needed + others}
    return {key: [*v] if isinstance(v, tuple) else v for key, v in values.items()}
