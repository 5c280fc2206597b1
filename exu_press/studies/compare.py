"""The variants of one scene, and the keys in which scenes differ."""

from collections.abc import Mapping, Sequence
from typing import Any

from exu_press.errors import InputError
from exu_press.scene import LubricatedJoint, Scene, mechanism_of
from exu_press.schema.csv_table import flat

__all__ = ["different_keys", "variants"]

MOST_KEYS = 20
"""Keys that are listed one by one."""

ABSENT, IDEAL = "-", "ideal"

OPTIONAL = ("bodies.", "drive.", "guide.", "load.")
"""Tables that a scene has or has not, by its user's choice."""


def variants(scene: Scene) -> dict[str, Scene]:
    """Return the scene with ideal, with dry and with lubricated joints, by label.

    These are the scene's joints with clearance, or those that its mechanism usually has; balls are
    dry beside lubricated pins, as in the paper, unless the scene lubricates them. A scene with
    flexible bodies is compared with rigid ones too. Clearances, loads and whatever else a variant
    uses are the scene's; a dry bearing is as long as its film. Dry joints are not lubricated where
    neither scene nor mechanism has an oil.

    Raises:
        InputError: the scene has no joint with clearance, nor does its mechanism usually have one.
    """
    names = list(scene.joints.by_group) or list(mechanism_of(scene).defaults.get("joints", {}))
    if not names:
        raise InputError(
            "joints: none has clearance, and so the scene has no variants; allowed is a scene with "
            "such joints, or several scenes"
        )
    balls = [
        name for name in names if scene.joints.spherical.issuperset(scene.joints.members(name))
    ]
    joints = {kind: dict.fromkeys(names, kind) for kind in ("ideal", "dry", "lubricated")}
    joints["lubricated"] |= {
        name: "dry"
        for name in balls
        if any(
            scene.joints[joint_name].kind != "lubricated"
            for joint_name in scene.joints.members(name)
        )
    }
    kinds: dict[str, Scene] = {"": scene}
    if scene.bodies:
        kinds = {"rigid ": scene.replace({"bodies": {}}), "flexible ": scene}
    scenes_by_label = {}
    for bodies, base in kinds.items():
        for label, change in joints.items():
            by_joint: dict[str, Any] = {f"joints.{name}": kind for name, kind in change.items()}
            if label == "dry" and not _has_length(base, "contact"):
                for name, joint in base.joints.by_group.items():
                    if isinstance(joint, LubricatedJoint) and joint.film.length is not None:
                        by_joint[f"joints.{name}.contact.length"] = joint.film.length
            if label != "lubricated" or _has_length(base, "film") or set(names) <= set(balls):
                scenes_by_label[bodies + label] = base.replace(by_joint)
    return scenes_by_label


def different_keys(scenes: Mapping[str, Scene]) -> list[list[str]]:
    """Return the keys in which scenes differ as a table: the head, then a line for each key.

    A table that only some scenes have is one line. Laws and dimensions that a scene does not use
    follow from its joints and its mechanism, and have none.

    Returns:
        the head alone where the scenes are the same.
    """
    keys_of_scenes = [_keys(scene) for scene in scenes.values()]
    rows: dict[str, list[str]] = {}
    for key in sorted(dict.fromkeys(key for keys in keys_of_scenes for key in keys)):
        values = [
            _value_text(keys[key]) if key in keys else _usual(key, scene)
            for keys, scene in zip(keys_of_scenes, scenes.values(), strict=True)
        ]
        if len({value for value in values if value != ABSENT}) > 1:
            rows[key] = values
        elif ABSENT in values and key.startswith(OPTIONAL):
            parts = key.split(".")[: 1 if key.startswith(("drive", "guide")) else 2]
            rows[f"[{'.'.join(parts)}]"] = [ABSENT if v == ABSENT else "given" for v in values]
    table = [[key, *values] for key, values in rows.items()]
    if (further := len(table) - MOST_KEYS) > 0:
        table = [*table[:MOST_KEYS], [f"{further} more keys", *["..."] * len(keys_of_scenes)]]
    return [["differences", *scenes], *table]


def _usual(key: str, scene: Scene) -> str:
    """Return what a key is that a scene does not give: the kind of a joint that it has is ideal."""
    table, _, name = key.removesuffix(".kind").partition(".")
    joints = scene.joints
    has = table == "joints" and key.endswith(".kind") and name in {**joints, **joints.groups}
    return IDEAL if has else ABSENT


def _keys(scene: Scene) -> dict[str, Any]:
    """Return the keys of a scene by their dotted names; a mechanism by its name alone."""
    data = scene.to_dict()
    if isinstance(data["mechanism"], Mapping):
        data["mechanism"] = data["mechanism"]["name"]
    return flat(data)


def _value_text(value: Any) -> str:
    """Return a value as a table has it, and the length of a long list."""
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(map(_value_text, value)) if len(value) < 4 else f"{len(value)} values"
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _has_length(scene: Scene, law: str) -> bool:
    """Return whether a scene or its mechanism has the length of bearings for one of the laws."""
    table = getattr(scene, law)
    own = mechanism_of(scene).defaults.get(law, {})
    return "length" in own or "length" in (table or {})
