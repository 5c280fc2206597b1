"""Consistent initial conditions: the start, moved to fit its constraints before the first step."""

import math
from collections.abc import Callable

import exudyn as exu
import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.task import Task
from exu_press.numerics.arrays import Array
from exu_press.numerics.linear import Equations

__all__ = ["ConsistentInitialization"]

ITERATIONS = 10
"""Iterations of Newton's method at most; two or three converge."""

FITS = 1e-14, 1e-6, 1e-6
"""Relative violation up to which positions, velocities and accelerations may be off before they
are moved: differences are rounded. Forces of constraints go as violations over the square of a
step: on a ton, 1e-13 m are 20 kN in a step of 0.1 us."""

SHRINKS = 0.5
"""Part of what is missing that two iterations leave at most; more is rounding. One may leave all:
Exudyn's directions of joints are those of Euler parameters of length 1, which the first one mends.
"""


class ConsistentInitialization:
    """Moves the start onto the constraints, as near to what it was as can be.

    Exudyn computes accelerations at the start for constraints that stand still. And a drawing with
    five digits is off its joints by micrometres, of which a first step of microseconds would make
    metres a second. What is missing is differenced along the motion that the start has.

    Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, VII.1 (consistent
    values of systems of index 3).
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Take the current state, from which a run starts; the solver has its mass matrix."""
        self._task, self._constraints = task, constraints
        self._data, self._current = task.system.data, task.system.current
        self._solver, self._mbs = task.solver, task.system.mbs
        self._start, self._ahead = task.start, task.tuning.look_ahead * task.largest
        self._length = task.system.length or 1.0
        self._q = np.array(self._current.positions)
        self._v = np.array(self._current.velocities)
        self._a = np.array(self._current.accelerations)

    def fit(self) -> tuple[Array, Array] | None:
        """Fit the start; return accelerations and what of their rate is prescribed, if any."""
        if not (self._task.system.nodes and self._constraints.count):
            return None
        self._linearise()
        self._held = ~self._constraints.of_velocities()
        moved = self._project_positions()
        rate = self._fit_rates(moved=moved)
        return self._a, rate

    def changes(self) -> tuple[float, float]:
        """Return by how much the start was moved, m, and its speeds changed, m/s."""
        system, scales = self._task.system, self._task.scales
        data, initial = system.data, exu.ConfigurationType.Initial
        moved = scales.norm((system.current.positions - data.GetODE2Coordinates(initial)).tolist())
        speeds = data.GetODE2Coordinates_t(initial)
        # a system at rest that a prescribed motion takes along has no speeds to be changed
        changes = system.current.velocities - speeds if speeds.any() else speeds
        return moved, scales.norm(changes.tolist())

    def _linearise(self) -> None:
        """Take masses and constraints' directions of the current state."""
        self._mass = np.array(self._solver.GetSystemMassMatrix())
        directions = self._constraints.directions()
        self._equations = Equations(self._constraints.matrix(self._mass, directions))

    def _project_positions(self) -> bool:
        """Move positions onto the constraints; return whether they were off."""
        last = earlier = math.inf
        for i in range(ITERATIONS):
            violations = np.where(self._held, self._violations(), 0.0)
            size = float(np.abs(violations).max())
            if size <= FITS[0] * self._length or size > SHRINKS * earlier:
                break
            last, earlier = size, last
            if i:
                self._solver.ComputeMassMatrix(self._mbs)
                self._linearise()
            self._q = self._q - self._least_change(violations)
        return last < math.inf

    def _set_state(self, time: float = 0.0) -> None:
        """Set the state after a time (s), with the accelerations of the start."""
        current = self._current
        current.positions[:] = self._q + time * self._v + 0.5 * time * time * self._a
        current.velocities[:] = self._v + time * self._a
        current.accelerations[:] = self._a
        self._data.SetTime(self._start + time)

    def _violations(self, time: float = 0.0) -> Array:
        """Return by how much each constraint is violated after a time (s)."""
        self._set_state(time)
        return self._constraints.violations()

    def _rates(self) -> tuple[Array, Array, Array]:
        """Return the first, second and third rate of change of the violations."""
        h = self._ahead
        now, after_1, after_2, after_3 = (self._violations(i * h) for i in range(4))
        first = (-11.0 * now + 18.0 * after_1 - 9.0 * after_2 + 2.0 * after_3) / (6.0 * h)
        second = (2.0 * now - 5.0 * after_1 + 4.0 * after_2 - after_3) / (h * h)
        return first, second, (after_3 - 3.0 * after_2 + 3.0 * after_1 - now) / (h * h * h)

    def _project(self, vector: Array, missing: Callable[[Array], Array], order: int) -> Array:
        """Return the nearest vector, in the kinetic norm, with which nothing is missing.

        Of velocities or accelerations, with a function for what the constraints' rates of an order
        are off by. A relative change by FITS is rounding, and so is one that does not shrink.
        """
        last = earlier = math.inf
        fits, least = FITS[order], self._roundoff(order)
        for _ in range(ITERATIONS):
            change = self._least_change(missing(vector))
            size = self._norm(change)
            if size <= max(least, fits * self._norm(vector - change)) or size > SHRINKS * earlier:
                break
            vector, last, earlier = vector - change, size, last
        return vector

    def _roundoff(self, order: int) -> float:
        """Return what rounding makes of a change that rates of this order ask for."""
        rounding = self._task.tuning.rounding * self._length / self._ahead**order
        return self._norm(self._least_change(np.full(len(self._held), rounding)))

    def _fit_rates(self, *, moved: bool) -> Array:
        """Let velocities and accelerations fit; return what of their rate constraints prescribe.

        Accelerations that fit are left alone, unless positions were moved: differences tell them to
        fewer digits. A rate that rounding may have made is none.
        """
        held, velocities, accelerations = self._held, self._v, self._a
        self._a = np.zeros_like(accelerations)

        def of_velocities(velocities: Array) -> Array:
            self._v = velocities
            return np.where(held, self._rates()[0], self._violations())

        def of_accelerations(accelerations: Array) -> Array:
            self._a = accelerations
            first, second, _ = self._rates()
            return np.where(held, second, first)

        self._v = self._project(velocities, of_velocities, 1)
        moved = moved or self._v is not velocities
        if moved or self._driven():
            start = self._free_accelerations() if moved else accelerations
            self._a = self._project(start, of_accelerations, 2)
        else:
            self._a = accelerations
        _, second, third = self._rates()
        rate = -self._least_change(np.where(held, third, second))
        self._set_state()
        return rate if self._norm(rate) > self._roundoff(3) else np.zeros_like(rate)

    def _driven(self) -> bool:
        """Return whether constraints change while nothing moves, as prescribed motions do."""
        now = self._violations()
        for i in range(1, 4):
            self._data.SetTime(self._start + i * self._ahead)
            if (self._constraints.violations() != now).any():
                return True
        return False

    def _free_accelerations(self) -> Array:
        """Return the accelerations of the forces in the state, if constraints stood still."""
        self._set_state()
        self._solver.ComputeODE2RHS(self._mbs)
        forces = np.array(self._solver.GetSystemResidual())[: len(self._q)]
        return self._solve(forces, np.zeros(len(self._held)))

    def _least_change(self, violations: Array) -> Array:
        """Return the least change to take away, in the kinetic norm, that undoes violations."""
        return self._solve(np.zeros(len(self._q)), violations)

    def _solve(self, forces: Array, violations: Array) -> Array:
        """Return the change that forces and violations ask for."""
        right = np.concatenate([forces, violations])
        try:
            return np.asarray(self._equations.solve(right)[: len(forces)])
        except np.linalg.LinAlgError:  # coordinates without mass
            least = np.linalg.lstsq(self._equations.matrix, right, rcond=None)[0]
            return np.asarray(least[: len(forces)])

    def _norm(self, vector: Array) -> float:
        return float(np.sqrt(abs(vector @ self._mass @ vector)))
