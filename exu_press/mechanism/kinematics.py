"""The ideal motion of a mechanism: all constraints at once by Newton's method.

The crank is followed from the drawing over one revolution, each step predicted from the last one's
derivatives; a step that ends far from its prediction, or crosses a singular position, is halved.
Between these knots a quintic polynomial through position, velocity and acceleration starts Newton's
method for any number of crank angles at once. Velocities and accelerations come from the same
Jacobian, not from differences. Redundant constraints are satisfied by least squares.
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

PREDICTION_LIMIT = 0.1
"""Largest distance of a step's end from its prediction, rad or relative to the mechanism's size."""

NEWTON_TOLERANCE = 1e-14
"""Change of the coordinates, rad or relative to the size, that ends Newton's method."""

SLOW = 0.1
"""Change over the previous change, above which the Jacobian is inverted anew."""

STALE = 1e-3
"""First change above which it is inverted anew, too."""

REFINED_KNOTS = 361
"""Knots of a revolution after it has been followed once, a degree apart."""

SINGULAR = 1e-6
"""Smallest singular value of regular constraints, relative to the size."""

FAST = 30.0
"""Rate per crank angle above which a singular position is a dead centre, not a branching."""

ITERATIONS = 12

FREE, CRANK = slice(None, -3), slice(-3, None)
"""Columns of the free coordinates, and of the crank's, which are the last."""

OPEN = 1e-2
"""Residual over the largest one, above which a constraint contradicts the others."""


class MotionError(InputError):
    """A drawing whose crank cannot turn through a revolution.

    Attributes:
        bodies: names of those that lock, branch or are not held.
        angle: of the crank from the drawing, where that happens, rad.
        poses: name of a body -> (x, y, angle) at the last crank angle that was reached, m and rad;
            empty where only the drawing itself is known.
    """

    def __init__(
        self,
        message: str,
        bodies: tuple[str, ...],
        angle: float = 0.0,
        poses: Mapping[str, Array] | None = None,
    ) -> None:
        """Name in the message the drawing, the bodies and the position."""
        super().__init__(message)
        self.bodies, self.angle, self.poses = bodies, angle, dict(poses or {})


class _ConvergenceError(ArithmeticError):
    """Newton's method failed at the angle of an index, or with contradictory residuals (m,)."""

    def __init__(self, index: int = 0, residuals: Array | None = None) -> None:
        super().__init__()
        self.index, self.residuals = index, residuals


class Kinematics:
    """The ideal motion of one drawing.

    Raises:
        InputError: the drawing has more or fewer than one degree of freedom, or locks or branches
            at some crank angle.
    """

    def __init__(self, name: str, constraints: PlanarConstraints, shaft: Point) -> None:
        """Follow the crank over a revolution.

        Args:
            name: of the mechanism, for messages.
            constraints: of all bodies, the crank last; its shaft is none of them.
            shaft: position of the crank's shaft, m.
        """
        self._name, self._constraints = name, constraints
        self._shaft = complex(*shaft) / constraints.size
        drawn = np.array(constraints.drawn)
        fixed_crank = np.vstack([constraints.jacobian(drawn), np.eye(len(drawn))[CRANK]])
        loose = constraints.moving_bodies(null_space(fixed_crank))
        if loose:
            raise MotionError(
                f"{name}: {_list_names(loose)} can move although the crank stands still; allowed "
                "is one degree of freedom. Add the missing joint or guide. If none is missing, "
                "draw a position in which no two connected links lie in one line",
                loose,
            )
        self._angles, self._knots = self._follow(drawn)
        change = (self._knots[-1, 0] - drawn) / (2.0 * math.pi)
        self._turns = np.round(change)
        self._turns[0::3] = self._turns[1::3] = 0.0
        drift = np.abs(change - self._turns)[None] / PRECISION
        if bodies := constraints.moving_bodies(drift, 1.0):
            raise MotionError(
                f"{name}: {_list_names(bodies)} do not return to where they were after one "
                "revolution of the crank",
                bodies,
            )
        angles = np.union1d(self._angles, np.linspace(0.0, 2.0 * math.pi, REFINED_KNOTS))
        self._inverses = None
        levels, self._inverses, _ = self._solve_from_knots(angles)
        self._angles, self._knots = angles, levels.swapaxes(0, 1)

    def motion(self, angle: Array, speed: float) -> dict[str, Motion]:
        """Return the motion of every body for crank angles (n,), rad, at constant speed, rad/s.

        Raises:
            InputError: links lock or branch at one of the angles.
        """
        levels, _, _ = self._solve_from_knots(np.asarray(angle, dtype=float))
        levels[..., 0::3] *= self._constraints.size
        levels[..., 1::3] *= self._constraints.size
        levels *= np.array([1.0, speed, speed**2])[:, None, None]
        return {
            name: Motion(*levels[..., 3 * number : 3 * number + 3])
            for number, name in enumerate(self._constraints.bodies)
        }

    def _solve_from_knots(self, angle: Array) -> tuple[Array, Array, Array]:
        """Return the results of `_solve` at crank angles (n,), guessed from the knots."""
        turns = np.floor(angle / (2.0 * np.pi))
        in_turn = angle - 2.0 * np.pi * turns
        knot = np.searchsorted(self._angles[1:-1], in_turn, side="right") + 1
        levels = _interpolate(self._angles, self._knots, knot, in_turn)
        levels[0] += 2.0 * np.pi * turns[:, None] * self._turns
        inverses = None if self._inverses is None else self._inverses[knot]
        try:
            return self._solve(angle, levels, inverses)
        except _ConvergenceError as error:
            last = self._knots[knot[error.index] - 1]
            raise self._motion_error(error, float(angle[error.index]), last) from None

    def _follow(self, drawn: Array) -> tuple[Array, Array]:
        """Return the knots from 0 to a whole revolution: angles (k,), and levels (k, 3, 3 n)."""
        angle, step = 0.0, LONGEST_STEP
        last = np.array([drawn, 0.0 * drawn, 0.0 * drawn])
        try:
            last, _, jacobian = self._solve(0.0, last)
            knots = {0.0: last}
            while angle < 2.0 * math.pi * (1.0 - 1e-12):
                step = min(step, 2.0 * math.pi - angle)
                predicted = last.copy()
                predicted[0] += step * last[1] + 0.5 * step**2 * last[2]
                predicted[1] += step * last[2]
                try:
                    levels, _, new_jacobian = self._solve(angle + step, predicted)
                    distance = np.abs(levels - predicted)[0, ..., FREE].max(initial=0.0)
                    sign = np.linalg.slogdet(jacobian.T @ new_jacobian)[0]
                    if distance > PREDICTION_LIMIT or sign <= 0.0:
                        raise _ConvergenceError  # on another branch
                except _ConvergenceError:
                    step /= 2.0
                    if step < SHORTEST_STEP:
                        raise
                    continue
                angle, last, jacobian = angle + step, levels, new_jacobian
                knots[angle] = last
                step = min(2.0 * step, LONGEST_STEP)
        except _ConvergenceError as error:
            raise self._motion_error(error, angle, last) from None
        return np.array(list(knots)), np.array(list(knots.values()))

    def _solve(
        self, angle: float | Array, guess: Array, inverse: Array | None = None
    ) -> tuple[Array, Array, Array]:
        """Return coordinates at crank angles (...), and two derivatives by them, (3, ..., 3 n).

        Args:
            angle: rad.
            guess: first guess of these levels, (3, ..., 3 n).
            inverse: first guess of the inverse Jacobians, (..., 3 n - 3, m).

        Returns:
            Levels, inverses and Jacobians (..., m, 3 n - 3).
        """
        levels = guess.copy()
        x, y, drawn = self._constraints.drawn[CRANK]
        arm = (complex(x, y) - self._shaft) * np.exp(1j * np.asarray(angle))
        centres = self._shaft + arm, 1j * arm, -arm
        for level, centre, turn in zip(levels, centres, (drawn + angle, 1.0, 0.0), strict=True):
            level[..., -3], level[..., -2], level[..., -1] = centre.real, centre.imag, turn
        q, q_1, q_2 = levels
        constraints = self._constraints

        def jacobian_of_q() -> Array:
            return constraints.jacobian(q)[..., FREE]

        inverse = _correct(q, constraints.residuals, inverse, jacobian_of_q)
        residuals = np.abs(constraints.residuals(q))
        if residuals.max(initial=0.0) > PRECISION:
            index = int(np.argmax(residuals.max(axis=-1)))
            raise _ConvergenceError(index, residuals.reshape(-1, residuals.shape[-1])[index])
        jacobian = constraints.jacobian(q)
        free = jacobian[..., FREE]
        inverse = _correct(q_1, lambda rate: _product(jacobian, rate), inverse, lambda: free)
        gamma = constraints.rates(q, q_1)
        inverse = _correct(q_2, lambda a: gamma + _product(jacobian, a), inverse, lambda: free)
        return levels, inverse, free

    def _motion_error(self, error: _ConvergenceError, angle: float, last: Array) -> MotionError:
        """Return the error for a crank angle, rad, with the last levels (3, 3 n) before it."""
        constraints, jacobian = self._constraints, self._constraints.jacobian(last[0])
        jacobian[:, CRANK] = 0.0
        fast = float(np.abs(last[1]).max()) > FAST
        where = f"at crank angle {math.degrees(angle) % 360.0:.4g} deg"
        if error.residuals is not None and not fast:
            open_rows = error.residuals > OPEN * error.residuals.max()
            bodies = constraints.moving_bodies(jacobian[open_rows])
            text = (
                f"constraints hold {_list_names(bodies)} more than once and do not agree "
                f"{where}. Remove the redundant one, or draw links that move alike exactly alike"
            )
        else:
            groups = list(groups_of(constraints, constraints.bodies[-1]))
            least = [np.linalg.svd(group.block(jacobian))[1][-1] for group in groups]
            bodies = groups[int(np.argmin(least))].bodies
            does = "lock: they reach no further" if fast else "lock or branch"
            text = f"{_list_names(bodies)} {does} {where}"
        poses = last[0].reshape(-1, 3) * (constraints.size, constraints.size, 1.0)
        poses_of = dict(zip(constraints.bodies, poses, strict=True))
        return MotionError(f"{self._name}: {text}", bodies, angle, poses_of)


@lru_cache(maxsize=16)
def kinematics_of(name: str, constraints: PlanarConstraints, shaft: Point) -> Kinematics:
    """Return the kinematics of a drawing; scenes that differ in masses or joints share it."""
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
        inverse: of a Jacobian nearby; it is renewed while convergence is slow.
        jacobian: of the residuals, at the present values.

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
        if largest < NEWTON_TOLERANCE * max(1.0, float(np.abs(values).max())) or (
            largest < 1e-10 and slow
        ):
            return inverse
        if slow or (iteration == 0 and largest > STALE):
            inverse = None
        last = largest
    raise _ConvergenceError(int(np.argmax(np.abs(change).max(axis=-1))))


def _inverse(jacobian: Array) -> Array:
    """Return inverses (..., n, m) of Jacobians (..., m, n), for least squares where m > n."""
    transposed = jacobian.swapaxes(-1, -2)
    try:
        if jacobian.shape[-2] == jacobian.shape[-1]:
            inverse = np.linalg.inv(jacobian)
        else:
            inverse = np.linalg.inv(transposed @ jacobian) @ transposed
    except np.linalg.LinAlgError:
        sizes = np.linalg.svd(jacobian, compute_uv=False)[..., -1]
        raise _ConvergenceError(int(np.argmin(sizes))) from None
    size = np.sqrt((inverse**2).sum(axis=(-2, -1)))
    if not size.max() < 1.0 / SINGULAR:
        raise _ConvergenceError(int(np.argmax(size)))
    return np.asarray(inverse)


def _product(matrices: Array, vectors: Array) -> Array:
    return np.asarray((matrices @ vectors[..., None])[..., 0])


def _interpolate(angles: Array, knots: Array, knot: NDArray[np.intp], angle: Array) -> Array:
    """Return levels (3, n, 3 b) at angles (n,), by quintic polynomials that end at knots (n,)."""
    width = (angles[knot] - angles[knot - 1])[:, None]
    x = (angle - angles[knot - 1])[:, None] / width
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


def _list_names(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
