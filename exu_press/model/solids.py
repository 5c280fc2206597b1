"""The solid of a flexible body: a shipped part, that of a STEP file, or matrices."""

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from typing import Any

from exu_press.errors import InputError
from exu_press.mechanism import Point
from exu_press.scene import Face, Flexible
from exu_press.scene.bodies import GUIDE_FACE, USUAL_MESH_SIZE
from fe_models import (
    CRANK_STEEL,
    Axis,
    Interface,
    Material,
    MatrixPart,
    Part,
    Patch,
    Sides,
    StepFile,
    shipped_part,
)

__all__ = ["IN_THE_PLANE", "part_from_file", "part_of_shipped"]

IN_THE_PLANE = ("x", "y", "rz")
"""Motions of faces that a planar mechanism loads."""

MILLIMETRES = 1e-3
"""Netgen reads every STEP file in millimetres, whatever its own unit."""


def part_of_shipped(
    table: Flexible,
    faces: Mapping[str, tuple[Face, ...]],
    patches: Mapping[str, tuple[Face, ...]],
) -> tuple[Part, dict[str, str]]:
    """Return a shipped part in the scene's material, and patch -> the interface that carries it."""
    shipped = shipped_part(table.source, table.mesh_size or USUAL_MESH_SIZE)
    known = [interface.face for interface in shipped.interfaces]
    for name, group in {**faces, **patches}.items():
        wrong = [face.name for face in group if face.name not in known]
        if name in patches and len(group) != 1:
            wrong.append("")
        if wrong:
            unknown = f" {wrong[0]!r}" if wrong[0] else ""
            is_load = name in patches and name != GUIDE_FACE
            key = f"{name.replace(' ', '.')}.face" if is_load else f"faces.{name}"
            raise InputError(
                f"{table.source!r} has no face{unknown} for {name}; allowed as "
                f"{key} is one of {', '.join(map(repr, known))}"
            )
    material = _material(table, shipped.material)
    return shipped.replace(material=material), {
        name: group[0].name for name, group in patches.items()
    }


def part_from_file(
    table: Flexible,
    axes: Mapping[str, Axis],
    names: list[str],
    drive: tuple[Face, ...],
    patches: Mapping[str, tuple[Face, ...]],
    normal: Point,
) -> tuple[Part | MatrixPart, dict[str, str]]:
    """Return the part of a STEP file or matrices, and patch -> the interface that carries it.

    Of the interfaces that joints hold those without a name in the file have their axes; the guide's
    normal is that in the solid's frame.
    """
    driven = [face.name for face in drive if face.name not in names]
    first: dict[tuple[Face, ...], str] = {}  # loads may share a patch
    carriers = {
        name: group[0].name if len(group) == 1 and group[0].name else first.setdefault(group, name)
        for name, group in patches.items()
    }
    further = [name for name in dict.fromkeys(carriers.values()) if name not in (*names, *driven)]
    interfaces = [Interface(name) for name in dict.fromkeys(names)]
    interfaces += [Interface(name, ("rz",)) for name in driven]
    interfaces += [Interface(name, IN_THE_PLANE) for name in further]
    limits: dict[str, Any] = {
        "time_limit": table.time_limit,
        "memory_limit": table.memory_limit_gb and 1e9 * table.memory_limit_gb,
    }
    limits = {name: limit for name, limit in limits.items() if limit is not None}
    if table.matrices is not None:
        if axes or any(len(group) != 1 or not group[0].name for group in patches.values()):
            raise InputError(
                f"faces on {table.source!r}: allowed is the name of a node set for each joint, "
                "guide and load, without radius or ranges"
            )
        return MatrixPart(table.path, tuple(interfaces), **limits), carriers
    solid = StepFile(
        table.path,
        MILLIMETRES,
        axes=axes,
        patches={
            name: tuple(map(_patch, group)) or Sides(normal)
            for name, group in patches.items()
            if carriers[name] == name
        },
        **limits,
    )
    material = _material(table, CRANK_STEEL)
    size = table.mesh_size or USUAL_MESH_SIZE
    return Part(solid.path.stem, solid, material, tuple(interfaces), size), carriers


def _patch(face: Face) -> Patch:
    if face.name:
        return Patch(face.name)
    low, high = zip(*(ends or (-inf, inf) for ends in face.ranges), strict=True)
    return Patch(box=(low, high))


def _material(table: Flexible, default: Material) -> Material:
    keys = ("youngs_modulus", "poissons_ratio", "density")
    values = {key: value for key in keys if (value := getattr(table, key)) is not None}
    return replace(default, **values)
