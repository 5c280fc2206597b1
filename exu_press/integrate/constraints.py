"""Constraint violation of a system, and the smallest change that removes it.

Exudyn tells violations of positions, and of velocities where a constraint has a rate of its own.
But where a user function prescribes an offset and none its rate, Exudyn takes that for zero; where
another one gives the rate, it need not be exact (in Exudyn's contactCurveExample it is 4.4 for 1.4
pi, and each change of a step shook the system); and at flexible bodies' rigid markers velocities
are off the rates of the positions by a millionth of a metre a second. The rates of such systems are
found from positions, a little ahead and behind.

Where joints slide along cables, their places are unknowns beside the forces: a body that is off its
cable across it violates them, and one that is off along it has another place.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array
from exu_press.numerics.linear import Equations

__all__ = ["Constraints", "normalised"]

Flags = NDArray[np.bool_]

SWITCH = "activeConnector"
"""Parameter of an object by which it is switched on or off."""

GIVE = 1e-8
"""Compliance given to constraints, over that of the masses. Where two of them nearly say the same,
a hundredth of it made 5e-11 m of the last digits of positions, which contacts took for a motion."""

REDUNDANT = 1e-8
"""Singular value of constraints' directions of length 1, below which one repeats others."""

FAR_OFF = 0.1
"""Violation at the start, m over the length or rad, that is no matter of a drawing's digits: which
place is meant is not known."""

NEARBY = 1e-6
"""Change of a place along a cable that tells what constraints make of it, over the length."""


def normalised(directions: Array) -> tuple[Array, Array]:
    """Return constraints' directions of length 1, a row each, and what their lengths were.

    Newton's matrix has those of velocities over the step. What is switched off keeps its zeros.
    """
    lengths = np.sqrt(np.square(directions).sum(axis=1))
    lengths[lengths == 0.0] = 1.0
    return directions / lengths[:, None], lengths


class Constraints:
    """The constraints of a system.

    Attributes:
        untold: whether Exudyn does not tell the rates of some.
        shaken: by how much positions change at the start, (n,), where those that round are off by
            one, m or rad, one way or the other.
    """

    def __init__(self, task: Task) -> None:
        """Take the problem."""
        problem = task.problem
        self._mbs, self._solver, self._data = problem.mbs, task.solver, problem.data
        self._current, self._start = problem.current, problem.start
        self._places = list(problem.places)
        self.untold = problem.untold_rates
        self.shaken: Array = np.zeros(len(self._current.positions))
        self._prescribe: Callable[[float], object] | None = None
        self._length, self._nearby = problem.length, NEARBY * problem.length
        self._of_velocities: Flags | None = None
        # objects that may be switched off, and which were on when `switched` was last asked
        self._switches: list[int] | None = None
        self._active: list[bool] | None = None

    @property
    def count(self) -> int:
        """Their number."""
        return len(self._current.multipliers)

    def prescribed_by(self, function: Callable[[float], object]) -> None:
        """Call a function of time (s) that sets what they prescribe, wherever they are asked."""
        self._prescribe, self.untold = function, True

    def of_velocities(self) -> Flags:
        """Return which of them hold velocities; the others hold positions."""
        if self._of_velocities is None:
            self._of_velocities = np.asarray(self._jacobian(0.0, 1.0).any(axis=1))
        return self._of_velocities

    def switched(self) -> bool:
        """Return whether some have been switched on or off since this was last asked."""
        ask, before = self._mbs.GetObjectParameter, self._active
        if self._switches is None:
            self._switches = self._with_switches()
        self._active = [ask(number, SWITCH) for number in self._switches]
        if before is None or before == self._active:
            return False
        self._of_velocities = None
        return True

    def _with_switches(self) -> list[int]:
        """Return the numbers of the objects with constraints that may be switched off."""
        mbs, data = self._mbs, self._data
        numbers = range(data.NumberOfObjects() if self.count else 0)
        held = (number for number in numbers if len(data.GetObjectLTGAE(number)))
        return [number for number in held if SWITCH in mbs.GetObject(number)]

    def directions(self) -> Array:
        """Return the rate of each one's violation with the coordinates it holds, (count, n + p).

        Behind the n coordinates are the p places along cables: what these take is no violation.
        """
        with self._without_multipliers():
            of_coordinates = self._jacobian(1.0, 0.0) + self._jacobian(0.0, 1.0)
            return np.hstack([of_coordinates, self._of_places()])

    def redundant(self) -> int:
        """Return how many of them say the same as others, where the step under way begins."""
        if not self.count:
            return 0
        positions = self._current.positions
        tried = np.array(positions)
        positions[:] = self._start.positions
        directions, _ = normalised(self.directions())
        positions[:] = tried
        held = directions[directions.any(axis=1)]  # else switched off
        return len(held) - int(np.linalg.matrix_rank(held, tol=REDUNDANT))

    def _jacobian(self, of_positions: float, of_velocities: float) -> Array:
        solver, size = self._solver, len(self._current.positions)
        before = np.array(solver.GetSystemJacobian())
        solver.SetSystemJacobian(np.zeros((size + solver.GetODE1size() + self.count,) * 2))
        solver.ComputeJacobianAE(self._mbs, of_positions, of_velocities)
        found = np.array(solver.GetSystemJacobian())[-self.count :, :size]
        solver.SetSystemJacobian(before)
        return found

    def violated(self) -> Array:
        """Return by how much each is violated in the current state."""
        if not self._places:
            return self._evaluated()
        with self._without_multipliers():
            return self._evaluated()

    def far_off(self) -> str:
        """Return what the start is far off, by how much and the cure; nothing where it is not."""
        found = np.where(self.of_velocities(), 0.0, np.abs(self.violated()))
        worst = int(found.argmax())
        if found[worst] <= FAR_OFF * max(1.0, self._length):
            return ""
        mbs, data = self._mbs, self._data
        owner = next(i for i in range(data.NumberOfObjects()) if worst in data.GetObjectLTGAE(i))
        item = mbs.GetObject(owner)
        return (
            f"the start is {found[worst]:.2g} off what {item['name']} ({item['objectType']}) "
            f"holds, m or rad: allowed are {FAR_OFF} m or rad, or a tenth of the system's length; "
            "place the bodies so that it fits"
        )

    def _evaluated(self, *, velocities: bool = False) -> Array:
        """Return what Exudyn tells of the current state; or its rate, if it has one."""
        if self._prescribe is not None:
            self._prescribe(self._data.GetTime())
        self._solver.ComputeAlgebraicEquations(self._mbs, velocityLevel=velocities)
        return np.array(self._solver.GetSystemResidual())[-self.count :]

    def _of_places(self) -> Array:
        """Return the rate of each one's violation with the places, (count, p).

        Exudyn's own Jacobian has something else for one of these where a cable is bent.
        """
        multipliers, columns = self._current.multipliers, np.zeros((self.count, len(self._places)))
        for column, place in enumerate(self._places):
            here = multipliers[place]
            for side in (1.0, -1.0):
                multipliers[place] = here + side * self._nearby
                columns[:, column] += side * self._evaluated() / (2.0 * self._nearby)
            multipliers[place] = here
        return columns

    @contextmanager
    def _without_multipliers(self) -> Iterator[None]:
        """Let no force act along cables, where joints slide, as their balance is no constraint."""
        before = np.array(self._current.multipliers)
        self._current.multipliers[:] = 0.0
        yield
        self._current.multipliers[:] = before

    def violated_rates(self, ahead: float) -> Array:
        """Return by how much velocities of the current state violate each constraint.

        Args:
            ahead: time within which positions tell it where velocities do not, s.
        """
        if not (self.untold or self._places):
            return self._evaluated(velocities=True)
        time, positions = self._data.GetTime(), self._current.positions
        now, here = np.array(positions), self.violated()
        beside = []
        for side in (ahead, -ahead):
            positions[:] = now + side * self._current.velocities
            self._data.SetTime(time + side)
            beside.append(self.violated())
        positions[:] = now
        self._data.SetTime(time)
        rates = (beside[0] - beside[1]) / (2.0 * ahead)
        return np.where(self.of_velocities(), here, rates)

    def undone(self, norm: Array, directions: Array) -> Callable[[Array], Array]:
        """Return a function of violations, (count, k): the least changes that undo them, (n, k).

        Args:
            norm: (n, n), in which they are the least.
            directions: of the constraints, (count, n + p), of length 1.
        """
        size = len(norm)
        try:
            changes = Equations(self.matrix(norm, directions)).of_rows(size, len(directions))
        except np.linalg.LinAlgError:
            return lambda violated: np.full((size, violated.shape[1]), math.nan)
        return lambda violated: changes(violated)[:size]

    def matrix(self, mass: Array, directions: Array) -> Array:
        """Return [[M, C^T, 0], [C, -give, S], [0, S^T, 0]], the last of them for places.

        Euler parameters have no mass along themselves, where a constraint holds them: the masses
        alone cannot be inverted, with the constraints they can. The little give allows for
        constraints that say the same as others, or nothing.

        Args:
            mass: (n, n).
            directions: [C, S], (count, n + p).
        """
        size, (count, unknowns) = len(mass), directions.shape
        matrix = np.zeros((unknowns + count, unknowns + count))
        held = slice(size, size + count)
        matrix[:size, :size] = mass
        for others, of_these in (
            (slice(size), directions[:, :size]),
            (slice(size + count, None), directions[:, size:]),
        ):
            matrix[held, others] = of_these
            matrix[others, held] = of_these.T
        give = GIVE * np.square(directions).max() / np.diag(mass).max()
        np.fill_diagonal(matrix[held, held], -give or -1.0)
        return matrix
