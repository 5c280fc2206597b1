"""A scene as a nested mapping with other values, before it is checked."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from exu_press.errors import InputError, error_prefix
from exu_press.lazy import load_object
from exu_press.mechanism import (
    SHIPPED,
    Mechanism,
    change_mechanism,
    load_mechanism,
    mechanism_from_dict,
    mechanism_to_dict,
    shipped_mechanism,
)
from exu_press.scene.bodies import changed_body
from exu_press.scene.joint import JOINT_KINDS
from exu_press.scene.joints import joint_keys, keys_of_kind
from exu_press.scene.usage import TABLES
from exu_press.schema.checks import nearest
from exu_press.schema.table import RENAMED, changed_table, changed_tables, given_keys

__all__ = ["asked_mechanism", "by_group", "changed_keys", "drop", "gives_key"]

TABLES_OF_JOINTS = ("contact", "friction", "film", "worn")

DRAWN = "bodies", "joints", "guides", "output"
"""Tables of a mechanism that a scene changes; its defaults have become the scene's own keys."""


def changed_keys(
    scene: Mapping[str, Any], groups: Mapping[str, tuple[str, ...]], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a scene's keys with other values.

    Args:
        scene: as `Scene.to_dict` has it; its tables may be changed.
        groups: names for several joints at once -> these joints.
        changes: dotted name -> value; None leaves out what the scene has.

    Raises:
        InputError: a name is in no table of a scene.
    """
    for name in changes:
        if not all(name.split(".")):
            raise InputError(f"{name!r}: allowed is the name of a key, as in contact.damping")
    data = {**scene, **{name: value for name, value in changes.items() if "." not in name}}
    inner: dict[str, dict[str, Any]] = {"joints": {}, "bodies": {}, "load": {}}
    for name, value in changes.items():
        table, dot, key = name.partition(".")
        if dot:
            inner.setdefault(table, {})[key] = value
    joints, bodies, loads = (inner.pop(name) for name in ("joints", "bodies", "load"))
    if drawing := inner.pop("mechanism", None):
        drawn = _drawing_keys(data["mechanism"], drawing)
        with error_prefix("mechanism."):
            data["mechanism"] = change_mechanism(drawn, drawing)
    for table, keys in inner.items():
        current = data.get(table, {})
        if table in TABLES and not isinstance(current, Mapping):
            raise InputError(f"{table} = {current!r:.200}: allowed is a table of keys")
        if table not in TABLES:
            why = RENAMED.get(table, "")
            known = [*TABLES, "joints", "bodies", "load", "mechanism"]
            unknown = f"{table} is no table of a scene{nearest(table, known)}"
            why = f"is {why} now" if why else unknown
            key, value = next(iter(keys.items()))
            raise InputError(f"{table}.{key} = {value!r}: {why}")
        data[table] = changed_table(TABLES[table], current, keys)
    if bodies and isinstance(data.get("bodies", {}), Mapping):
        data["bodies"] = changed_tables("bodies", data.get("bodies", {}), bodies, changed_body)
    if loads:
        from exu_press.scene.loads import changed_load

        data["load"] = changed_tables("load", data.get("load", {}), loads, changed_load)
    if "joints" not in changes:
        data["joints"] = _changed_joints(data, groups, joints)
    elif joints:
        raise InputError("joints and a key of joints: allowed is one of the two in one change")
    for name in (name for name, value in changes.items() if value is None):
        for path in _member_names(name, groups):
            if _has(scene, path):
                drop(data, path)
    return data


def _changed_joints(
    scene: Mapping[str, Any], groups: Mapping[str, tuple[str, ...]], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a scene's joints with others: "NAME" -> a kind, or all keys; "NAME.key", ..."""
    by_member = {}
    for path, value in changes.items():
        name, dot, key = path.partition(".")
        is_whole = not dot and not isinstance(value, str)
        keys = joint_keys(name, value) if is_whole and value is not None else value
        for member in groups.get(name, (name,)):
            by_member[member if is_whole else f"{member}.{key or 'kind'}"] = keys
    try:
        change = partial(_changed_joint, scene)
        return changed_tables("joints", scene["joints"], by_member, change)
    except InputError as error:
        raise InputError(by_group(str(error), groups, changes)) from None


def _changed_joint(
    scene: Mapping[str, Any],
    name: str,
    joint: Mapping[str, Any] | None,
    changes: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the keys of a joint with others, also with those of its laws.

    A list of which one entry changes is that of the scene's law, unless the joint has its own.
    """
    keys = dict(joint or {})
    if (kind := changes.get("kind")) is not None:
        known = keys_of_kind(JOINT_KINDS.choose(f"joints.{name}.kind", kind, keys))
        keys = {key: value for key, value in keys.items() if key in known}
    for path, value in changes.items():
        key, dot, inner = path.partition(".")
        if not dot:
            keys[key] = value
        elif key in TABLES_OF_JOINTS and isinstance(keys.setdefault(key, {}), dict):
            kind = load_object("scene.worn:WornDepths") if key == "worn" else TABLES[key]
            entries = given_keys(scene.get(key)).get(inner.partition(".")[0])
            if "." in inner and isinstance(entries, list | tuple):
                keys[key] = {inner.partition(".")[0]: entries, **keys[key]}
            with error_prefix(f"joints.{name}."):
                keys[key] = changed_table(kind, keys[key], {inner: value})
        else:
            raise InputError(
                f"joints.{name}.{path} = {value!r}: {key} is no table of a joint"
                f"{nearest(key, TABLES_OF_JOINTS)}; allowed are {', '.join(TABLES_OF_JOINTS)}"
            )
    return keys


def asked_mechanism(mechanism: Any) -> Any:
    """Return a mechanism that is given as data or as the path of a file; others as they are."""
    if isinstance(mechanism, Mapping):
        with error_prefix("mechanism."):
            return mechanism_from_dict(mechanism)
    if isinstance(mechanism, str) and mechanism.lower().endswith(".toml"):
        return load_mechanism(mechanism)
    return mechanism


def _drawing_keys(mechanism: Any, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the mechanism of a scene as a nested mapping, of which keys are to be changed."""
    for key, value in changes.items():
        if key.partition(".")[0] not in DRAWN:
            near = nearest(key.partition(".")[0], DRAWN)
            raise InputError(
                f"mechanism.{key} = {value!r}: allowed are keys of {', '.join(DRAWN)}{near}"
            )
    mechanism = asked_mechanism(mechanism)
    if mechanism in SHIPPED:
        mechanism = shipped_mechanism(mechanism)
    if isinstance(mechanism, Mechanism):
        return mechanism_to_dict(mechanism)
    key, value = next(iter(changes.items()))
    raise InputError(
        f"mechanism.{key} = {value!r}: allowed where the mechanism is a drawing; dimensions and "
        f"masses of mechanism = {mechanism!r} are keys of [{mechanism}]"
    )


def gives_key(name: str, groups: Mapping[str, tuple[str, ...]], changes: Mapping[str, Any]) -> bool:
    """Return whether changes give a key or a table, of one joint, or a key of it, themselves."""
    for changed, value in changes.items():
        for path in _member_names(changed, groups):
            if name == path or path.startswith(f"{name}."):
                return True
            if name.startswith(f"{path}.") and _has(value, name.removeprefix(f"{path}.")):
                return True
    return False


def drop(data: dict[str, Any], name: str) -> None:
    """Take a key or a table out of nested mappings; the mappings of `data` are not changed."""
    first, _, rest = name.partition(".")
    if not rest:
        data.pop(first, None)
        return
    data[first] = given_keys(data[first])
    drop(data[first], rest)


def _member_names(name: str, groups: Mapping[str, tuple[str, ...]]) -> list[str]:
    """Return a dotted name, with the members of a group of joints in its place."""
    first, _, rest = name.partition(".")
    joint, dot, inner = rest.partition(".")
    if first != "joints" or joint not in groups:
        return [name]
    return [f"joints.{member}{dot}{inner}" for member in groups[joint]]


def _has(value: Any, name: str) -> bool:
    """Return whether a table that is given has a key."""
    first, _, rest = name.partition(".")
    keys = given_keys(value)
    return first in keys and (not rest or _has(keys[first], rest))


def by_group(
    message: str, groups: Mapping[str, tuple[str, ...]], changes: Mapping[str, Any]
) -> str:
    """Return a message about a joint with the name of its group, where changes name that."""
    for path in changes:
        group = path.removeprefix("joints.").partition(".")[0]
        for member in groups.get(group, ()):
            message = message.replace(f"joints.{member}", f"joints.{group}")
    return message
