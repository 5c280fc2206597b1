"""Draw a mechanism before anything runs: names, mobility, stroke, dead centres, transmission."""

import argparse
import math
import sys
import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.cli.options import (
    SHIPPED,
    add_code_argument,
    add_picture_arguments,
    add_set_argument,
    demand_save,
    shipped_names,
    show_warnings,
)
from exu_press.errors import InputError, error_prefix
from exu_press.mechanism import SHIPPED as MECHANISMS
from exu_press.mechanism import (
    Mechanism,
    Press,
    SliderCrank,
    change_mechanism,
    mechanism_from_dict,
    mechanism_to_dict,
    press,
    shipped_mechanism,
    slider_crank,
)
from exu_press.mechanism.drawing_warnings import drawing_warnings
from exu_press.mechanism.examine import Examination, examine
from exu_press.mechanism.file import TOP
from exu_press.mechanism.stroke import units_of_output
from exu_press.mechanism.transmission import group_equal_angles, least_transmission_angle
from exu_press.scene import Scene
from exu_press.scene.file import parse_assignment
from exu_press.scene.solver import RPM
from exu_press.schema.checks import checked_value, demand_known
from exu_press.schema.table import declared_keys, table_from
from exu_press.schema.toml import read_toml
from exu_press.terminal.columns import columns

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press draw press --save press_drawing.png"

BY_DIMENSIONS: dict[str, tuple[type, Any]] = {
    "press": (Press, press),
    "slider_crank": (SliderCrank, slider_crank),
}

SEPARATOR = "  \N{MIDDLE DOT}  "

DRAWN = ("mechanism", "speed_rpm")
"""Keys of a scene that a drawing shows, beside the dimensions of its mechanism."""

OF_DRAWINGS = {*TOP[0], *TOP[1]} - declared_keys(Scene).keys()
"""Keys of a mechanism file that no scene has."""

ALWAYS_LISTED = ("bodies", "joints", "guides")
"""Kinds of elements that are listed where there are none, too."""

STEP = 30
"""deg, between the rows of the table."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "path",
        metavar="MECHANISM|SCENE",
        help=f"a mechanism file, a scene file, or a shipped name: {', '.join(_names())}",
    )
    add_code_argument(parser)
    add_set_argument(
        parser, "the drawing, as in press.crank_radius=0.1 or joints.crank_pin.at=[0.0, 0.1]"
    )
    parser.add_argument(
        "--save",
        metavar="PICTURE",
        help="write the drawing and the curves over the crank angle as .png, .svg or .pdf",
    )
    add_picture_arguments(parser, to_files=False)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")


def execute(options: argparse.Namespace) -> int:
    """Print and draw the examination of a drawing; return 0, or 2 where it does not move."""
    demand_save(options, "width", "style")
    target = None if options.save is None else Path(options.save)
    if target is not None:
        from exu_press.plots.file import check_picture

        check_picture(target)
    mechanism, speed = _load_mechanism(options.path, dict(map(parse_assignment, options.set)))
    examined = examine(mechanism)
    summary = _summary(examined)
    if not options.quiet:
        print("\n".join([mechanism.name, *_parts(mechanism), *columns(summary, 2)]))
        if examined.stroke is not None:
            print("\n".join(["", *_table(examined, speed)]))
    if target is not None:
        from exu_press.plots.drawing import drawing_figure
        from exu_press.plots.file import save_figure

        few = [f"{name} {value}" for name, value in summary if "transmission" not in name]
        lines = [SEPARATOR.join(few[start : start + 3]) for start in range(0, len(few), 3)]
        save_figure(drawing_figure(examined, "\n".join(lines), speed), target)
        if not options.quiet:
            print(f"written: {target}")
    is_length = examined.stroke is not None and not mechanism.output.rotation
    stroke = examined.stroke.length if examined.stroke and is_length else math.inf
    show_warnings(drawing_warnings(mechanism, stroke))
    for fault in examined.faults:
        print(f"exu-press: {fault}", file=sys.stderr)
    return 2 if examined.faults else 0


def _names() -> list[str]:
    return sorted({*BY_DIMENSIONS, *MECHANISMS, *shipped_names()})


def _load_mechanism(name: str, changes: Mapping[str, Any]) -> tuple[Mechanism, float | None]:
    """Return the mechanism, and the crank's speed (rad/s) where a scene says it.

    A scene is read as far as its mechanism goes: `Scene` refuses mechanisms with faults.
    """
    path, data = Path(name), dict[str, Any]()
    if path.exists() or path.suffix:
        data = read_toml(path)
    elif name in MECHANISMS or name in BY_DIMENSIONS:
        data = {"mechanism": name}
    else:
        demand_known(f"{name}: no such mechanism or scene", name, ["a file", *_names()])
        data = read_toml(path := SHIPPED / f"{name}.toml")
    with error_prefix(f"{path.name} with --set: " if changes else f"{path}: "):
        if "mechanism" not in data and data.keys() & OF_DRAWINGS:
            return mechanism_from_dict(change_mechanism(data, changes)), None
        return _of_scene(data, path.parent, changes)


def _of_scene(
    data: Mapping[str, Any], folder: Path, changes: Mapping[str, Any]
) -> tuple[Mechanism, float | None]:
    """Return the mechanism that a scene names or holds, and the crank's speed where it says it."""
    own = {name: changes[name] for name in DRAWN if name in changes}
    further = {name: value for name, value in changes.items() if name not in own}
    scene = {**data, **own}
    mechanism = scene.get("mechanism", "press")
    speed = _speed(scene)
    if isinstance(mechanism, Mapping):
        return mechanism_from_dict(change_mechanism(mechanism, further)), speed
    if isinstance(mechanism, str) and mechanism.lower().endswith(".toml"):
        drawing = change_mechanism(read_toml(file := folder / mechanism), further)
        with error_prefix(f"{file}: "):
            return mechanism_from_dict(drawing), speed
    return _build_mechanism(mechanism, scene, further), speed


def _build_mechanism(name: Any, scene: Mapping[str, Any], changes: Mapping[str, Any]) -> Mechanism:
    """Return a shipped mechanism, with the dimensions that a scene gives it, changed."""
    if name in BY_DIMENSIONS:
        for change, value in changes.items():
            if change.split(".")[0] != name:
                allowed = ", ".join([*DRAWN, f"{name}.KEY"])
                raise InputError(f"{change} = {value!r}: is not drawn; allowed are {allowed}")
        table, build = BY_DIMENSIONS[name]
        sizes = change_mechanism({name: scene.get(name, {})}, changes)[name]
        drawn: Mechanism = build(table_from(table, name, sizes))
        return drawn
    known = "the path of a mechanism file, .toml", *BY_DIMENSIONS, *MECHANISMS
    demand_known(f"mechanism = {name!r}: unknown", name, known)
    return mechanism_from_dict(
        change_mechanism(mechanism_to_dict(shipped_mechanism(name)), changes)
    )


def _speed(data: Mapping[str, Any]) -> float | None:
    rpm = data.get("speed_rpm")
    if rpm is None:
        return None
    speed: float = checked_value(declared_keys(Scene)["speed_rpm"], "speed_rpm", rpm)
    return speed * RPM


def _parts(mechanism: Mechanism) -> list[str]:
    lines = []
    for kind, names in (
        ("bodies", [body.name for body in mechanism.bodies]),
        ("joints", [joint.name for joint in mechanism.joints]),
        ("guides", [guide.name for guide in mechanism.guides if not guide.is_slot]),
        ("slots", [guide.name for guide in mechanism.guides if guide.is_slot]),
        ("gears", [gear.name for gear in mechanism.gears]),
        ("springs", [spring.name for spring in mechanism.springs]),
    ):
        if not names and kind not in ALWAYS_LISTED:
            continue
        text = f"{kind} ({len(names)}): {', '.join(names) or 'none'}"
        lines += textwrap.wrap(text, 98, initial_indent="  ", subsequent_indent="    ")
    return lines


def _summary(examined: Examination) -> list[tuple[str, str]]:
    mobility = examined.mobility
    held = [f"{rows} x {number} {kind}" for kind, (number, rows) in mobility.constraints.items()]
    terms = " - ".join([f"3 x {mobility.bodies} bodies", *held])
    counted = f"{mobility.degrees_of_freedom} ({terms} = {mobility.gruebler_count}"
    spare = f"; redundant constraints: {mobility.redundant}" if mobility.redundant else ""
    rows = [("mobility", f"{counted}{spare})")]
    stroke = examined.stroke
    if stroke is None:
        return rows
    units = units_of_output(examined.mechanism)
    length = f"{units.position_scale * stroke.length:.3f} {units.position}"
    rows.append((f"stroke of {examined.mechanism.slider}", length))
    for centre in stroke.dead_centres:
        position = f"position {units.position_scale * centre.position:.3f} {units.position}"
        which = "top" if centre.top else "bottom"
        rows.append((f"{which} dead centre", f"{math.degrees(centre.angle):.3f} deg, {position}"))
    peak = stroke.peak_velocity
    if peak > 0.0:
        angle = f"at {math.degrees(stroke.peak_angle):.1f} deg"
        velocity = f"{units.velocity_scale * peak:.3f} {units.velocity}"
        rows.append(("velocity, max", f"{velocity} {angle}"))
        rows.append(("mechanical advantage, min", f"{1 / peak:.3f} {units.advantage} {angle}"))
    for names, values in group_equal_angles(examined.transmission):
        name, near = names.partition(",")[0], math.radians(int(values.argmin()))
        least, crank = (
            math.degrees(value)
            for value in least_transmission_angle(examined.mechanism, name, near)
        )
        low = f"{least:.2f} deg at {crank % 360.0:.1f} deg"
        rows.append(("transmission angle, min", f"{names}: {low}"))
    return rows


def _table(examined: Examination, speed: float | None) -> list[str]:
    """Return position, velocity, mechanical advantage and least transmission angle in rows."""
    stroke = examined.stroke
    assert stroke is not None
    units = units_of_output(examined.mechanism)
    unit, scale = (units.velocity, units.velocity_scale) if speed is None else (units.speed, speed)
    least = [np.degrees(values) for values in examined.transmission.values()]
    rows = [
        (
            "crank angle, deg",
            f"position, {units.position}",
            f"velocity, {unit}",
            units.ratio,
            "least transmission angle, deg",
        )
    ]
    for angle in range(0, 361, STEP):
        advantage = stroke.mechanical_advantage[angle]
        rows.append(
            (
                f"{angle}",
                f"{round(units.position_scale * float(stroke.position[angle]), 3) + 0.0:.3f}",
                f"{round(scale * float(stroke.velocity[angle]), 4) + 0.0:.4f}",
                f"{advantage:.2f}" if math.isfinite(advantage) else "infinite",
                f"{min(values[angle] for values in least):.2f}" if least else "-",
            )
        )
    return columns(rows, right=True)
