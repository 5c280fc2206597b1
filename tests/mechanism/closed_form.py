"""Closed-form ideal kinematics, to check the numerical ones by: points, dyads, rods, derivatives.

Every function takes and gives motions over the same crank angles, so that a mechanism is written
as a chain of them, front to back. Velocities and accelerations come from differentiating the loop
equations, not from differences.
"""

import numpy as np
from numpy.typing import NDArray

from exu_press.mechanism import Motion

Array = NDArray[np.float64]


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


def guided(end: Motion, length: float, guide_x: float, side: int) -> Motion:
    """Return the end of a link that slides on the vertical x = guide_x.

    Args:
        end: the link's other end.
        length: length of the link, m.
        guide_x: position of the guide, m.
        side: -1 below the other end, +1 above it.
    """
    across = guide_x - end.position[:, 0]
    up = side * np.sqrt(length**2 - across**2)
    position = np.stack([np.full_like(across, guide_x), end.position[:, 1] + up], 1)
    link = position - end.position
    zero = np.zeros_like(across)
    vertical = np.stack([zero + 1.0, zero], 1)
    velocity = _meet(link, vertical, _dot(link, end.velocity), zero)
    turning = _dot(velocity - end.velocity, velocity - end.velocity)
    acceleration = _meet(link, vertical, _dot(link, end.acceleration) - turning, zero)
    return Motion(position, velocity, acceleration)


def dyad(a: Motion, length_a: float, b: Motion, length_b: float, side: int) -> Motion:
    """Return the pin that joins two links whose other ends move as a and b.

    Args:
        a: end of the first link, of length length_a.
        length_a: m.
        b: end of the second link, of length length_b.
        length_b: m.
        side: +1 where the pin lies to the left of the way from a to b, -1 to the right.
    """
    base = b.position - a.position
    square = _dot(base, base)
    far = np.sqrt(square)
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


def shifted(point: Motion, offset: tuple[float, ...]) -> Motion:
    """Return the motion of a point that keeps a constant distance, axes not turning."""
    return Motion(point.position + np.array(offset), point.velocity, point.acceleration)


def slider_crank(size, angle: Array, speed: float) -> dict[str, Motion]:
    """Return the motion of every body of a slider-crank."""
    pin = rotating(angle, speed, size.crank_radius)
    wrist = guided(pin, size.rod_length, 0.0, -1)
    return {
        "crank": turning(angle, speed, 0.0),
        "rod": rod(pin, wrist),
        "slider": sliding(wrist),
    }


def press(size, angle: Array, speed: float) -> dict[str, Motion]:
    """Return the motion of every body of the press."""
    pin = rotating(angle, speed, size.crank_radius)
    slide = guided(pin, size.linkage_length, 0.0, -1)
    counter_pin = rotating(angle, speed, -size.counter_eccentricity)
    counterweight = guided(counter_pin, size.counter_linkage_length, 0.0, +1)
    bodies = {
        "crank": turning(angle, speed, size.crank_mass_offset),
        "linkage": rod(pin, slide),
        "slide": sliding(slide),
        "counter_linkage": rod(counter_pin, counterweight),
        "counterweight": sliding(counterweight),
    }
    bottom = -size.crank_radius - size.linkage_length
    drop = np.sqrt(size.link_5_length**2 - size.pivot_distance**2)
    for side, sign in (("right", 1), ("left", -1)):
        x = sign * size.pivot_distance
        pivot = fixed(x, bottom - drop + size.link_6_length, len(angle))
        knuckle = dyad(slide, size.link_5_length, pivot, size.link_6_length, -sign)
        foot = guided(knuckle, size.link_7_length, x, -1)
        bodies[f"link_5_{side}"] = rod(slide, knuckle)
        bodies[f"link_6_{side}"] = rod(pivot, knuckle)
        bodies[f"link_7_{side}"] = rod(knuckle, foot)
        bodies[f"plunger_{side}"] = sliding(shifted(foot, (0.0, -0.5 * size.plunger_length)))
    ball = shifted(foot, (size.pivot_distance, -size.plunger_length))
    bodies["slider"] = sliding(ball)
    return bodies


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


def _dot(u: Array, v: Array) -> Array:
    return np.asarray(np.einsum("ij,ij->i", u, v))


def _cross(u: Array, v: Array) -> Array:
    return np.asarray(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
