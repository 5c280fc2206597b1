"""Closed-form ideal kinematics: points, guided points, dyads and rods, with their derivatives.

Every function takes and gives motions over the same crank angles, so that a mechanism is written
as a chain of them, front to back. Velocities and accelerations come from differentiating the loop
equations, not from differences.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "AssemblyError",
    "Motion",
    "along",
    "dyad",
    "fixed",
    "guided",
    "rod",
    "rotating",
    "sliding",
    "turning",
]

Array = NDArray[np.float64]


class AssemblyError(ValueError):
    """Links do not reach; the text names them.

    `index` is the first crank angle concerned; None is bottom dead centre.
    """

    def __init__(self, text: str, index: int | None = None) -> None:
        """Remember where the links fail to meet."""
        super().__init__(text)
        self.index = index


@dataclass(frozen=True)
class Motion:
    """Position, velocity and acceleration over n instants, each of shape (n, 2) or (n, 3).

    Points have (x, y) in m; bodies have (x, y, angle), with the angle in rad.
    """

    position: Array
    velocity: Array
    acceleration: Array

    def __getitem__(self, columns: slice) -> "Motion":
        """Return the motion of some columns: body[:2] is the body's centre."""
        parts = (self.position, self.velocity, self.acceleration)
        return Motion(*(part[:, columns] for part in parts))

    def shifted(self, offset: tuple[float, ...]) -> "Motion":
        """Return the motion of a point that keeps a constant distance, axes not turning."""
        return Motion(self.position + np.array(offset), self.velocity, self.acceleration)


def fixed(x: float, y: float, count: int) -> Motion:
    """Return a point of the frame."""
    zero = np.zeros((count, 2))
    return Motion(zero + np.array([x, y]), zero, zero)


def rotating(angle: Array, speed: float, radius: float) -> Motion:
    """Return a point on the crank: at angle 0 it is above the shaft, turning counter-clockwise.

    Args:
        angle: (n,) crank angle from top dead centre, rad.
        speed: constant angular speed, rad/s.
        radius: distance from the shaft, m; negative for the opposite side.
    """
    across, up = np.sin(angle), np.cos(angle)
    return Motion(
        radius * np.stack([-across, up], 1),
        radius * speed * np.stack([-up, -across], 1),
        radius * speed**2 * np.stack([across, -up], 1),
    )


def guided(name: str, end: Motion, length: float, guide_x: float, side: int) -> Motion:
    """Return the end of a link that slides on the vertical x = guide_x.

    Args:
        name: what to call the link where it is too short.
        end: the link's other end.
        length: length of the link, m.
        guide_x: position of the guide, m.
        side: -1 below the other end, +1 above it.
    """
    across = guide_x - end.position[:, 0]
    _require(length > np.abs(across), lambda i: f"{name} = {length:g}: needs > {abs(across[i]):g}")
    up = side * np.sqrt(length**2 - across**2)
    position = np.stack([np.full_like(across, guide_x), end.position[:, 1] + up], 1)
    link = position - end.position
    zero = np.zeros_like(across)
    vertical = np.stack([zero + 1.0, zero], 1)
    velocity = _meet(link, vertical, _dot(link, end.velocity), zero)
    turning = _dot(velocity - end.velocity, velocity - end.velocity)
    acceleration = _meet(link, vertical, _dot(link, end.acceleration) - turning, zero)
    return Motion(position, velocity, acceleration)


def dyad(name: str, a: Motion, length_a: float, b: Motion, length_b: float, side: int) -> Motion:
    """Return the pin that joins two links whose other ends move as a and b.

    Args:
        name: what to call the pair of links where it does not meet.
        a: end of the first link, of length length_a.
        length_a: m.
        b: end of the second link, of length length_b.
        length_b: m.
        side: +1 where the pin lies to the left of the way from a to b, -1 to the right.
    """
    base = b.position - a.position
    square = _dot(base, base)
    far = np.sqrt(square)
    _require(
        (abs(length_a - length_b) < far) & (far < length_a + length_b),
        lambda i: f"{name} = {length_a:g}, {length_b:g}: must span {far[i]:g}",
    )
    along = (length_a**2 - length_b**2 + square) / (2 * far)
    unit = base / far[:, None]
    left = np.stack([-unit[:, 1], unit[:, 0]], 1)
    aside = side * np.sqrt(length_a**2 - along**2)
    position = a.position + along[:, None] * unit + aside[:, None] * left
    link_a, link_b = position - a.position, position - b.position
    velocity = _meet(link_a, link_b, _dot(link_a, a.velocity), _dot(link_b, b.velocity))
    turning_a = _dot(velocity - a.velocity, velocity - a.velocity)
    turning_b = _dot(velocity - b.velocity, velocity - b.velocity)
    acceleration = _meet(
        link_a,
        link_b,
        _dot(link_a, a.acceleration) - turning_a,
        _dot(link_b, b.acceleration) - turning_b,
    )
    return Motion(position, velocity, acceleration)


def rod(a: Motion, b: Motion) -> Motion:
    """Return the motion (x, y, angle) of the rod from a to b: its middle and its direction."""
    along = b.position - a.position
    square = _dot(along, along)
    relative = b.velocity - a.velocity
    turn = _cross(along, relative) / square
    turn_rate = _cross(along, b.acceleration - a.acceleration) / square - 2 * turn * (
        _dot(along, relative) / square
    )
    angle = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    return Motion(
        np.column_stack([(a.position + b.position) / 2, angle]),
        np.column_stack([(a.velocity + b.velocity) / 2, turn]),
        np.column_stack([(a.acceleration + b.acceleration) / 2, turn_rate]),
    )


def turning(angle: Array, speed: float, offset: float) -> Motion:
    """Return the motion (x, y, angle) of the crank, its centre of mass offset towards the pin."""
    centre = rotating(angle, speed, offset)
    rate = np.full_like(angle, speed)
    return Motion(
        np.column_stack([centre.position, angle]),
        np.column_stack([centre.velocity, rate]),
        np.column_stack([centre.acceleration, 0 * rate]),
    )


def sliding(point: Motion) -> Motion:
    """Return the motion (x, y, angle) of a body that a guide keeps upright."""
    parts = (point.position, point.velocity, point.acceleration)
    return Motion(*(np.column_stack([part, np.zeros(len(part))]) for part in parts))


def along(body: Motion, offset: float) -> Motion:
    """Return the motion (x, y, angle) of the point an offset (m) along a body's own x axis."""
    if offset == 0.0:
        return body
    angle, spin, turn = body.position[:, 2], body.velocity[:, 2], body.acceleration[:, 2]
    axis = offset * np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])
    across = np.column_stack([-axis[:, 1], axis[:, 0], np.zeros_like(angle)])
    return Motion(
        body.position + axis,
        body.velocity + spin[:, None] * across,
        body.acceleration + turn[:, None] * across - (spin**2)[:, None] * axis,
    )


def _meet(u: Array, v: Array, along_u: Array, along_v: Array) -> Array:
    """Return the vectors w with u.w = along_u and v.w = along_v."""
    determinant = _cross(u, v)
    return np.stack(
        [
            (along_u * v[:, 1] - along_v * u[:, 1]) / determinant,
            (u[:, 0] * along_v - v[:, 0] * along_u) / determinant,
        ],
        1,
    )


def _require(reached: NDArray[np.bool_], text: Callable[[int], str]) -> None:
    """Raise AssemblyError at the first angle where links do not reach (in line is singular)."""
    if not reached.all():
        index = int(np.argmin(reached))
        raise AssemblyError(text(index), index)


def _dot(u: Array, v: Array) -> Array:
    return np.asarray(np.einsum("ij,ij->i", u, v))


def _cross(u: Array, v: Array) -> Array:
    return np.asarray(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
