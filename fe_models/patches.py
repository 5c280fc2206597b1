"""Faces of a solid that a guide or a load holds together: by name, by a box, or the sides."""

from collections.abc import Collection, Iterable, Mapping
from typing import Any

import numpy as np
from netgen.occ import OCCException  # type: ignore[import-untyped]

from fe_models.arrays import Array
from fe_models.dimensions import Box, Patch, Sides
from fe_models.errors import InputError

__all__ = ["lies_within", "name_patches"]

NEAR = 1e-4
"""m: how far a face may reach out of a box; drawings are rounded to tenths of a mm."""

PARALLEL = 1e-3
"""rad: largest angle between a plane's normal and a direction that count as parallel."""

FLAT = 1e-6
"""Largest distance of points from a plane over their spacing, up to which they lie in it."""


def name_patches(
    shape: Any, patches: Mapping[str, tuple[Patch, ...] | Sides], held: Collection[str], where: str
) -> None:
    """Give the faces of every patch its name.

    Args:
        shape: in m.
        patches: name -> its faces.
        held: names of faces that joints hold.
        where: beginning of messages.

    Raises:
        InputError: a patch has no faces, or one that a joint or another patch holds.
    """
    names = [face.name for face in shape.faces]
    taken: dict[int, str] = {i: name for i, name in enumerate(names) if name in held}
    for name, patch in patches.items():
        if isinstance(patch, Sides):
            numbers = _sides(shape, patch, name, where)
        else:
            numbers = set().union(*(_faces(shape, names, held, p, name, where) for p in patch))
        for i in sorted(numbers):
            if i in taken:
                raise InputError(
                    f"{where}: {taken[i]} and {name} hold the same face; allowed are different ones"
                )
            taken[i] = name
            shape.faces[i].name = name


def _faces(
    shape: Any,
    names: Iterable[str | None],
    held: Collection[str],
    patch: Patch,
    what: str,
    where: str,
) -> set[int]:
    """Return the numbers of a patch's faces."""
    if patch.box is None:
        numbers = {i for i, name in enumerate(names) if name == patch.name}
        if not numbers:
            known = sorted({name for name in names if name and name not in held})
            raise InputError(
                f"{where}: has no face named {patch.name!r} for {what}; its faces are named "
                f"{', '.join(map(repr, known)) or 'nothing at all'}"
            )
        return numbers
    numbers = {
        i for i, face in enumerate(shape.faces) if lies_within(face.bounding_box, patch.box, NEAR)
    }
    if not numbers:
        raise InputError(
            f"{where}: no face for {what} lies wholly within {_ranges(patch.box)}; the solid fills "
            f"{_ranges(tuple(shape.bounding_box))}, in m"
        )
    return numbers


def _sides(shape: Any, sides: Sides, what: str, where: str) -> set[int]:
    """Return the numbers of the outermost plane faces across a direction."""
    x, y = sides.across
    places: dict[int, float] = {}
    for i, face in enumerate(shape.faces):
        plane = _plane(face)
        if plane is not None:
            point, normal = plane
            if abs(normal[0] * y - normal[1] * x) + abs(normal[2]) < PARALLEL:
                places[i] = float(point[0] * x + point[1] * y)
    low, high = min(places.values(), default=0.0), max(places.values(), default=0.0)
    if high - low <= NEAR:
        raise InputError(
            f"{where}: has no plane faces on both sides across the guide's direction; allowed as "
            "faces.guide are the names of faces, or ranges of x, y and z that hold them"
        )
    return {i for i, position in places.items() if position < low + NEAR or position > high - NEAR}


def _plane(face: Any) -> tuple[Array, Array] | None:
    """Return a point and the unit normal of a plane face; None for others."""
    try:
        origin, u, v, both = (
            np.array([*face.surf.Value(*at)], dtype=float)
            for at in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.7, -0.4))
        )
    except OCCException:  # an offset surface has no points where it has no normal
        return None
    normal = np.cross(u - origin, v - origin)
    size = np.linalg.norm(normal)
    away = origin + 0.7 * (u - origin) - 0.4 * (v - origin) - both
    if not size > 0.0 or np.linalg.norm(away) > FLAT * np.linalg.norm(u - origin):
        return None
    return origin, normal / size


def lies_within(bounds: Any, box: Box, near: float) -> bool:
    """Return whether a bounding box, two points, lies within another, m."""
    (lowest, highest), (low, high) = bounds, box
    return all(lowest[i] >= low[i] - near and highest[i] <= high[i] + near for i in range(3))


def _ranges(box: Any) -> str:
    """Return the finite ranges of a box."""
    low, high = box
    return ", ".join(
        f"{axis} = [{low[i]:.5g}, {high[i]:.5g}]"
        for i, axis in enumerate("xyz")
        if np.isfinite([low[i], high[i]]).any()
    )
