"""A scene file to start from."""

import dataclasses
import textwrap
from collections.abc import Iterable, Iterator
from typing import Any

from exu_press.scene.blanking_load import BlankingLoad
from exu_press.scene.bodies import Flexible
from exu_press.scene.joints import Joints
from exu_press.scene.load import Load
from exu_press.scene.oil import Oil
from exu_press.scene.readings import Readings
from exu_press.scene.save import (
    body_lines,
    joint_lines,
    law_lines,
    load_lines,
    section_lines,
    table_lines,
)
from exu_press.scene.scene import Scene, mechanism_of
from exu_press.scene.table_load import TableLoad
from exu_press.scene.usage import LAWS, TABLES
from exu_press.schema.table import Table, table_from

__all__ = ["template"]


def template(mechanism: str, path_text: str = "") -> str:
    """Return a scene of a mechanism as TOML: keys in use as they stand, others as comments.

    Every key has its meaning and unit behind it; a table that is not in use has its defaults.

    Args:
        mechanism: name of a shipped one, or the path of a mechanism file.
        shown: that path as the scene is to have it.

    Raises:
        InputError: there is no such mechanism.
    """
    scene = Scene.from_dict({"mechanism": mechanism})
    own = [] if isinstance(scene.mechanism, str) else [f'mechanism = "{path_text or mechanism}"']
    return "\n".join([*own, *_lines(scene), ""])


def _lines(scene: Scene) -> Iterator[str]:
    yield "# Lines that begin with # are not in use; every key can be left out: it has its default."
    yield from table_lines(scene, True, absent=True)
    for field in dataclasses.fields(scene):
        value = getattr(scene, field.name)
        if isinstance(value, Joints):
            yield from ("", *_all_joints(value), *joint_lines(value, scene.laws, True))
            if not value.by_group:  # an example
                name = [joint for joint in value if joint not in value.spherical][-1]
                dry = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
                example = scene.replace({f"joints.{name}": dry, "contact": {"length": 0.05}})
                example_lines = joint_lines(example.joints, example.laws, True)[1:]
                yield from ("", *_not_in_use(example_lines))
        elif field.name == "load":
            yield from ("", *_not_in_use(_loads()))
        elif field.name == "bodies":
            yield from ("", *_not_in_use(_a_flexible_body(scene)))
        elif field.name in LAWS and value is not None:
            yield from law_lines(field.name, value, True, absent=True)
        elif isinstance(value, Table):
            yield from section_lines(field.name, value, True, absent=True)
        elif (kind := TABLES.get(field.name)) is not None and field.name not in OF_MECHANISMS:
            summary = (kind.__doc__ or "").splitlines()[0]
            table = table_from(kind, field.name, EXAMPLES.get(field.name, {}))
            lines = f"[{field.name}]  # {summary}", *table_lines(table, True, absent=True)
            yield from ("", *_not_in_use(lines))
        if field.name == "film" and "oil" not in (scene.film or {}):
            yield from ("", *_not_in_use(_an_oil()))
        if field.name == "output":
            readings = Readings(average=(5e-4,), average_deg=(1.0,), sampled=(5000.0,))
            yield from ("", *_not_in_use(_inner_table(readings)))


EXAMPLES: dict[str, dict[str, Any]] = {
    "drive": {"rated_torque": 400.0, "inertia": 50.0},
    "guide": {"lateral_stiffness": 1e9},
    "output": {"samples": (0.0, 180.0)},
    "wear": {"coefficient": 1e-5, "hardness": 2e9, "length": 0.1},
}
"""Values with which tables that are not in use are shown, since they need some."""

OF_MECHANISMS = ("press", "slider_crank")
"""Tables of other mechanisms than the scene's, which it could not use."""


def _not_in_use(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines as comments; one that is a comment already keeps the place of its meaning."""
    for line in lines:
        absent = line.startswith("# ")
        yield line.replace("  #", "    #", 1) if absent else f"# {line}".rstrip("# ")


def _an_oil() -> Iterator[str]:
    fields = {field.name: field for field in dataclasses.fields(Oil)}
    example = Oil(**{name: fields[name].metadata["example"] for name in Oil.needed})
    yield from _inner_table(example)


def _inner_table(example: Oil | Readings) -> Iterator[str]:
    yield f"[{example.table}]  # {(type(example).__doc__ or '').splitlines()[0]}"
    yield from table_lines(example, True, absent=True)


def _loads() -> Iterator[str]:
    examples: dict[str, Load] = {
        "blanking": BlankingLoad(force=1e4),
        "forming": TableLoad(crank_angle_deg=(120.0, 175.0, 180.0), force=(0.0, 1e4, 0.0)),
    }
    words = {
        "blanking": "Any number of loads, on any body.",
        "forming": 'Forces from a list, or file = "forming.csv" with two columns.',
    }
    for name, load in examples.items():
        yield f"[load.{name}]  # {words[name]}"
        yield from load_lines(load, True, absent=True)
        yield ""


def _a_flexible_body(scene: Scene) -> Iterator[str]:
    mechanism = mechanism_of(scene)
    guided = {guide.body for guide in mechanism.guides if guide.is_rail}
    free = [body.name for body in mechanism.bodies if body.name not in guided]
    shipped = scene.shipped_name == "press"
    name = "linkage" if shipped else free[-1]
    example = Flexible("linkage" if shipped else "my_part.step")
    yield f"[bodies.{name}]  # A flexible body: any one of the mechanism; rigid without it."
    yield from body_lines(example, True, absent=True)


def _all_joints(joints: Joints) -> list[str]:
    """Return as comments which joints the mechanism has, and which groups of them."""
    named = [f"joints: {', '.join(joints)}"]
    named += [f"group {name}: {', '.join(members)}" for name, members in joints.groups.items()]
    return [f"# {line}" for text in named for line in textwrap.wrap(text, 98)]
