"""The constraints of a planar mechanism: those of joints and guides as one system.

A constraint is Phi(q) = 0, with q the coordinates x, y and angle of all bodies. Its rate gamma is
the part of its second time derivative that has no accelerations::

    d^2 Phi / dt^2 = J q'' + gamma(q, q')

Points are complex numbers x + i y, so that a rotation is a product. Lengths are relative to the
mechanism's size, so that displacements compare with rotations. Fields of one kind of constraint may
be numbers, or arrays (m,) of m constraints.

Source: E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn & Bacon
1989, chapter 3.
"""

import cmath
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from exu_press.mechanism.drawing import Drawing
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import FRAME, GROUND, PRECISION, Body, Joint, Point
from exu_press.numerics.arrays import Array

__all__ = [
    "INDEPENDENT",
    "Coincidence",
    "PlanarConstraints",
    "PointOnCircle",
    "PointOnLine",
    "RotationRatio",
    "null_space",
    "planar_constraints",
]

INDEPENDENT = 10.0 * PRECISION
"""Singular value, over the largest one, from which constraints count as independent."""

Number = Any
"""A number, or an array of them."""

Gradient = tuple[Number, Number, Number]
"""A body's index, a row's derivatives d/dx + i d/dy by its centre, and that by its angle."""


class Poses:
    """Bodies at coordinates (..., 3 n), moving at rates of the same shape; the frame is the last.

    Attributes:
        z: centres, (..., n + 1).
        turn: exp(i angle).
        angle: rad.
        z_t: velocities of the centres.
        omega: angular velocities.
    """

    def __init__(self, q: Array, q_t: Array | None = None) -> None:
        """Take coordinates, and their rates where velocities are asked for."""
        self.z, self.angle = _of_bodies(q)
        self.turn = np.exp(1j * self.angle)
        if q_t is not None:
            self.z_t, self.omega = _of_bodies(q_t)

    def arm(self, body: Number, point: Number) -> Number:
        """Return the vector from a body's centre to a point of its frame."""
        return self.turn[..., body] * point

    def point(self, body: Number, point: Number) -> Number:
        """Return the position of a point of a body."""
        return self.z[..., body] + self.arm(body, point)

    def gap(self, pair: "Coincidence | PointOnLine | PointOnCircle") -> Number:
        """Return the vector from the base's point of a constraint to the body's."""
        return self.point(pair.body, pair.point) - self.point(pair.base, pair.base_point)

    def velocity(self, body: Number, point: Number) -> Number:
        """Return the velocity of a point of a body."""
        return self.z_t[..., body] + 1j * self.omega[..., body] * self.arm(body, point)

    def centripetal(self, body: Number, point: Number) -> Number:
        """Return a point's acceleration where centre and rotation of the body have none."""
        return -(self.omega[..., body] ** 2) * self.arm(body, point)


def _of_bodies(q: Array) -> tuple[Number, Array]:
    """Return the centres and angles of bodies and frame."""
    q = np.concatenate([q, np.zeros((*q.shape[:-1], 3))], axis=-1)
    return q[..., 0::3] + 1j * q[..., 1::3], q[..., 2::3]


class Coincidence(NamedTuple):
    """Points of two bodies coincide: a revolute joint, x and y of journal minus bearing."""

    body: Number
    point: Number
    base: Number
    base_point: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi of both rows."""
        gap = poses.gap(self)
        return [gap.real, gap.imag]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the rows of J."""
        arm, base_arm = poses.arm(self.body, self.point), poses.arm(self.base, self.base_point)
        return [
            [(self.body, 1.0, -arm.imag), (self.base, -1.0, base_arm.imag)],
            [(self.body, 1j, arm.real), (self.base, -1j, -base_arm.real)],
        ]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma of both rows."""
        gamma = poses.centripetal(self.body, self.point)
        gamma = gamma - poses.centripetal(self.base, self.base_point)
        return [gamma.real, gamma.imag]


class PointOnLine(NamedTuple):
    """A point of a body stays on a line of another: a guide or a slot, by its unit normal."""

    body: Number
    point: Number
    base: Number
    base_point: Number
    normal: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi, the distance along the normal."""
        return [(self._normal(poses).conj() * poses.gap(self)).real]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the row of J."""
        normal, arm = self._normal(poses), poses.arm(self.body, self.point)
        from_base = poses.point(self.body, self.point) - poses.z[..., self.base]
        return [
            [
                (self.body, normal, -(normal.conj() * arm).imag),
                (self.base, -normal, (normal.conj() * from_base).imag),
            ]
        ]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma, with the second derivative of the turning normal."""
        omega = poses.omega[..., self.base]
        rate = poses.velocity(self.body, self.point) - poses.velocity(self.base, self.base_point)
        gamma = poses.centripetal(self.body, self.point)
        gamma = gamma - poses.centripetal(self.base, self.base_point)
        gamma = gamma - omega**2 * poses.gap(self) - 2j * omega * rate
        return [(self._normal(poses).conj() * gamma).real]

    def _normal(self, poses: Poses) -> Number:
        return poses.arm(self.base, self.normal)


class PointOnCircle(NamedTuple):
    """A point of a body stays on a circle about a point of another: a circular slot."""

    body: Number
    point: Number
    base: Number
    base_point: Number
    radius: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi, (d^2 - R^2) / 2 R of the distance d."""
        return [0.5 * (abs(poses.gap(self)) ** 2 / self.radius - self.radius)]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the row of J."""
        normal = poses.gap(self) / self.radius
        arm, base_arm = poses.arm(self.body, self.point), poses.arm(self.base, self.base_point)
        return [
            [
                (self.body, normal, -(normal.conj() * arm).imag),
                (self.base, -normal, (normal.conj() * base_arm).imag),
            ]
        ]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma."""
        rate = poses.velocity(self.body, self.point) - poses.velocity(self.base, self.base_point)
        gamma = poses.centripetal(self.body, self.point)
        gamma = gamma - poses.centripetal(self.base, self.base_point)
        return [((poses.gap(self).conj() * gamma).real + abs(rate) ** 2) / self.radius]


class RotationRatio(NamedTuple):
    """A body turns a ratio times as far as another: 1 in a guide.

    `offset` is angle - ratio * (angle of the base) in the drawing.
    """

    body: Number
    base: Number
    ratio: Number
    offset: Number

    def residuals(self, poses: Poses) -> list[Number]:
        """Return Phi."""
        return [
            poses.angle[..., self.body] - self.ratio * poses.angle[..., self.base] - self.offset
        ]

    def gradients(self, poses: Poses) -> list[list[Gradient]]:
        """Return the row of J."""
        return [[(self.body, 0.0, 1.0), (self.base, 0.0, -self.ratio)]]

    def rates(self, poses: Poses) -> list[Number]:
        """Return gamma, which is zero."""
        return [np.zeros_like(poses.angle[..., self.body])]


Constraint = Coincidence | PointOnLine | PointOnCircle | RotationRatio


@dataclass(frozen=True)
class PlanarConstraints:
    """Residuals, Jacobian and rates of constraints, for coordinates (..., 3 n) of n bodies.

    Attributes:
        size: of the mechanism, m.
        bodies: names, in the order of their coordinates x and y, over the size, and angle, rad.
        drawn: coordinates in the drawing, (3 n,).
        constraints: with their names. "joints.NAME" has two rows, journal minus bearing along x
            and y; "guides.NAME" has one across it and one of the angle; "slots.NAME" and
            "gears.NAME" have one.
    """

    size: float
    bodies: tuple[str, ...]
    drawn: tuple[float, ...]
    constraints: tuple[tuple[str, Constraint], ...]

    @cached_property
    def _by_kind(self) -> list[tuple[list[str], Constraint]]:
        """Names of all constraints of a kind, and their fields as arrays."""
        kinds: dict[type, dict[str, Constraint]] = {}
        for name, constraint in self.constraints:
            kinds.setdefault(type(constraint), {})[name] = constraint
        return [
            (list(alike), kind(*map(np.array, zip(*alike.values(), strict=True))))
            for kind, alike in kinds.items()
        ]

    @cached_property
    def rows(self) -> Mapping[str, NDArray[np.intp]]:
        """Name -> its rows."""
        rows: dict[str, list[int]] = {name: [] for name, _ in self.constraints}
        names = [
            name
            for names, kind in self._by_kind
            for _ in kind.gradients(Poses(np.array(self.drawn)))
            for name in names
        ]
        for number, name in enumerate(names):
            rows[name].append(number)
        return {name: np.array(numbers) for name, numbers in rows.items()}

    def residuals(self, q: Array) -> Array:
        """Return the violations of the constraints, (..., m)."""
        poses = Poses(q)
        return np.concatenate([r for _, kind in self._by_kind for r in kind.residuals(poses)], -1)

    def jacobian(self, q: Array) -> Array:
        """Return the residuals' derivatives by the coordinates, (..., m, 3 n)."""
        poses = Poses(q)
        gradients = [
            (len(names), g) for names, kind in self._by_kind for g in kind.gradients(poses)
        ]
        matrix = np.zeros((*q.shape[:-1], sum(count for count, _ in gradients), q.shape[-1] + 3))
        first = 0
        for count, terms in gradients:
            row = np.arange(first, first + count)
            for body, by_centre, by_angle in terms:
                matrix[..., row, 3 * body] = np.real(by_centre)
                matrix[..., row, 3 * body + 1] = np.imag(by_centre)
                matrix[..., row, 3 * body + 2] = by_angle
            first += count
        return matrix[..., :-3]  # without the frame

    def rates(self, q: Array, q_t: Array) -> Array:
        """Return the residuals' second derivatives in time without accelerations, (..., m)."""
        poses = Poses(q, q_t)
        return np.concatenate([r for _, kind in self._by_kind for r in kind.rates(poses)], -1)

    def coordinates(self, motions: Mapping[str, Motion]) -> Array:
        """Return the coordinates (k, 3 n) of bodies that move over k instants."""
        poses = [motions[body].position / (self.size, self.size, 1.0) for body in self.bodies]
        return np.concatenate(poses, axis=-1)

    def angle_row(self, body: str) -> Array:
        """Return the gradient of a body's angle, (3 n,)."""
        return np.asarray(np.eye(len(self.drawn))[3 * self.bodies.index(body) + 2])

    def moving_bodies(self, directions: Array, least: float = INDEPENDENT) -> tuple[str, ...]:
        """Return the bodies that move in one of the directions (k, 3 n), which have unit length."""
        sizes = np.abs(directions).max(axis=0, initial=0.0).reshape(-1, 3).max(axis=1)
        return tuple(self.bodies[index] for index in np.flatnonzero(sizes > least))


def planar_constraints(
    drawing: Drawing, bodies: Sequence[Body], joints: Sequence[Joint]
) -> PlanarConstraints:
    """Return the constraints of some ideal joints, and of a drawing's guides and gears."""
    size = drawing.size
    index = {body.name: number for number, body in enumerate(bodies)} | {GROUND: len(bodies)}
    drawn = {body.name: body for body in bodies} | {GROUND: FRAME}

    def end(name: str, at: Point) -> tuple[int, complex]:
        return index[name], complex(*drawn[name].local(at)) / size

    def constraints() -> Iterator[tuple[str, Constraint]]:
        for joint in joints:
            ends = *end(joint.journal, joint.at), *end(joint.bearing, joint.at)
            yield f"joints.{joint.name}", Coincidence(*ends)
        for guide in drawing.guides:
            body, base = drawn[guide.body], drawn[guide.on]
            at = guide.at or body.centre_of_mass
            ends = *end(guide.body, at), *end(guide.on, guide.centre or at)
            if guide.radius is not None:
                yield guide.key, PointOnCircle(*ends, guide.radius / size)
            else:
                normal = complex(*guide.normal) * cmath.exp(-1j * base.angle)
                yield guide.key, PointOnLine(*ends, normal)
            if not guide.is_slot:
                offset = body.angle - base.angle
                yield guide.key, RotationRatio(index[guide.body], index[guide.on], 1.0, offset)
        for gear in drawing.gears:
            offset = drawn[gear.body].angle - gear.ratio * drawn[gear.to].angle
            pair = index[gear.body], index[gear.to]
            yield f"gears.{gear.name}", RotationRatio(*pair, gear.ratio, offset)

    return PlanarConstraints(
        size,
        tuple(body.name for body in bodies),
        tuple(q for b in bodies for q in (*(x / size for x in b.centre_of_mass), b.angle)),
        tuple(constraints()),
    )


def null_space(rows: Array) -> Array:
    """Return orthonormal motions (k, n) that constraints with a Jacobian (m, n) allow."""
    _, sizes, directions = np.linalg.svd(rows)
    return np.asarray(directions[int((sizes > INDEPENDENT * sizes[0]).sum()) :])
