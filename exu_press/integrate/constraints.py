"""Constraint violation of a system, and the smallest change that removes it (projection).

Exudyn provides violations of positions, and of velocities where a constraint has a rate of its own.
But where a user function prescribes an offset, its rate is zero or need not be exact, and at
flexible bodies' rigid markers velocities are off the rates of the positions by a millionth of a
metre a second. Such rates are differenced from positions, a little ahead and behind.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.task import Task
from exu_press.numerics.arrays import Array
from exu_press.numerics.linear import Equations

__all__ = ["Constraints", "normalise"]

REDUNDANT = 1e-8
"""Singular value of constraints' directions of length 1, below which one repeats others."""

FAR_OFF = 0.1
"""Violation at the start, m over the length or rad, that is no matter of a drawing's digits: which
position is meant is not known."""


def normalise(directions: Array) -> tuple[Array, Array]:
    """Return constraints' directions of length 1, a row each, and what their lengths were.

    What is switched off keeps its zeros.
    """
    lengths = np.sqrt(np.square(directions).sum(axis=1))
    lengths[lengths == 0.0] = 1.0
    return directions / lengths[:, None], lengths


class Constraints:
    """The constraints of a system.

    Attributes:
        rates_not_provided: whether Exudyn does not provide the rates of some.
    """

    def __init__(self, task: Task) -> None:
        """Take the system."""
        system = task.system
        self._mbs, self._solver, self._data = system.mbs, task.solver, system.data
        self._current, self._start, self._length = system.current, system.start, system.length
        self._regularisation = task.tuning.regularisation
        self.rates_not_provided = system.rates_not_provided
        self._of_velocities: NDArray[np.bool_] | None = None

    @property
    def count(self) -> int:
        """Their number."""
        return len(self._current.multipliers)

    def of_velocities(self) -> NDArray[np.bool_]:
        """Return which of them hold velocities; the others hold positions."""
        if self._of_velocities is None:
            self._of_velocities = np.asarray(self._jacobian(0.0, 1.0).any(axis=1))
        return self._of_velocities

    def directions(self) -> Array:
        """Return the rate of each one's violation with the coordinates it holds, (count, n)."""
        return np.asarray(self._jacobian(1.0, 0.0) + self._jacobian(0.0, 1.0))

    def redundant(self) -> int:
        """Return how many of them are redundant where the step under way begins."""
        if not self.count:
            return 0
        positions = self._current.positions
        tried = np.array(positions)
        positions[:] = self._start.positions
        directions, _ = normalise(self.directions())
        positions[:] = tried
        active = directions[directions.any(axis=1)]
        return len(active) - int(np.linalg.matrix_rank(active, tol=REDUNDANT))

    def _jacobian(self, of_positions: float, of_velocities: float) -> Array:
        solver, size = self._solver, len(self._current.positions)
        jacobian = np.array(solver.GetSystemJacobian())
        solver.SetSystemJacobian(np.zeros((size + solver.GetODE1size() + self.count,) * 2))
        solver.ComputeJacobianAE(self._mbs, of_positions, of_velocities)
        rows = np.array(solver.GetSystemJacobian())[-self.count :, :size]
        solver.SetSystemJacobian(jacobian)
        return rows

    def violations(self, *, velocities: bool = False) -> Array:
        """Return by how much each is violated in the current state; or the rate, if it has one."""
        self._solver.ComputeAlgebraicEquations(self._mbs, velocityLevel=velocities)
        residual = np.array(self._solver.GetSystemResidual())
        return residual[len(residual) - self.count :]

    def refusal(self) -> str:
        """Return which constraint the start is too far off, by how much and the cure, or nothing.

        A start that is off by no more is moved (`exu_press.integrate.initial_conditions`).
        """
        if not self.count:
            return ""
        violations = np.where(self.of_velocities(), 0.0, np.abs(self.violations()))
        worst = int(violations.argmax())
        if violations[worst] <= FAR_OFF * max(1.0, self._length):
            return ""
        mbs, data = self._mbs, self._data
        owner = next(i for i in range(data.NumberOfObjects()) if worst in data.GetObjectLTGAE(i))
        item = mbs.GetObject(owner)
        return (
            f"the start is {violations[worst]:.2g} off what {item['name']} ({item['objectType']}) "
            f"holds, m or rad: allowed are {FAR_OFF} m or rad, or a tenth of the system's length; "
            "give positions of the bodies that fit"
        )

    def violation_rates(self, ahead: float) -> Array:
        """Return by how much velocities of the current state violate each constraint.

        Positions within a time (s) ahead are differenced where Exudyn provides no rates.
        """
        if not self.rates_not_provided:
            return self.violations(velocities=True)
        time, positions = self._data.GetTime(), self._current.positions
        now, here = np.array(positions), self.violations()
        beside = []
        for side in (ahead, -ahead):
            positions[:] = now + side * self._current.velocities
            self._data.SetTime(time + side)
            beside.append(self.violations())
        positions[:] = now
        self._data.SetTime(time)
        rates = (beside[0] - beside[1]) / (2.0 * ahead)
        return np.where(self.of_velocities(), here, rates)

    def projection(self, norm: Array, directions: Array) -> Callable[[Array], Array]:
        """Return a function of violations, (count, k): the least changes that undo them, (n, k).

        In a norm, (n, n); of constraints with directions of length 1, (count, n).
        """
        size = len(norm)
        try:
            changes = Equations(self.matrix(norm, directions)).solver_of_rows(size, len(directions))
        except np.linalg.LinAlgError:
            return lambda violations: np.full((size, violations.shape[1]), math.nan)
        return lambda violations: changes(violations)[:size]

    def matrix(self, mass: Array, directions: Array) -> Array:
        """Return [[M, C^T], [C, -regularisation]] of masses (n, n) and directions C (count, n).

        Euler parameters have no mass along themselves, where a constraint holds them: the masses
        alone cannot be inverted. The regularisation allows for redundant constraints.
        """
        size, count = len(mass), len(directions)
        matrix = np.zeros((size + count, size + count))
        matrix[:size, :size] = mass
        matrix[size:, :size] = directions
        matrix[:size, size:] = directions.T
        give = self._regularisation * np.square(directions).max() / np.diag(mass).max()
        np.fill_diagonal(matrix[size:, size:], -give or -1.0)
        return matrix
