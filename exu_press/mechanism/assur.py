"""Assur groups: the smallest sets of bodies whose positions follow from those already known.

A mechanism with one degree of freedom is its crank and a sequence of such groups, front to back: a
dyad, a body on two guides, or more bodies whose loops close together only. Each group is solved by
itself, with one coordinate for every body: the displacement along its guide, or the angle at which
it hangs in a joint with the body before. What then remains are the group's loops: joints whose two
bodies are both in place and must meet.

Points are complex numbers x + i y, so that a rotation is a product. All lengths are relative to the
mechanism's size. The same code takes one crank angle or an array of them.

References
----------
.. [1] L. V. Assur, Investigation of plane mechanisms with lower pairs, St. Petersburg 1914.
.. [2] E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn & Bacon 1989,
   chapter 3.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Drawing", "Group", "Pose", "groups_of", "known_bodies", "one_group_of"]

Number = Any
"""One complex (or real) number, or an array of them over crank angles."""

LARGEST_GROUP = 8
"""Bodies; above that, all that are left are solved together."""

INDEPENDENT = 1e-9
"""Smallest singular value of loops that hold their bodies, relative to the mechanism's size."""


class Drawing(NamedTuple):
    """The geometry alone.

    Bodies are (name, centre of mass, angle), joints (name, at, journal, bearing), guides (body,
    direction); `frame` is the name of the body that stands still.
    """

    bodies: tuple[tuple[str, complex, float], ...]
    joints: tuple[tuple[str, complex, str, str], ...]
    guides: tuple[tuple[str, complex], ...]
    crank: str
    frame: str


class Pose:
    """A body's position: centre, direction e = exp(i angle), and their derivatives by crank angle.

    `partials` are the centre's derivatives by its group's coordinates, `column` is the coordinate
    that is the body's angle, if any.
    """

    __slots__ = ("a", "angle", "column", "e", "partials", "w", "z", "z1", "z2")

    def __init__(
        self, z: Number, angle: Number, partials: Sequence[Number] = (), column: int | None = None
    ) -> None:
        self.z, self.angle, self.e = z, angle, np.exp(1j * angle)
        self.partials, self.column = partials, column
        self.z1: Number = 0.0
        self.z2: Number = 0.0
        self.w: Number = 0.0
        self.a: Number = 0.0

    def point(self, local: complex) -> Number:
        """Return where a point of the body is."""
        return self.z + self.e * local

    def velocity(self, local: complex) -> Number:
        """Return how fast it moves."""
        return self.z1 + 1j * self.w * (self.e * local)

    def acceleration(self, local: complex) -> Number:
        """Return how it is accelerated."""
        return self.z2 + (1j * self.a - self.w * self.w) * (self.e * local)

    def point_partials(self, local: complex, count: int) -> list[Number]:
        """Return the point's derivatives by the group's coordinates."""
        partials = list(self.partials) or [0.0] * count
        if self.column is not None:
            partials[self.column] = partials[self.column] + 1j * (self.e * local)
        return partials


@dataclass(frozen=True)
class _Member:
    """A body of a group: on its guide, or hanging in a joint with a body before it."""

    body: str
    centre: complex
    angle: float
    direction: complex | None = None
    before: str = ""
    point_before: complex = 0.0
    point: complex = 0.0


@dataclass(frozen=True)
class _Loop:
    """A joint whose two bodies are in place already."""

    bodies: tuple[str, str]
    points: tuple[complex, complex]


@dataclass(frozen=True)
class Group:
    """Bodies that are found together, in the order in which they are placed.

    Attributes:
        members: each has one coordinate.
        loops: each has two equations; more than coordinates where some are redundant.
    """

    members: tuple[_Member, ...]
    loops: tuple[_Loop, ...]

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names."""
        return tuple(member.body for member in self.members)

    @property
    def square(self) -> bool:
        """Return whether there are as many equations as coordinates."""
        return 2 * len(self.loops) == len(self.members)

    def drawn(self) -> Array:
        """Return the coordinates in the drawing."""
        return np.array([0.0 if m.direction is not None else m.angle for m in self.members])

    def winding(self) -> Array:
        """Return 1 for coordinates that are angles, 0 for displacements along guides."""
        return np.array([float(member.direction is None) for member in self.members])

    def place(self, poses: dict[str, Pose], u: Array) -> None:
        """Add the members' poses for coordinates of shape (k,) or (k, n)."""
        count = len(self.members)
        for column, member in enumerate(self.members):
            partials: list[Number] = [0.0] * count
            if member.direction is not None:
                partials[column] = member.direction
                z = member.centre + member.direction * u[column]
                poses[member.body] = Pose(z, member.angle, partials)
                continue
            before = poses[member.before]
            pose = Pose(0.0, u[column], (), column)
            arm = pose.e * member.point
            pose.z = before.point(member.point_before) - arm
            if before.partials:
                partials = before.point_partials(member.point_before, count)
            partials[column] = partials[column] - 1j * arm
            pose.partials = partials
            poses[member.body] = pose

    def settle(self, poses: Mapping[str, Pose]) -> None:
        """Make the members' poses known ones, which depend on no coordinates."""
        for body in self.bodies:
            poses[body].partials, poses[body].column = (), None

    def gaps(self, poses: Mapping[str, Pose]) -> Array:
        """Return by how much the loops do not close, (..., 2 loops)."""
        return _real([a.point(p) - b.point(q) for a, p, b, q in self._ends(poses)])

    def jacobian(self, poses: Mapping[str, Pose]) -> Array:
        """Return the gaps' derivatives by the coordinates, (..., 2 loops, k)."""
        count = len(self.members)
        partials = [
            (a.point_partials(p, count), b.point_partials(q, count))
            for a, p, b, q in self._ends(poses)
        ]
        columns = _real([one[k] - other[k] for k in range(count) for one, other in partials])
        return columns.reshape(*columns.shape[:-1], count, -1).swapaxes(-1, -2)

    def move(self, poses: Mapping[str, Pose], inverse: Array) -> tuple[Array, Array]:
        """Give the members their velocities and accelerations by crank angle.

        Args:
            poses: of members and of all before them, the latter moving.
            inverse: of the Jacobian, (..., k, 2 loops).

        Returns:
            first and second derivatives of the coordinates by crank angle, (k, ...).
        """
        for member in self.members:
            if member.direction is None:
                poses[member.body].z1 = poses[member.before].velocity(member.point_before)
        gaps = _real([a.velocity(p) - b.velocity(q) for a, p, b, q in self._ends(poses)])
        u_1 = -_times(inverse, gaps)
        for member, rate in zip(self.members, u_1, strict=True):
            pose = poses[member.body]
            pose.z1 = pose.z1 + sum(s * r for s, r in zip(pose.partials, u_1, strict=True))
            pose.w = rate if member.direction is None else 0.0
        for member in self.members:
            if member.direction is None:
                pose = poses[member.body]
                swing = pose.w * pose.w * (pose.e * member.point)
                pose.z2 = poses[member.before].acceleration(member.point_before) + swing
        gaps = _real([a.acceleration(p) - b.acceleration(q) for a, p, b, q in self._ends(poses)])
        u_2 = -_times(inverse, gaps)
        for member, alpha in zip(self.members, u_2, strict=True):
            pose = poses[member.body]
            pose.z2 = pose.z2 + sum(s * t for s, t in zip(pose.partials, u_2, strict=True))
            pose.a = alpha if member.direction is None else 0.0
        self.settle(poses)
        return u_1, u_2

    def _ends(self, poses: Mapping[str, Pose]) -> Iterator[tuple[Pose, complex, Pose, complex]]:
        for loop in self.loops:
            (a, b), (p, q) = loop.bodies, loop.points
            yield poses[a], p, poses[b], q


def _real(values: Sequence[Number]) -> Array:
    """Return complex numbers, or arrays (n,) of them, as real ones side by side, (..., 2 m)."""
    arrays = np.broadcast_arrays(*values)
    stacked = np.empty((*arrays[0].shape, len(arrays)), complex)
    for index, array in enumerate(arrays):
        stacked[..., index] = array
    return stacked.view(float)


def _times(inverse: Array, gaps: Array) -> Array:
    """Return the products of matrices (..., k, m) and vectors (..., m) as (k, ...)."""
    return np.moveaxis((inverse @ gaps[..., None])[..., 0], -1, 0)


def known_bodies(drawing: Drawing) -> dict[str, Pose]:
    """Return frame and crank in the drawing."""
    _, centre, angle = next(body for body in drawing.bodies if body[0] == drawing.crank)
    return {drawing.frame: Pose(0.0, 0.0), drawing.crank: Pose(centre, angle)}


def groups_of(drawing: Drawing) -> tuple[list[Group], list[str]]:
    """Return a mechanism's groups, and the bodies that nothing holds when the crank is held."""
    poses = known_bodies(drawing)
    left = [name for name, _, _ in drawing.bodies if name not in poses]
    groups: list[Group] = []
    while left:
        group = next(_closed_groups(drawing, poses, left), None)
        if group is None:
            return groups, left
        group.place(poses, group.drawn())
        group.settle(poses)
        left = [name for name in left if name not in group.bodies]
        groups.append(group)
    return groups, []


def one_group_of(drawing: Drawing) -> Group:
    """Return all bodies but the crank as one group (`groups_of` has left none)."""
    poses = known_bodies(drawing)
    names = [name for name, _, _ in drawing.bodies if name not in poses]
    group = _group(drawing, poses, names)
    assert group is not None
    return group


def _closed_groups(
    drawing: Drawing, poses: Mapping[str, Pose], left: Sequence[str]
) -> Iterator[Group]:
    """Yield sets of bodies that the known ones hold, the smallest first."""
    neighbours: dict[str, set[str]] = {name: set() for name in left}
    for _, _, one, other in drawing.joints:
        if one in neighbours and other in neighbours:
            neighbours[one].add(other)
            neighbours[other].add(one)
    sizes = range(1, min(len(left), LARGEST_GROUP) + 1)
    sets = chain.from_iterable(_connected(left, neighbours, size) for size in sizes)
    for chosen in chain(sets, [left] if len(left) > LARGEST_GROUP else []):
        group = _group(drawing, poses, chosen)
        if group is not None and _holds(group, poses):
            yield group


def _connected(
    left: Sequence[str], neighbours: Mapping[str, set[str]], size: int
) -> Iterator[Sequence[str]]:
    found = {frozenset([name]) for name in left}
    for _ in range(size - 1):
        found = {
            chosen | {near} for chosen in found for name in chosen for near in neighbours[name]
        }
        found = {chosen for chosen in found if len(chosen) > 1}
    rank = {name: index for index, name in enumerate(left)}
    ordered = [sorted(names, key=rank.__getitem__) for names in found if len(names) == size]
    yield from sorted(ordered, key=lambda names: [rank[name] for name in names])


def _group(drawing: Drawing, poses: Mapping[str, Pose], chosen: Sequence[str]) -> Group | None:
    """Return bodies as a group, or None where there are too few loops or one hangs on nothing."""
    bodies = {name: (centre, angle) for name, centre, angle in drawing.bodies}
    guides = dict(drawing.guides)

    def local(body: str, at: complex) -> complex:
        if body == drawing.frame:
            return at
        centre, angle = bodies[body]
        return complex((at - centre) * np.exp(-1j * angle))

    inside = [
        joint
        for joint in drawing.joints
        if all(end in chosen or end in poses for end in joint[2:])
        and any(end in chosen for end in joint[2:])
    ]
    members = [
        _Member(name, *bodies[name], direction=guides[name]) for name in chosen if name in guides
    ]
    placed, hung = {member.body for member in members}, set()
    waiting = [name for name in chosen if name not in placed]
    while waiting:
        hook = next(
            (
                (joint, body, before)
                for joint in inside
                for body, before in (joint[2:], joint[:1:-1])
                if body in waiting and (before in placed or before in poses)
            ),
            None,
        )
        if hook is None:
            return None
        (name, at, _, _), body, before = hook
        members.append(
            _Member(
                body,
                *bodies[body],
                before=before,
                point_before=local(before, at),
                point=local(body, at),
            )
        )
        placed.add(body)
        hung.add(name)
        waiting.remove(body)
    loops = tuple(
        _Loop((one, other), (local(one, at), local(other, at)))
        for name, at, one, other in inside
        if name not in hung
    )
    return Group(tuple(members), loops) if 2 * len(loops) >= len(members) else None


def _holds(group: Group, poses: Mapping[str, Pose]) -> bool:
    """Return whether the loops hold all members, in the drawing."""
    trial = dict(poses)
    group.place(trial, group.drawn())
    values = np.linalg.svd(group.jacobian(trial), compute_uv=False)
    return bool(values[-1] > INDEPENDENT)
