"""Every load of a scene by its name."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from exu_press.errors import InputError, MissingKeysError, Need, error_prefix
from exu_press.mechanism import Mechanism
from exu_press.scene.load import ATTACHMENT, COLUMNS, LOAD_KINDS, Load
from exu_press.scene.solver import RPM
from exu_press.schema.checks import demand_known, demand_name
from exu_press.schema.registry import choice
from exu_press.schema.table import Table, declared_keys, set_key, table_from

__all__ = ["changed_load", "loads_of", "with_files_beside"]


INSTEAD = {
    "file": (*COLUMNS, "force"),
    **{column: tuple({*COLUMNS} - {column}) for column in COLUMNS},
    "start_angle_deg": ("end_angle_deg",),
    "end_angle_deg": ("start_angle_deg",),
}
"""Key of a load -> the keys instead of which it stands."""


def loads_of(
    tables: Any, mechanism: Mechanism, flexible: Collection[str], speed_rpm: float
) -> dict[str, Load]:
    """Return the loads of a scene, by name, in the order in which it gives them.

    On the flexible bodies, by their names, a load needs a joint or a face.

    Raises:
        InputError: a load has no kind, a key that its kind does not have, a value that is not
            allowed, a body or a joint that there is not, a place on a flexible body where nothing
            carries it, or a file that is no table.
    """
    if not isinstance(tables or {}, Mapping):
        raise InputError(f"load = {tables!r}: allowed is a table of loads")
    loads, needs = {}, list[Need]()
    for name, value in (tables or {}).items():
        where = f"load.{name}"
        demand_name("load", name)
        try:
            loads[name] = load = _load(where, value)
            load.check_code(where, speed_rpm * RPM)
        except MissingKeysError as error:
            needs += [(where, text) for _, text in error.needs]
            continue
        except InputError as error:
            text = str(error)
            raise InputError(text if text.startswith(where) else f"{where}.{text}") from None
        _check_body(where, load, mechanism, flexible)
        with error_prefix(f"{where}."):
            load.check(mechanism, 60.0 / speed_rpm)
    if needs:
        raise MissingKeysError(needs)
    return loads


def changed_load(name: str, load: Any, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a load with others; one of another kind keeps where it acts."""
    keys = load.to_dict() if isinstance(load, Load) else dict(load or {})
    if "kind" in changes and keys.get("kind") != changes["kind"]:
        keys = {key: value for key, value in keys.items() if key in ATTACHMENT}
    for path, value in changes.items():
        for key in INSTEAD.get(path, ()):
            if key not in changes:
                keys.pop(key, None)
        with error_prefix(f"load.{name}."):
            set_key(keys, path, value)
    return keys


def with_files_beside(tables: Any, folder: Path) -> Any:
    """Return loads as a file in a folder gives them, the paths of their tables from there."""
    if not isinstance(tables, Mapping):
        return tables
    return {
        name: {**keys, "file": str(folder / keys["file"])}
        if isinstance(keys, Mapping) and isinstance(keys.get("file"), str)
        else keys
        for name, keys in tables.items()
    }


@dataclass(frozen=True)
class OneLoad(Table):
    """The table of a load, whose kind decides which keys it has."""

    kind: Load = choice(None, "kind of load", LOAD_KINDS)


def _load(where: str, table: Any) -> Load:
    if isinstance(table, Load):
        return table
    if not isinstance(table, Mapping):
        raise InputError(f"{where} = {table!r}: allowed is a table of keys")
    keys = dict(table)
    name = keys.pop("kind", None)
    kind = LOAD_KINDS.choose(f"{where}.kind", name, keys)
    if "file" in keys:
        path = keys.pop("file")
        if not isinstance(path, str):
            raise InputError(f"file = {path!r}: allowed is the path of a CSV file")
        both = [column for column in ("force", *COLUMNS) if column in keys]
        if both:
            raise InputError(f"file and {both[0]}: allowed is one of the two")
        with error_prefix("file: "):
            keys |= kind.read_file(Path(path))
    own = ["kind", *declared_keys(kind)]
    for key, value in keys.items():
        if key in own or any(key in declared_keys(known) for known in LOAD_KINDS.values()):
            continue
        demand_known(f"{where}.{key} = {value!r:.200}: unknown key of kind {name!r}", key, own)
    return table_from(OneLoad, where, {"kind": name, **keys}).kind


def _check_body(where: str, load: Load, mechanism: Mechanism, flexible: Collection[str]) -> None:
    bodies = [body.name for body in mechanism.bodies]
    name = load.body or mechanism.slider
    demand_known(f"{where}.body = {name!r}: {mechanism.name} has no such body", name, bodies)
    joints = [joint.name for joint in mechanism.joints_of(name)]
    if (joint := load.joint) is not None:
        demand_known(f"{where}.joint = {joint!r}: {name} has no such joint", joint, joints)
    if name in flexible and load.joint is None and load.face is None:
        raise InputError(
            f"{where}: acts on the flexible {name}, which a force at a point would dent without "
            f"end; allowed are joint, one of {', '.join(joints)}, or face, of those that carry it"
        )
    if name not in flexible and load.face is not None:
        raise InputError(
            f"{where}.face: {name} is rigid; allowed are joint and offset, or [bodies.{name}]"
        )
