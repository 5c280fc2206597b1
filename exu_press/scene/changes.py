"""A scene as a nested mapping with other values, before it is checked."""

from collections.abc import Mapping
from typing import Any

from exu_press.checks import RENAMED
from exu_press.errors import InputError
from exu_press.scene.bodies import changed_bodies
from exu_press.scene.joint_changes import changed_joints, kinds_of, unused_laws
from exu_press.scene.loads import changed_loads
from exu_press.scene.usage import TABLES, unused_keys

__all__ = ["changed_keys"]


def changed_keys(
    scene: Mapping[str, Any], groups: Mapping[str, tuple[str, ...]], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a scene's keys with other values; what is no longer used, and not named, is dropped.

    Args:
        scene: as `Scene.to_dict` has it; its tables may be changed.
        groups: names for several joints at once -> these joints.
        changes: dotted name -> value.

    Raises:
        InputError: a name is in no table of a scene.
    """
    data = {**scene, **{name: value for name, value in changes.items() if "." not in name}}
    inner: dict[str, dict[str, Any]] = {"joints": {}, "bodies": {}, "load": {}}
    for name, value in changes.items():
        table, dot, key = name.partition(".")
        if dot:
            inner.setdefault(table, {})[key] = value
    joints, bodies, loads = (inner.pop(name) for name in ("joints", "bodies", "load"))
    for table, keys in inner.items():
        before = data.get(table, {})
        if table not in TABLES or not isinstance(before, Mapping):
            why = RENAMED.get(table, "")
            why = f"is {why} now" if why else f"{table} is no table of a scene"
            key, value = next(iter(keys.items()))
            raise InputError(f"{table}.{key} = {value!r}: {why}")
        data[table] = {**before, **keys}
    if bodies and isinstance(data.get("bodies", {}), Mapping):
        data["bodies"] = changed_bodies(data.get("bodies", {}), bodies)
    if loads:
        data["load"] = changed_loads(data.get("load", {}), loads)
    if "joints" not in changes:
        data["joints"] = changed_joints(data["joints"], groups, joints, data.get("film"))
    elif joints:
        raise InputError("joints and a key of joints: allowed is one of the two in one change")
    for kept, dropped in (("step", "tolerance"), ("tolerance", "step")):
        if f"solver.{kept}" in changes and f"solver.{dropped}" not in changes:
            data["solver"].pop(dropped, None)
    unused = unused_keys(data) | unused_laws(kinds_of(data["joints"], data.get("film")))
    for name in unused.keys() - changes.keys():
        table, _, key = name.rpartition(".")
        place = data.get(table) if table else data
        named = any(changed.startswith(f"{name}.") for changed in changes)
        if isinstance(place, dict) and not named:
            place.pop(key, None)
    return data
