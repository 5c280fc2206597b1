"""The variants of one scene, and the keys in which scenes differ."""

import math
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from itertools import combinations
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism import Mechanism, mechanism_to_dict
from exu_press.scene import LubricatedJoint, Scene, mechanism_of
from exu_press.schema.csv_table import flat

__all__ = ["different_keys", "variants"]

MOST_KEYS = 20
"""Keys that are listed one by one."""

FLEXIBILITY_ERROR = 0.02
"""Relative error of the static flexibility of bodies that are flexible in a comparison alone."""

ABSENT, IDEAL = "-", "ideal"

OPTIONAL = {"bodies": 2, "drive": 1, "guide": 1, "load": 2, "mechanism": 3}
"""Tables that a scene has or has not, by its user's choice -> parts of their names."""


def variants(scene: Scene) -> tuple[dict[str, Scene], list[str]]:
    """Return the variants of a scene by label, and why others are left out.

    Ideal; with dry and with lubricated joints, rigid and flexible. These are the scene's joints
    with clearance, or those that its mechanism usually has; balls are dry beside lubricated pins,
    as in the paper, unless the scene lubricates them. Flexible bodies are the scene's, or those
    that its mechanism usually has, with modes for FLEXIBILITY_ERROR. Clearances, loads and whatever
    else a variant uses are the scene's; a dry bearing is as long as its film. All are read from the
    same revolutions, also where the oil of some settles longer.

    Raises:
        InputError: the scene has no joint with clearance, nor does its mechanism usually have one.
    """
    usual = mechanism_of(scene).defaults
    names = list(scene.joints.by_group) or list(usual.get("joints", {}))
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
    rigid = scene.replace({"bodies": {}}) if scene.bodies else scene
    kinds, left_out = {"": rigid}, []
    flexible, why = _flexible_scene(scene)
    if flexible is None:
        left_out.append(f"flexible: left out, as {why}")
    else:
        kinds = {"rigid ": rigid, "flexible ": flexible}
    scenes_by_label = {"ideal": rigid.replace(_changed_kinds(joints["ideal"]))}
    for bodies_kind, base in kinds.items():
        change = _changed_kinds(joints["dry"])
        if not _has_length(base, "contact"):
            for name, joint in base.joints.by_group.items():
                if isinstance(joint, LubricatedJoint) and joint.film.length is not None:
                    change[f"joints.{name}.contact.length"] = joint.film.length
        scenes_by_label[f"{bodies_kind}dry"] = base.replace(change)
        if _has_length(base, "film") or set(names) <= set(balls):
            scene_with_film = base.replace(_changed_kinds(joints["lubricated"]))
            scenes_by_label[f"{bodies_kind}lubricated"] = scene_with_film
    if not any(label.endswith("lubricated") for label in scenes_by_label):
        left_out.append("lubricated: left out, as the scene has no film")
    settle = max(variant.settle_revolutions for variant in scenes_by_label.values())
    return {
        label: variant
        if variant.settle_revolutions == settle
        else variant.replace({"settle": settle})
        for label, variant in scenes_by_label.items()
    }, left_out


def _flexible_scene(scene: Scene) -> tuple[Scene | None, str]:
    """Return a scene with its flexible bodies or its mechanism's usual ones, or why it has none."""
    mechanism = mechanism_of(scene)
    usual = mechanism.defaults.get("bodies", {})
    if scene.bodies:
        return scene, ""
    if not usual:
        return None, f"neither scene nor {mechanism.name} has flexible bodies"
    if find_spec("ngsolve") is None:
        return None, "NGSolve is not installed"
    drawn_for = mechanism_of(Scene.from_dict({"mechanism": scene.mechanism, "joints": {}}))
    for body in usual:
        solid, drawn = (_joint_distances(m, body) for m in (drawn_for, mechanism))
        if not np.allclose(solid, drawn, atol=1e-4):
            return None, f"the solid of {body} is that of other dimensions"
    bodies = {
        name: {"flexible": solid, "flexibility_error": FLEXIBILITY_ERROR}
        for name, solid in usual.items()
    }
    try:
        return scene.replace({"bodies": bodies}), ""
    except InputError as error:
        return None, str(error)


def _joint_distances(mechanism: Mechanism, body: str) -> list[float]:
    """Return the distances between a body's joints, m, but for those of a counterweight.

    That may be missing: the solid then carries nothing there.
    """
    weights = set(mechanism.counterweight)
    joints = [j for j in mechanism.joints_of(body) if weights.isdisjoint((j.journal, j.bearing))]
    return [math.dist(a.at, b.at) for a, b in combinations(joints, 2)]


def _changed_kinds(kinds: Mapping[str, str]) -> dict[str, Any]:
    """Return the change of a scene that gives joints their kinds."""
    return {f"joints.{name}": kind for name, kind in kinds.items()}


def different_keys(scenes: Mapping[str, Scene]) -> list[list[str]]:
    """Return the keys in which scenes differ as a table: the head, then a line for each key.

    A table that only some scenes have is one line. Drawings of the same name are compared key by
    key, others by their names. Laws and dimensions that a scene does not use follow from its joints
    and its mechanism, and have none.

    Returns:
        the head alone where the scenes are the same.
    """
    same_name = len({mechanism_of(scene).name for scene in scenes.values()}) == 1
    drawn = any(isinstance(scene.to_dict()["mechanism"], Mapping) for scene in scenes.values())
    keys_of_scenes = [_keys(scene, drawing=same_name and drawn) for scene in scenes.values()]
    rows: dict[str, list[str]] = {}
    for key in sorted(dict.fromkeys(key for keys in keys_of_scenes for key in keys)):
        values = [
            _value_text(keys[key]) if key in keys else _usual(key, scene)
            for keys, scene in zip(keys_of_scenes, scenes.values(), strict=True)
        ]
        if len({value for value in values if value != ABSENT}) > 1:
            rows[key] = values
        elif ABSENT in values and (parts := key.split("."))[0] in OPTIONAL:
            table_name = ".".join(parts[: OPTIONAL[parts[0]]])
            has_table = [
                any(name.startswith(f"{table_name}.") for name in k) for k in keys_of_scenes
            ]
            if all(has_table):
                rows[key] = values
            else:
                rows[f"[{table_name}]"] = ["given" if has else ABSENT for has in has_table]
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


def _keys(scene: Scene, *, drawing: bool) -> dict[str, Any]:
    """Return the keys of a scene by their dotted names; a mechanism by its drawing or its name."""
    data = scene.to_dict()
    if drawing:
        data["mechanism"] = mechanism_to_dict(mechanism_of(scene))
    elif isinstance(data["mechanism"], Mapping):
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
