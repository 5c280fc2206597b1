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
[gears.pair]
body = "second_crank"
ratio = -1
[springs.counterbalance]
between = ["slider", "frame"]
at = [[0.0, -0.3], [0.0, 0.2]]
stiffness = 2e4
preload = -3e3
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

from exu_press.errors import (
    InputError,
    MissingKeysError,
    Need,
    collected_needs,
    error_prefix,
)
from exu_press.files.digests import note_digests, recorded_files
from exu_press.mechanism.gears import Gear
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Body, Guide, Joint, Output
from exu_press.mechanism.springs import GasSpring, LinearSpring
from exu_press.schema.checks import as_float, nearest, refuse_unknown
from exu_press.schema.table import plain_value
from exu_press.schema.toml import read_toml, toml_text

__all__ = [
    "SHIPPED",
    "change_mechanism",
    "load_mechanism",
    "mechanism_from_dict",
    "mechanism_lines",
    "mechanism_to_dict",
    "shipped_mechanism",
    "unit_in_mechanism",
]

FILES = Path(__file__).with_name("files")

SHIPPED = tuple(sorted(path.stem for path in FILES.glob("*.toml")))
"""Names of the mechanisms that the package has as files."""

SECTIONS: dict[str, tuple[type, tuple[str, ...], tuple[str, ...]]] = {
    "bodies": (Body, ("centre_of_mass", "mass"), ("inertia", "angle")),
    "joints": (Joint, ("at", "journal", "bearing"), ("shape",)),
    "guides": (Guide, ("direction",), ("body", "on")),
    "slots": (Guide, ("body", "on", "at"), ("direction", "centre", "length", "middle")),
    "gears": (Gear, ("body", "ratio"), ("to",)),
    "springs": (
        LinearSpring,
        ("between", "at", "stiffness"),
        ("damping", "free_length", "preload"),
    ),
}
"""Section of the file -> class of its tables, their required keys, their optional keys."""

IN_FILE = {"slots": {"body": "pin", "on": "slot"}}
"""Section -> names in the file of some keys."""

GAS = (
    GasSpring,
    ("between", "at", "area", "pressure", "volume", "exponent"),
    ("ambient", "damping"),
)
"""Class and keys of a spring with an area."""

UNITS = {
    "mass": "kg",
    "inertia": "kg m^2",
    "angle": "rad",
    **dict.fromkeys(("at", "centre_of_mass", "free_length"), "m"),
    "stiffness": "N/m",
    "damping": "N s/m",
    "preload": "N",
    "area": "m^2",
    "volume": "m^3",
    **dict.fromkeys(("pressure", "ambient"), "Pa"),
}
COORDINATES = "x", "y"

OUTPUT = ("body",), ("direction", "origin", "rotation")
TOP = (
    ("name", "crank", "output", "bodies", "joints"),
    ("guides", "slots", "gears", "springs", "groups", "counterweight", "defaults"),
)
"""Required and optional keys of the output's table, and of the whole file."""


def load_mechanism(path: str | Path) -> Mechanism:
    """Return the mechanism of a file.

    Raises:
        InputError: the file cannot be read or parsed, or its data have a fault.
    """
    path = Path(path)
    data = read_toml(path)
    with error_prefix(f"{path}: "):
        return mechanism_from_dict(data)


def shipped_mechanism(name: str) -> Mechanism:
    """Return a shipped mechanism by its name, one of `SHIPPED`."""
    mechanism, digests = _load_shipped(name)
    note_digests(digests)
    return mechanism


@lru_cache
def _load_shipped(name: str) -> tuple[Mechanism, dict[str, str]]:
    """Return a shipped mechanism, and the digests of the files that it is read from."""
    with recorded_files() as digests:
        return load_mechanism(FILES / f"{name}.toml"), dict(digests)


def mechanism_from_dict(data: Mapping[str, Any]) -> Mechanism:
    """Return the mechanism of a nested mapping with the keys of a mechanism file.

    Raises:
        InputError: a key is unknown or missing or has a wrong type, or the data have a fault.
    """
    if "mechanism" in data:
        raise InputError(
            f"mechanism = {data['mechanism']!r:.200}: is a key of a scene; allowed is a mechanism, "
            f"with {', '.join(TOP[0])}"
        )
    needs, top, elements = list[Need](), dict(_table("", data)), dict[str, Any]()
    with collected_needs(needs):
        _checked_keys("", top, *TOP)
    for section in SECTIONS:
        elements[section] = ()
        for name, table in _table(section, top.pop(section, {})).items():
            with collected_needs(needs):
                elements[section] += (_element(section, name, table),)
    elements["guides"] += elements.pop("slots")
    with collected_needs(needs):
        output = Output(**_checked_keys("output", top.pop("output", {}), *OUTPUT))
    if needs:
        raise MissingKeysError(needs)
    groups = _table("groups", top.pop("groups", {}))
    groups = {name: _value(members) for name, members in groups.items()}
    return Mechanism(**top, **elements, output=output, groups=groups)


def _element(section: str, name: str, table: Any) -> Any:
    """Return a body, joint, guide, slot, gear or spring of its table."""
    is_gas = section == "springs" and isinstance(table, Mapping) and "area" in table
    element, *keys = GAS if is_gas else SECTIONS[section]
    in_file = IN_FILE.get(section, {})
    values = _checked_keys(
        f"{section}.{name}", table, *(tuple(in_file.get(key, key) for key in k) for k in keys)
    )
    if section == "slots" and ("direction" in values) == ("centre" in values):
        raise InputError(
            f"slots.{name}: allowed is a direction, of a straight slot, or a centre, of a circular "
            "one"
        )
    names = {there: key for key, there in in_file.items()}
    return element(name, **{names.get(key, key): value for key, value in values.items()})


def mechanism_to_dict(mechanism: Mechanism) -> dict[str, Any]:
    """Return a mechanism with ideal guides as a nested mapping, for `mechanism_from_dict`.

    Uniform rods have no inertia there: it follows from mass and length, and changes with them.
    """
    data: dict[str, Any] = {"name": mechanism.name, "crank": mechanism.crank}
    if mechanism.counterweight:
        data["counterweight"] = [*mechanism.counterweight]
    data["output"] = _plain(mechanism.output, *OUTPUT)
    for section, (element, *keys) in SECTIONS.items():
        name = fields(element)[0].name
        in_file = IN_FILE.get(section, {})
        items = getattr(mechanism, "guides" if section == "slots" else section)
        if element is Guide:
            items = [guide for guide in items if guide.is_slot == (section == "slots")]
        data[section] = {
            getattr(item, name): {
                in_file.get(key, key): value
                for key, value in _plain(
                    item, *(GAS[1:] if isinstance(item, GasSpring) else keys)
                ).items()
                if key != "direction" or getattr(item, "centre", None) is None
            }
            for item in items
        }
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


def change_mechanism(data: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return a mechanism's nested mapping with some values changed.

    Args:
        data: as of `mechanism_to_dict`, or of a file.
        changes: dotted name, as in "bodies.rod.mass", "joints.pin.at" or "joints.pin.at.x" -> its
            value; None removes it.

    Raises:
        InputError: there is no such table.
    """
    changed = copy.deepcopy(dict(data))
    for name, value in changes.items():
        *tables, key = name.split(".")
        inner: Any = changed
        for depth, table in enumerate(tables, 1):
            outer, inner = inner, inner.get(table)
            is_point = depth == len(tables) and isinstance(inner, list) and len(inner) == 2
            if not (isinstance(inner, dict) or (is_point and key in COORDINATES)):
                known = [name for name, item in outer.items() if isinstance(item, dict)]
                path = ".".join(tables[:depth])
                raise InputError(f"{name} = {value!r}: no table {path}{nearest(table, known)}")
        if isinstance(inner, list):
            inner[COORDINATES.index(key)] = value
        elif value is None:
            inner.pop(key, None)
        else:
            inner[key] = value
    return changed


def unit_in_mechanism(name: str) -> str:
    """Return the SI unit of a mechanism's key by its dotted name, or nothing.

    >>> unit_in_mechanism("bodies.rod.mass"), unit_in_mechanism("joints.pin.at.x")
    ('kg', 'm')
    """
    *tables, key = name.split(".")
    return UNITS.get(tables[-1] if key in COORDINATES else key, "")


def mechanism_lines(mechanism: Mechanism, prefix: str = "") -> list[str]:
    """Return a mechanism with ideal guides as the lines of a TOML file.

    Args:
        mechanism: drawn.
        prefix: of the tables' names, such as "mechanism." in a scene file.
    """
    data = mechanism_to_dict(mechanism)
    tables = {
        f"{section}.{name}": table
        for section in SECTIONS
        for name, table in data.pop(section).items()
    }
    groups, defaults = data.pop("groups"), data.pop("defaults", {})
    values = {key: value for key, value in defaults.items() if not isinstance(value, Mapping)}
    tables |= {"groups": groups, "defaults": values}
    tables |= {f"defaults.{key}": value for key, value in defaults.items() if key not in values}
    lines = [f"[{prefix.removesuffix('.')}]"] if prefix else []
    lines += [f"{key} = {toml_text(value)}" for key, value in data.items()]
    for name, table in tables.items():
        lines += ["", f"[{prefix}{name}]"] if table else []
        lines += [f"{key} = {toml_text(value)}" for key, value in table.items()]
    return lines


def _checked_keys(
    where: str, data: Any, required: Collection[str], optional: Collection[str]
) -> dict[str, Any]:
    """Return the keys and values of a table; `Mechanism` checks the values."""
    table = _table(where, data)
    refuse_unknown(where, table, (*required, *optional))
    for key, value in table.items():
        if isinstance(value, float) and math.isnan(value):  # `ROD`: in a file, omit the key
            raise InputError(f"{where}.{key} = {value!r}: allowed is a number")
    if missing := ", ".join(key for key in required if key not in table):
        raise MissingKeysError([(where, missing)])
    return {key: _value(value) if where else value for key, value in table.items()}


def _table(where: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise InputError(f"{where} = {value!r}: allowed is a table of keys")
    return value


def _value(value: Any) -> Any:
    """Return lists as tuples, and whole numbers as floats."""
    if isinstance(value, list | tuple):
        return tuple(map(_value, value))
    return as_float(value) if type(value) is int else value


def _plain(item: Any, required: tuple[str, ...], optional: tuple[str, ...]) -> dict[str, Any]:
    """Return the keys of an element or output that a file needs, points as lists."""
    implied = {"body": getattr(item, "name", None), "on": GROUND}
    values = {key: getattr(item, key) for key in required + optional}
    return {
        key: plain_value(value)
        for key, value in values.items()
        if key in required
        or (value is not None and value is not False and value != implied.get(key))
    }
