"""Write a scene file to start from: keys with their meaning, unused ones as comments."""

import argparse
import dataclasses
import os
import textwrap
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import check_writable, replacing
from exu_press.scene import Scene, mechanism_of
from exu_press.scene.blanking_load import BlankingLoad
from exu_press.scene.bodies import Flexible
from exu_press.scene.joints import Joints
from exu_press.scene.oil import Oil
from exu_press.scene.readings import Readings
from exu_press.scene.save import field_lines, table_lines
from exu_press.scene.table_load import TableLoad
from exu_press.scene.usage import TABLES
from exu_press.schema.table import Table, table_from

__all__ = ["EXAMPLE", "add_arguments", "execute", "template"]

EXAMPLE = "exu-press new my_press.toml --mechanism press"

SHIPPED = next(f for f in dataclasses.fields(Scene) if f.name == "mechanism").metadata["choices"]


EXAMPLES: dict[str, dict[str, Any]] = {
    "drive": {"rated_torque": 400.0, "inertia": 50.0},
    "guide": {"lateral_stiffness": 1e9},
    "output": {"samples": (0.0, 180.0)},
    "wear": {"coefficient": 1e-5, "hardness": 2e9, "length": 0.1},
}
"""Values with which tables that are not in use are shown, since they need some."""

OF_MECHANISMS = ("press", "slider_crank")
"""Tables of other mechanisms than the scene's, which it could not use."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("file", metavar="FILE.toml", help="the file to write; must not exist")
    parser.add_argument(
        "--mechanism",
        default="press",
        metavar="NAME",
        help=f"a shipped mechanism ({', '.join(SHIPPED)}; default: press) or a mechanism file",
    )


def execute(options: argparse.Namespace) -> int:
    """Write the file; return 0."""
    path = Path(options.file)
    if path.suffix != ".toml":
        raise InputError(f"{path}: allowed is a name that ends in .toml")
    if path.exists():
        raise InputError(f"{path}: exists; allowed is another name")
    check_writable(path)
    text = template(options.mechanism, os.path.relpath(options.mechanism or ".", path.parent))
    with replacing(path) as partial:
        partial.write_text(text, encoding="utf-8")
    print(f"written: {path}; run it with: exu-press run {path}")
    return 0


def template(mechanism: str, path_text: str = "") -> str:
    """Return a scene of a mechanism as TOML: keys in use as they stand, others as comments.

    Every key has its meaning and unit behind it; a table that is not in use has its defaults.

    Args:
        mechanism: name of a shipped one, or the path of a mechanism file.
        path_text: that path as the scene is to have it.

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
        if field.name == "joints":
            yield from ("", *_all_joints(scene.joints))
        yield from field_lines(scene, field.name, True, absent=True)
        if field.name == "joints" and not scene.joints.by_group:  # an example
            name = [joint for joint in scene.joints if joint not in scene.joints.spherical][-1]
            dry = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
            example = scene.replace({f"joints.{name}": dry, "contact": {"length": 0.05}})
            yield from ("", *_not_in_use(field_lines(example, "joints", True)[1:]))
        for head, table in _examples(scene, field.name):
            yield from ("", *_not_in_use([head, *table_lines(table, True, absent=True)]))


def _not_in_use(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines as comments; one that is a comment already keeps the place of its meaning."""
    for line in lines:
        absent = line.startswith("# ")
        yield line.replace("  #", "    #", 1) if absent else f"# {line}".rstrip("# ")


def _examples(scene: Scene, name: str) -> Iterator[tuple[str, Table]]:
    """Yield head and table of the examples for tables of a field that a scene does not have."""
    tables: list[Table] = []
    if name == "load":
        yield "[load.blanking]  # Any number of loads, on any body.", BlankingLoad(force=1e4)
        head = '[load.forming]  # Forces from a list, or file = "forming.csv" with two columns.'
        yield head, TableLoad(crank_angle_deg=(120.0, 175.0, 180.0), force=(0.0, 1e4, 0.0))
    elif name == "bodies":
        mechanism, shipped = mechanism_of(scene), scene.shipped_name == "press"
        guided = {guide.body for guide in mechanism.guides if guide.is_rail}
        free = [body.name for body in mechanism.bodies if body.name not in guided]
        head = "A flexible body: any one of the mechanism; rigid without it."
        yield (
            f"[bodies.{'linkage' if shipped else free[-1]}]  # {head}",
            Flexible("linkage" if shipped else "my_part.step"),
        )
    elif name in TABLES and name not in OF_MECHANISMS and getattr(scene, name) is None:
        tables.append(table_from(TABLES[name], name, EXAMPLES.get(name, {})))
    if name == "film" and "oil" not in (scene.film or {}):
        fields = {field.name: field for field in dataclasses.fields(Oil)}
        tables.append(Oil(**{key: fields[key].metadata["example"] for key in Oil.needed}))
    if name == "output":
        tables.append(Readings(average=(5e-4,), average_deg=(1.0,), sampled=(5000.0,)))
    for table in tables:
        yield f"[{table.table}]  # {(type(table).__doc__ or '').splitlines()[0]}", table


def _all_joints(joints: Joints) -> list[str]:
    """Return as comments which joints the mechanism has, and which groups of them."""
    named = [f"joints: {', '.join(joints)}"]
    named += [f"group {name}: {', '.join(members)}" for name, members in joints.groups.items()]
    return [f"# {line}" for text in named for line in textwrap.wrap(text, 98)]
