"""The ideal motion of a mechanism, found numerically: all constraints at once by Newton's method.

The crank is followed from the drawing over one revolution in steps as long as Newton's method finds
the next positions close to where the last ones point; a step that jumps, or crosses a position
where the constraints' Jacobian is singular, is halved. Between these knots a quintic polynomial
through position, velocity and acceleration starts Newton's method for any number of crank angles at
once. Velocities and accelerations come from the same Jacobian, not from differences. Redundant
constraints are kept by least squares.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.mechanism.groups import groups_of
from exu_press.mechanism.motion import Motion
from exu_press.mechanism.parts import PRECISION, Point
from exu_press.mechanism.planar_constraints import PlanarConstraints, null_space
from exu_press.numerics.arrays import Array

__all__ = ["Kinematics", "MotionError", "kinematics_of"]

LONGEST_STEP = math.radians(30.0)
SHORTEST_STEP = math.radians(1e-4)

STRAY = 0.1
"""Distance of a step's end from its prediction, rad or relative to the mechanism's size."""

CLOSED = 1e-14
"""Change of the coordinates, rad or relative to the size, that ends Newton's method."""

SLOW = 0.1
"""Part of the last change from which convergence is slow, and the Jacobian is inverted anew."""

STALE = 1e-3
"""First change from which it is, too."""

FURTHER_KNOTS = 361
"""Knots of a revolution once it is known, a degree apart."""

SINGULAR = 1e-6
"""Smallest singular value of the constraints, relative to the size, that counts as held."""

FAST = 30.0
"""Rate per crank angle from which a singular position is a dead centre, not a branching."""

ITERATIONS = 12

FREE, CRANK = slice(None, -3), slice(-3, None)
"""Coordinates that follow from those of the crank, which are the last."""

OPEN = 1e-2
"""Part of the largest gap with which a constraint does not agree with the others."""


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
    """Newton's method did not find the position at one of the angles, or constraints disagree."""

    def __init__(self, index: int = 0, gaps: Array | None = None) -> None:
        super().__init__()
        self.index, self.gaps = index, gaps


class Kinematics:
    """The ideal motion of one drawing.

    Raises:
        InputError: the drawing has another mobility than the crank's, or locks or branches at some
            crank angle.
    """

    def __init__(self, name: str, constraints: PlanarConstraints, shaft: Point) -> None:
        """Follow the crank over a revolution.

        Args:
            name: of the mechanism, for messages.
            constraints: of all bodies, the crank last; its shaft is none of them.
            shaft: where the crank turns, m.
        """
        self._name, self._constraints = name, constraints
        self._shaft = complex(*shaft) / constraints.size
        drawn = np.array(constraints.drawn)
        held = np.vstack([constraints.jacobian(drawn), np.eye(len(drawn))[CRANK]])
        loose = constraints.moving(null_space(held))
        if loose:
            raise MotionError(
                f"{name}: {_listed(loose)} can move although the crank stands still; allowed is "
                "one degree of freedom. Add the missing joint or guide. If none is missing, draw a "
                "position in which no two connected links lie in one line",
                loose,
            )
        self._angles, self._knots = self._follow(drawn)
        turned = (self._knots[-1, 0] - drawn) / (2.0 * math.pi)
        self._turns = np.round(turned)
        self._turns[0::3] = self._turns[1::3] = 0.0
        astray = np.abs(turned - self._turns)[None] / PRECISION
        if bodies := constraints.moving(astray, 1.0):
            raise MotionError(
                f"{name}: {_listed(bodies)} do not return to where they were after one revolution "
                "of the crank",
                bodies,
            )
        angles = np.union1d(self._angles, np.linspace(0.0, 2.0 * math.pi, FURTHER_KNOTS))
        self._inverses = None
        levels, self._inverses, _ = self._near(angles)
        self._angles, self._knots = angles, levels.swapaxes(0, 1)

    def motion(self, angle: Array, speed: float) -> dict[str, Motion]:
        """Return the motion of every body for crank angles (n,), rad, at constant speed, rad/s.

        Raises:
            InputError: links lock or branch at one of the angles.
        """
        levels, _, _ = self._near(np.asarray(angle, dtype=float))
        levels[..., 0::3] *= self._constraints.size
        levels[..., 1::3] *= self._constraints.size
        levels *= np.array([1.0, speed, speed**2])[:, None, None]
        return {
            name: Motion(*levels[..., 3 * number : 3 * number + 3])
            for number, name in enumerate(self._constraints.bodies)
        }

    def _near(self, angle: Array) -> tuple[Array, Array, Array]:
        """Return what `_at` does at crank angles (n,), from the knots around them."""
        turns = np.floor(angle / (2.0 * np.pi))
        within = angle - 2.0 * np.pi * turns
        knot = np.searchsorted(self._angles[1:-1], within, side="right") + 1
        levels = _between(self._angles, self._knots, knot, within)
        levels[0] += 2.0 * np.pi * turns[:, None] * self._turns
        inverses = None if self._inverses is None else self._inverses[knot]
        try:
            return self._at(angle, levels, inverses)
        except _LostError as lost:
            last = self._knots[knot[lost.index] - 1]
            raise self._refusal(lost, float(angle[lost.index]), last) from None

    def _follow(self, drawn: Array) -> tuple[Array, Array]:
        """Return the knots from 0 to a whole revolution: angles (k,), and levels (k, 3, 3 n)."""
        angle, step = 0.0, LONGEST_STEP
        last = np.array([drawn, 0.0 * drawn, 0.0 * drawn])
        try:
            last, _, jacobian = self._at(0.0, last)
            knots = {0.0: last}
            while angle < 2.0 * math.pi * (1.0 - 1e-12):
                step = min(step, 2.0 * math.pi - angle)
                predicted = last.copy()
                predicted[0] += step * last[1] + 0.5 * step**2 * last[2]
                predicted[1] += step * last[2]
                try:
                    levels, _, jacobian_after = self._at(angle + step, predicted)
                    strays = np.abs(levels - predicted)[0, ..., FREE].max(initial=0.0) > STRAY
                    if strays or np.linalg.slogdet(jacobian.T @ jacobian_after)[0] <= 0.0:
                        raise _LostError  # on another branch
                except _LostError:
                    step /= 2.0
                    if step < SHORTEST_STEP:
                        raise
                    continue
                angle, last, jacobian = angle + step, levels, jacobian_after
                knots[angle] = last
                step = min(2.0 * step, LONGEST_STEP)
        except _LostError as lost:
            raise self._refusal(lost, angle, last) from None
        return np.array(list(knots)), np.array(list(knots.values()))

    def _at(
        self, angle: float | Array, near: Array, inverse: Array | None = None
    ) -> tuple[Array, Array, Array]:
        """Return coordinates at crank angles (...), and two derivatives by them, (3, ..., 3 n).

        Args:
            angle: rad.
            near: levels (3, ..., 3 n) close to those that follow.
            inverse: of a Jacobian close to those there, (..., 3 n - 3, m).

        Returns:
            Levels, inverses and Jacobians (..., m, 3 n - 3).
        """
        levels = near.copy()
        x, y, drawn = self._constraints.drawn[CRANK]
        arm = (complex(x, y) - self._shaft) * np.exp(1j * np.asarray(angle))
        centres = self._shaft + arm, 1j * arm, -arm
        for level, centre, turned in zip(levels, centres, (drawn + angle, 1.0, 0.0), strict=True):
            level[..., -3], level[..., -2], level[..., -1] = centre.real, centre.imag, turned
        q, q_1, q_2 = levels
        constraints = self._constraints

        def jacobian_of_q() -> Array:
            return constraints.jacobian(q)[..., FREE]

        inverse = _correct(q, constraints.residuals, inverse, jacobian_of_q)
        gaps = np.abs(constraints.residuals(q))
        if gaps.max(initial=0.0) > PRECISION:
            index = int(np.argmax(gaps.max(axis=-1)))
            raise _LostError(index, gaps.reshape(-1, gaps.shape[-1])[index])
        jacobian = constraints.jacobian(q)
        free = jacobian[..., FREE]
        inverse = _correct(q_1, lambda rate: _product(jacobian, rate), inverse, lambda: free)
        gamma = constraints.rates(q, q_1)
        inverse = _correct(q_2, lambda a: gamma + _product(jacobian, a), inverse, lambda: free)
        return levels, inverse, free

    def _refusal(self, lost: _LostError, angle: float, last: Array) -> MotionError:
        """Return the error for a crank angle at which constraints cannot be followed.

        Args:
            lost: why.
            angle: that was reached, rad.
            last: levels (3, 3 n) there, or before.
        """
        constraints, jacobian = self._constraints, self._constraints.jacobian(last[0])
        jacobian[:, CRANK] = 0.0
        fast = float(np.abs(last[1]).max()) > FAST
        where = f"at crank angle {math.degrees(angle) % 360.0:.4g} deg"
        if lost.gaps is not None and not fast:
            open_rows = lost.gaps > OPEN * lost.gaps.max()
            bodies = constraints.moving(jacobian[open_rows])
            text = (
                f"joints and guides hold {_listed(bodies)} more than once and do not agree {where}."
                " Remove the redundant one, or draw parts that move alike exactly alike"
            )
        else:
            groups = list(groups_of(constraints, constraints.bodies[-1]))
            least = [np.linalg.svd(group.block(jacobian))[1][-1] for group in groups]
            bodies = groups[int(np.argmin(least))].bodies
            does = "lock: they reach no further" if fast else "lock or branch"
            text = f"{_listed(bodies)} {does} {where}"
        poses = last[0].reshape(-1, 3) * (constraints.size, constraints.size, 1.0)
        poses_of = dict(zip(constraints.bodies, poses, strict=True))
        return MotionError(f"{self._name}: {text}", bodies, angle, poses_of)


@lru_cache(maxsize=16)
def kinematics_of(name: str, constraints: PlanarConstraints, shaft: Point) -> Kinematics:
    """Return the kinematics of a drawing, which scenes that differ in their joints alone share."""
    return Kinematics(name, constraints, shaft)


def _correct(
    values: Array,
    residuals: Callable[[Array], Array],
    inverse: Array | None,
    jacobian: Callable[[], Array],
) -> Array:
    """Correct free coordinates (..., 3 n), or their rates, by Newton's method, in place.

    Args:
        values: of all coordinates, those of the crank known.
        residuals: (..., m) of the values.
        inverse: of a Jacobian near by; it is made anew while convergence is slow.
        jacobian: of the residuals, at the values now.

    Returns:
        The last inverse.
    """
    last = math.inf
    for iteration in range(ITERATIONS):
        if inverse is None:
            inverse = _inverse(jacobian())
        change = _product(inverse, residuals(values))
        values[..., FREE] -= change
        largest = float(np.abs(change).max(initial=0.0))
        slow = largest > SLOW * last
        if largest < CLOSED * max(1.0, float(np.abs(values).max())) or (largest < 1e-10 and slow):
            return inverse
        if slow or (iteration == 0 and largest > STALE):
            inverse = None
        last = largest
    raise _LostError(int(np.argmax(np.abs(change).max(axis=-1))))


def _inverse(jacobian: Array) -> Array:
    """Return inverses (..., n, m) of Jacobians (..., m, n), for least squares where m > n."""
    turned = jacobian.swapaxes(-1, -2)
    try:
        if jacobian.shape[-2] == jacobian.shape[-1]:
            inverse = np.linalg.inv(jacobian)
        else:
            inverse = np.linalg.inv(turned @ jacobian) @ turned
    except np.linalg.LinAlgError:
        sizes = np.linalg.svd(jacobian, compute_uv=False)[..., -1]
        raise _LostError(int(np.argmin(sizes))) from None
    size = np.sqrt((inverse**2).sum(axis=(-2, -1)))
    if not size.max() < 1.0 / SINGULAR:
        raise _LostError(int(np.argmax(size)))
    return np.asarray(inverse)


def _product(matrices: Array, vectors: Array) -> Array:
    return np.asarray((matrices @ vectors[..., None])[..., 0])


def _between(angles: Array, knots: Array, knot: NDArray[np.intp], at: Array) -> Array:
    """Return levels (3, n, 3 b) by the quintic polynomials that end at some knots (n,)."""
    width = (angles[knot] - angles[knot - 1])[:, None]
    x = (at - angles[knot - 1])[:, None] / width
    a, a_1, a_2 = (width**level * knots[knot - 1, level] for level in range(3))
    b, b_1, b_2 = (width**level * knots[knot, level] for level in range(3))
    c_2 = 0.5 * a_2
    gap, gap_1, gap_2 = b - a - a_1 - c_2, b_1 - a_1 - a_2, b_2 - a_2
    c_3 = 10.0 * gap - 4.0 * gap_1 + 0.5 * gap_2
    c_4 = -15.0 * gap + 7.0 * gap_1 - gap_2
    c_5 = 6.0 * gap - 3.0 * gap_1 + 0.5 * gap_2
    powers = np.polynomial.polynomial
    coefficients = np.array([a, a_1, c_2, c_3, c_4, c_5])
    return np.array(
        [
            powers.polyval(x, powers.polyder(coefficients, level), tensor=False) / width**level
            for level in range(3)
        ]
    )


def _listed(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
