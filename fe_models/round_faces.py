"""Faces of a solid that joints hold: cylinders along z and spheres, named by their positions."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import Any

import numpy as np
from netgen.occ import OCCException, Pnt, Sphere  # type: ignore[import-untyped]

from fe_models.dimensions import Axis
from fe_models.errors import InputError

__all__ = ["NEAR", "name_round_faces"]

NEAR = 1e-4
"""m: largest distance of an axis from a joint; drawings are rounded to tenths of a mm."""

PARAMETERS = (0.3, 1.1, 2.0, 3.7, 5.2)
EXACT = 1e-6  # of the size


@dataclass(frozen=True)
class _Round:
    """A cylinder along z, or a sphere: its axis, radius and height, m."""

    face: Any
    sphere: bool
    x: float
    y: float
    radius: float
    low: float
    high: float

    def __str__(self) -> str:
        return f"radius = {self.radius:.6g}, z = [{self.low:.5g}, {self.high:.5g}]"


def name_round_faces(shape: Any, axes: Mapping[str, Axis], where: str) -> None:
    """Name the faces of a shape that lie about axes.

    Args:
        shape: in m.
        axes: name of a face -> its axis.
        where: beginning of messages.

    Raises:
        InputError: an axis has no face, several, or one that another axis has.
    """
    if not axes:
        return
    round_faces = [round_face for face in shape.faces if (round_face := _round(face)) is not None]
    taken: dict[int, str] = {}
    for name, axis in axes.items():
        suitable = [face for face in round_faces if _suits(face, axis)]
        group = _select_group(shape, suitable, axis, name, where)
        if not group:
            raise InputError(f"{where}: {_no_face_message(round_faces, axis, name)}")
        for round_face in group:
            number = round_faces.index(round_face)
            if number in taken:
                raise InputError(
                    f"{where}: {taken[number]} and {name} hold the same face ({round_face}); "
                    "allowed are different ones: say which by radius or z"
                )
            taken[number] = name
            round_face.face.name = name


def _round(face: Any) -> _Round | None:
    """Return a face as a cylinder along z or a sphere, if it is one."""
    try:
        points, raised = (
            np.array([_xyz(face.surf.Value(u, v)) for u in PARAMETERS]) for v in (0.0, 1e-3)
        )
    except OCCException:  # an offset surface has no points where it has no normal
        return None
    (_, _, low), (_, _, high) = (_xyz(corner) for corner in face.bounding_box)
    away = raised - points
    flat = np.column_stack([2.0 * points[:, :2], np.ones(len(points))])
    squares = (points[:, :2] ** 2).sum(axis=1)
    circle, _, rank, _ = np.linalg.lstsq(flat, squares)
    along = np.abs(away[:, :2]).max() < EXACT * np.abs(away).max() and np.ptp(away[:, 2]) < EXACT
    if along and rank == 3 and np.ptp(points[:, 2]) < EXACT * max(np.abs(points).max(), 1e-3):
        x, y, rest = (float(value) for value in circle)
        radius = (rest + x * x + y * y) ** 0.5
        if np.abs(flat @ circle - squares).max() < EXACT * radius**2:
            return _Round(face, False, x, y, radius, low, high)
    everywhere = np.array([_xyz(face.surf.Value(u, v)) for u in PARAMETERS for v in (-0.7, 0.4)])
    rows = np.column_stack([2.0 * everywhere, np.ones(len(everywhere))])
    squares = (everywhere**2).sum(axis=1)
    ball, _, rank, _ = np.linalg.lstsq(rows, squares)
    if rank == 4 and np.abs(rows @ ball - squares).max() < EXACT * squares.max():
        radius = float(ball[3] + (ball[:3] ** 2).sum()) ** 0.5
        return _Round(face, True, float(ball[0]), float(ball[1]), radius, low, high)
    return None


def _xyz(point: Any) -> tuple[float, float, float]:
    x, y, z = point
    return float(x), float(y), float(z)


def _suits(face: _Round, axis: Axis) -> bool:
    return (
        face.sphere == axis.sphere
        and _distance(face, axis) <= NEAR
        and (axis.radius is None or abs(face.radius - axis.radius) <= NEAR)
        and (axis.z is None or (face.low >= axis.z[0] - NEAR and face.high <= axis.z[1] + NEAR))
    )


def _distance(face: _Round, axis: Axis) -> float:
    return hypot(face.x - axis.position[0], face.y - axis.position[1])


def _select_group(
    shape: Any, round_faces: list[_Round], axis: Axis, name: str, where: str
) -> list[_Round]:
    """Return the group of touching faces of one radius that an axis has, holes or shafts."""
    groups = _groups(round_faces)
    if len(groups) > 1:
        suitable = [group for group in groups if _is_hole(shape, group[0]) == axis.hole]
        groups = suitable if len(suitable) == 1 else groups
    if len(groups) > 1:
        descriptions = "; ".join(str(_whole(group)) for group in groups)
        raise InputError(
            f"{where}: {len(groups)} round faces lie about {name}: {descriptions}. Say which by "
            "radius or z"
        )
    return groups[0] if groups else []


def _groups(round_faces: Iterable[_Round]) -> list[list[_Round]]:
    """Return faces of one radius that touch along z, together."""
    groups: list[list[_Round]] = []
    for face in sorted(round_faces, key=lambda face: (round(face.radius / NEAR), face.low)):
        last = groups[-1] if groups else []
        touches = last and abs(last[-1].radius - face.radius) <= NEAR
        if touches and face.low <= max(face.high for face in last) + NEAR:
            last.append(face)
        else:
            groups.append([face])
    return groups


def _whole(group: list[_Round]) -> _Round:
    first = group[0]
    low, high = min(face.low for face in group), max(face.high for face in group)
    return _Round(first.face, first.sphere, first.x, first.y, first.radius, low, high)


def _is_hole(shape: Any, face: _Round) -> bool:
    """Return whether the material is outside a round face."""
    middle, small = 0.5 * (face.low + face.high), 0.02 * face.radius
    for turn in np.arange(0.1, 2.0 * pi, 0.7):
        points = (
            Pnt(face.x + r * cos(turn), face.y + r * sin(turn), middle)
            for r in (face.radius - 2.0 * small, face.radius + 2.0 * small)
        )
        inside, outside = ((shape * Sphere(point, small)).mass > 0.0 for point in points)
        if inside != outside:
            return bool(outside)
    return False


def _no_face_message(round_faces: Iterable[_Round], axis: Axis, name: str) -> str:
    """Return the message that no face suits an axis, with the distance of the nearest one."""
    kind = "sphere" if axis.sphere else "cylinder along z"
    asked = "" if axis.radius is None else f" of radius {axis.radius:g} m"
    asked += "" if axis.z is None else f" within z = {list(axis.z)}"
    x, y = axis.position
    text = f"no {kind}{asked} lies about {name}, at ({x:.6g}, {y:.6g}) m of the file"
    alike = [candidate for candidate in round_faces if candidate.sphere == axis.sphere]
    if not alike:
        return f"{text}; it has none at all"
    near = min(alike, key=lambda candidate: _distance(candidate, axis))
    away = _distance(near, axis)
    if away <= NEAR:
        about = {str(candidate): None for candidate in alike if _distance(candidate, axis) <= NEAR}
        return f"{text}; there are {'; '.join(about)}"
    x, y = (round(coordinate, 9) + 0.0 for coordinate in (near.x, near.y))  # without -0 and 1e-17
    return (
        f"{text}; the nearest one's axis is {1e3 * away:.4g} mm away, at ({x:.6g}, {y:.6g}) "
        f"({near}); allowed is {1e3 * NEAR:g} mm"
    )
