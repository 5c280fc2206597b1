"""The ideal motion of a mechanism, found numerically: loop closure by Newton's method.

The crank is followed from the drawing over one revolution in steps as long as Newton's method finds
the next positions close to where the last ones point; a step that jumps, or crosses a position
where the loops' Jacobian is singular, is halved. Between these knots a quintic polynomial through
position, velocity and acceleration starts Newton's method for any number of crank angles at once.
Velocities and accelerations come from the same Jacobian, not from differences.
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.mechanism.assur import Drawing, Group, Pose, groups_of, known_bodies, one_group_of
from exu_press.mechanism.motion import Motion
from exu_press.numerics.arrays import Array

__all__ = ["Kinematics", "MotionError", "kinematics_of"]

LONGEST_STEP = math.radians(30.0)
SHORTEST_STEP = math.radians(1e-4)

STRAY = 0.1
"""Distance of a step's end from its prediction, rad or relative to the mechanism's size."""

CLOSED = 1e-13
"""Change of the coordinates, rad or relative to the size, that ends Newton's method."""

DISAGREE = 1e-9
"""Gap, relative to the size, that redundant loops may leave open."""

SINGULAR = 1e-6
"""Smallest singular value of a group's loops, relative to the size, that counts as held."""

FAST = 1e2
"""Rate per crank angle from which a singular position is a dead centre, not a branching."""

ITERATIONS = 12


class MotionError(InputError):
    """A drawing whose crank cannot turn through a revolution.

    Attributes:
        bodies: names of those that lock, branch or are not held.
        angle: of the crank from the drawing, where that happens, rad.
        poses: every body's (x, y, angle) at the last crank angle that was reached, in m and rad;
            empty where only the drawing itself is known.
    """

    def __init__(
        self,
        message: str,
        bodies: tuple[str, ...],
        angle: float = 0.0,
        poses: Mapping[str, Array] | None = None,
    ) -> None:
        """Say in the message which drawing, which bodies and where."""
        super().__init__(message)
        self.bodies, self.angle, self.poses = bodies, angle, dict(poses or {})


class _LostError(ArithmeticError):
    """Newton's method did not find a group's next position."""

    def __init__(self, group: Group, index: int = 0, *, apart: bool = False) -> None:
        super().__init__()
        self.group, self.index, self.apart = group, index, apart


class Kinematics:
    """The ideal motion of one drawing.

    Raises:
        InputError: the drawing has another mobility than the crank's, or locks or branches at some
            crank angle.
    """

    def __init__(self, name: str, drawing: Drawing, size: float) -> None:
        """Follow the crank over a revolution.

        Args:
            name: of the mechanism, for messages.
            drawing: lengths in m.
            size: the mechanism's, m.
        """
        self._name, self._size = name, size
        self._drawing = drawing = _scaled(drawing, size)
        self._shaft = next(
            at
            for _, at, *ends in drawing.joints
            if sorted(ends) == sorted((drawing.crank, drawing.frame))
        )
        self.groups, loose = groups_of(drawing)
        if loose:
            raise MotionError(
                f"{name}: {_listed(loose)} can move although the crank stands still; allowed is "
                "one degree of freedom. Add the missing joint or guide. If none is missing, draw a "
                "position in which no two connected links lie in one line",
                tuple(loose),
            )
        try:
            self._go_round()
        except InputError as refused:
            if all(group.square for group in self.groups):
                raise
            self.groups = [one_group_of(drawing)]  # loops may hold together what none does alone
            try:
                self._go_round()
            except InputError:
                raise refused from None

    def _go_round(self) -> None:
        """Follow the crank, and look at every half degree."""
        self._signs = [_sign(group, group.jacobian(self._drawn(group))) for group in self.groups]
        self._follow()
        self.motion(np.radians(np.arange(0.0, 360.0, 0.5)), 1.0)

    def _drawn(self, last: Group) -> dict[str, Pose]:
        """Return the drawing's poses up to a group, whose coordinates still count."""
        poses = known_bodies(self._drawing)
        for group in self.groups:
            group.place(poses, group.drawn())
            if group is last:
                break
            group.settle(poses)
        return poses

    def motion(self, angle: Array, speed: float) -> dict[str, Motion]:
        """Return the motion of every body for crank angles (n,), rad, at constant speed, rad/s.

        Raises:
            InputError: links lock or branch at one of the angles.
        """
        angle = np.asarray(angle, dtype=float)
        poses = self._crank(angle)
        turns = np.floor(angle / (2.0 * np.pi))
        within = angle - 2.0 * np.pi * turns
        for group, knots in zip(self.groups, self._knots, strict=True):
            u = _between(self._angles, knots, within)
            u += (knots[0][-1] - knots[0][0])[:, None] * turns
            try:
                inverse = self._close(group, poses, u)
            except _LostError as lost:
                raise self._refusal(lost, float(angle[lost.index]), knots[1]) from None
            group.move(poses, inverse)
        return {
            name: _motion(poses[name], len(angle), self._size, speed)
            for name, *_ in self._drawing.bodies
        }

    def _crank(self, angle: Any) -> dict[str, Pose]:
        """Return frame and crank, turning at unit speed."""
        drawing = self._drawing
        _, centre, drawn = next(body for body in drawing.bodies if body[0] == drawing.crank)
        arm = (centre - self._shaft) * np.exp(1j * angle)
        crank = Pose(self._shaft + arm, drawn + angle)
        crank.z1, crank.z2, crank.w = 1j * arm, -arm, 1.0
        return {drawing.frame: Pose(0.0, 0.0), drawing.crank: crank}

    def _follow(self) -> None:
        """Find the knots: coordinates and their derivatives from 0 to a whole revolution."""
        angle, step = 0.0, LONGEST_STEP
        drawn = [(group.drawn(), *np.zeros((2, len(group.members)))) for group in self.groups]
        try:
            states = self._step(0.0, drawn, 0.0)
        except _LostError as lost:
            raise self._refusal(lost, 0.0, np.zeros(1)) from None
        angles, found = [angle], [states]
        while angle < 2.0 * math.pi * (1.0 - 1e-12):
            step = min(step, 2.0 * math.pi - angle)
            try:
                states = self._step(angle + step, found[-1], step)
            except _LostError as lost:
                step /= 2.0
                if step < SHORTEST_STEP:
                    rates = found[-1][self.groups.index(lost.group)][1]
                    raise self._refusal(lost, angle, rates, found[-1]) from None
                continue
            angle += step
            step = min(2.0 * step, LONGEST_STEP)
            angles.append(angle)
            found.append(states)
        self._angles = np.array(angles)
        self._knots = [
            tuple(np.array([states[index][level] for states in found]) for level in range(3))
            for index in range(len(self.groups))
        ]
        for group, (u, _, _) in zip(self.groups, self._knots, strict=True):
            turned = u[-1] - u[0]
            turned -= 2.0 * math.pi * group.winding() * np.round(turned / (2.0 * math.pi))
            if np.abs(turned).max() > DISAGREE:
                raise MotionError(
                    f"{self._name}: {_listed(group.bodies)} do not return to where they were "
                    "after one revolution of the crank",
                    group.bodies,
                )

    def _step(
        self, angle: float, states: list[tuple[Array, Array, Array]], step: float
    ) -> list[tuple[Array, Array, Array]]:
        """Return the coordinates and derivatives of all groups one step on, or lose one."""
        poses, found = self._crank(angle), []
        for group, (u, u_1, u_2) in zip(self.groups, states, strict=True):
            predicted = u + step * u_1 + 0.5 * step**2 * u_2
            now = predicted.copy()
            inverse = self._close(group, poses, now)
            if np.abs(now - predicted).max() > STRAY:
                raise _LostError(group)
            found.append((now, *group.move(poses, inverse)))
        return found

    def _close(self, group: Group, poses: dict[str, Pose], u: Array) -> Array:
        """Bring coordinates (k,) or (k, n) to where the loops close; return the inverse there."""
        last = math.inf
        for _ in range(ITERATIONS):
            group.place(poses, u)
            jacobian = group.jacobian(poses)
            inverse = _inverse(group, jacobian)
            change = np.moveaxis((inverse @ group.gaps(poses)[..., None])[..., 0], -1, 0)
            u -= change
            largest = float(np.abs(change).max())
            if largest < CLOSED or (largest < 1e-10 and largest > 0.1 * last):
                break
            last = largest
        else:
            raise _LostError(group, int(np.argmax(np.abs(change).max(axis=0))))
        group.place(poses, u)
        gaps = np.abs(group.gaps(poses)).max(axis=-1)
        if gaps.max() > DISAGREE:
            raise _LostError(group, int(np.argmax(gaps)), apart=True)
        crossed = _sign(group, jacobian) != self._signs[self.groups.index(group)]
        if np.any(crossed):
            raise _LostError(group, int(np.argmax(crossed)))
        return inverse

    def _refusal(
        self,
        lost: _LostError,
        angle: float,
        rates: Array,
        states: Sequence[tuple[Array, Array, Array]] = (),
    ) -> MotionError:
        """Return the error for a position in which a group cannot be followed."""
        where = f"at crank angle {math.degrees(angle) % 360.0:.4g} deg"
        bodies = _listed(lost.group.bodies)
        if lost.apart and not lost.group.square:
            return MotionError(
                f"{self._name}: joints and guides hold {bodies} more than once and do not agree "
                f"{where}. Remove the redundant one, or draw parts that move alike exactly alike",
                lost.group.bodies,
                angle,
                self._places(angle, states),
            )
        fast = float(np.abs(rates).max()) > FAST
        does = "lock: they reach no further" if fast else "lock or branch"
        return MotionError(
            f"{self._name}: {bodies} {does} {where}",
            lost.group.bodies,
            angle,
            self._places(angle, states),
        )

    def _places(
        self, angle: float, states: Sequence[tuple[Array, Array, Array]]
    ) -> dict[str, Array]:
        """Return every body's (x, y, angle), m and rad, at a crank angle; none without states."""
        if not states:
            return {}
        poses = self._crank(angle)
        for group, (u, _, _) in zip(self.groups, states, strict=True):
            group.place(poses, u)
            group.settle(poses)
        return {
            name: np.array(
                [
                    self._size * poses[name].z.real,
                    self._size * poses[name].z.imag,
                    poses[name].angle,
                ]
            )
            for name, *_ in self._drawing.bodies
        }


@lru_cache(maxsize=64)
def kinematics_of(name: str, drawing: Drawing, size: float) -> Kinematics:
    """Return the kinematics of a drawing, which scenes that differ in their joints alone share."""
    return Kinematics(name, drawing, size)


def _scaled(drawing: Drawing, size: float) -> Drawing:
    """Return a drawing with lengths relative to a size."""
    return drawing._replace(
        bodies=tuple((name, centre / size, angle) for name, centre, angle in drawing.bodies),
        joints=tuple((name, at / size, one, other) for name, at, one, other in drawing.joints),
    )


def _inverse(group: Group, jacobian: Array) -> Array:
    """Return the inverse of a group's Jacobian; the pseudo-inverse where loops are redundant."""
    try:
        inverse = np.asarray(
            np.linalg.inv(jacobian) if group.square else np.linalg.pinv(jacobian), float
        )
    except np.linalg.LinAlgError:
        index = int(np.argmin(np.abs(np.linalg.svd(jacobian, compute_uv=False)[..., -1])))
        raise _LostError(group, index) from None
    size = np.sqrt((inverse**2).sum(axis=(-2, -1)))
    if not size.max() < 1.0 / SINGULAR:
        raise _LostError(group, int(np.argmax(size)))
    return inverse


def _sign(group: Group, jacobian: Array) -> Array:
    return np.sign(np.linalg.det(jacobian)) if group.square else np.array(1.0)


def _between(angles: Array, knots: tuple[Array, ...], at: Array) -> Array:
    """Return coordinates (k, n) by the quintic polynomials between the knots."""
    index = np.clip(np.searchsorted(angles, at, side="right") - 1, 0, len(angles) - 2)
    width = (angles[index + 1] - angles[index])[:, None]
    x = (at - angles[index])[:, None] / width
    (a, b), (a_1, b_1), (a_2, b_2) = (
        (width**level * part[index], width**level * part[index + 1])
        for level, part in enumerate(knots)
    )
    c_2 = 0.5 * a_2
    gap, gap_1, gap_2 = b - a - a_1 - c_2, b_1 - a_1 - a_2, b_2 - a_2
    c_3 = 10.0 * gap - 4.0 * gap_1 + 0.5 * gap_2
    c_4 = -15.0 * gap + 7.0 * gap_1 - gap_2
    c_5 = 6.0 * gap - 3.0 * gap_1 + 0.5 * gap_2
    found: NDArray[np.float64] = a + x * (a_1 + x * (c_2 + x * (c_3 + x * (c_4 + x * c_5))))
    return found.T.copy()


def _motion(pose: Pose, count: int, size: float, speed: float) -> Motion:
    """Return a body's motion in m, rad and s."""
    levels = []
    for z, angle, scale in (
        (pose.z, pose.angle, 1.0),
        (pose.z1, pose.w, speed),
        (pose.z2, pose.a, speed**2),
    ):
        values = np.empty((count, 3))
        values[:, 0], values[:, 1] = scale * size * np.real(z), scale * size * np.imag(z)
        values[:, 2] = scale * angle
        levels.append(values)
    return Motion(*levels)


def _listed(names: Any) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
