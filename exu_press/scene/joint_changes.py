"""Changes of joints as nested mappings, before they are checked; and laws that none has."""

from collections.abc import Collection, Mapping
from typing import Any

from exu_press.errors import InputError
from exu_press.lazy import load_object
from exu_press.scene.joint import IdealJoint, Joint
from exu_press.scene.joints import joint_keys
from exu_press.scene.usage import TABLES
from exu_press.schema.checks import nearest
from exu_press.schema.table import changed_table

__all__ = ["by_group", "changed_joints", "unused_laws"]

TABLES_OF_JOINTS = ("contact", "friction", "film", "worn")


def unused_laws(joints: Collection[Joint]) -> dict[str, str]:
    """Return which of the scene's laws no joint has -> the reason."""
    touching = "no joint is 'dry' or has a mixed film"
    reasons = {"contact": touching, "friction": touching, "film": "no joint is 'lubricated'"}
    used = {law for law in reasons for joint in joints if getattr(joint, law, None) is not None}
    unused = {law: reason for law, reason in reasons.items() if law not in used}
    ideal = all(isinstance(joint, IdealJoint) for joint in joints)
    return {**unused, "start": "every joint is ideal"} if ideal else unused


def changed_joints(
    joints: Mapping[str, Mapping[str, Any]],
    groups: Mapping[str, tuple[str, ...]],
    changes: Mapping[str, Any],
) -> dict[str, dict[str, Any]]:
    """Return joints with other kinds or keys.

    Args:
        joints: as `Joints.to_dict` has them.
        groups: names for several joints at once -> these joints.
        changes: "NAME" -> a kind, or all keys; "NAME.key" or "NAME.law.key" -> a value.
    """
    changed = {name: dict(keys) for name, keys in joints.items()}
    for path, value in changes.items():
        name, _, inner = path.partition(".")
        key, _, last = inner.partition(".")
        for member in groups.get(name, (name,)):
            keys = changed.setdefault(member, {})
            if not inner and not isinstance(value, str):
                changed[member] = {} if value is None else joint_keys(name, value)
            elif not last:
                keys[key or "kind"] = value
            elif key in TABLES_OF_JOINTS and isinstance(keys.setdefault(key, {}), dict):
                kind = load_object("scene.worn:WornDepths") if key == "worn" else TABLES[key]
                keys[key] = changed_table(kind, keys[key], {last: value})
            else:
                raise InputError(
                    f"joints.{path} = {value!r}: {key} is no table of a joint"
                    f"{nearest(key, TABLES_OF_JOINTS)}; allowed are {', '.join(TABLES_OF_JOINTS)}"
                )
    return changed


def by_group(
    message: str, groups: Mapping[str, tuple[str, ...]], changes: Mapping[str, Any]
) -> str:
    """Return a message about a joint with the group's name, where that was changed.

    Args:
        message: names one joint of the group.
        groups: names for several joints at once -> these joints.
        changes: dotted name in the scene -> value.
    """
    for path in changes:
        group = path.removeprefix("joints.").partition(".")[0]
        for member in groups.get(group, ()):
            message = message.replace(f"joints.{member}", f"joints.{group}")
    return message
