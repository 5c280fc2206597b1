"""Newton's matrix as a filter of errors, and the errors of positions in constraints."""

import exudyn as exu
import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.task import Task, inertia_factor
from exu_press.numerics.arrays import Array
from exu_press.numerics.linear import Equations

__all__ = ["NewtonFilter"]


class NewtonFilter:
    """The last Jacobian of a task's solver: M (1 - alpha_m)/(1 - alpha_f) + ..., with constraints.

    Constraints, films and contacts undo within the step what it does not let through (L. F.
    Shampine's filter for stiff systems, see Hairer and Wanner, Solving Ordinary Differential
    Equations II, IV.8).
    """

    def __init__(self, task: Task) -> None:
        """Take a task."""
        self._solver, self._scales, self._constraints = task.solver, task.scales, Constraints(task)
        self._rounding, self._data = task.tuning.rounding, task.system.data
        self._positions = task.system.current.positions
        self._size = len(self._positions)
        self._number = -1  # of the Jacobian at hand
        self._jacobian, self._equations = np.zeros((0, 0)), Equations(np.zeros((0, 0)))
        self._roundoff = -1.0  # of its constraints, m, once it was asked for
        self._start: list[float] = []  # where the step begins, before any shift

    def begin_step(self) -> None:
        """Take the current state as a step's beginning."""
        self._start = self._positions.tolist()

    def _refresh(self) -> None:
        """Take the last Jacobian from the solver: of 70 unknowns that takes as long as a step."""
        number = int(self._solver.it.newtonJacobiCount)
        if number != self._number:
            self._number, self._roundoff = number, -1.0
            self._jacobian = np.asarray(self._solver.GetSystemJacobian())
            self._equations = Equations(self._jacobian)

    def roundoff_of_constraints(self) -> float:
        """Return how far inexact positions in constraints move a body, m, however short the step.

        Positions are rounded, and Newton's method left a violation of 1e-13 m or so where the step
        begins. That moves bodies by far where a mechanism passes a position in which two
        constraints are nearly redundant, as parallel cranks do at their change points. Steps took
        it for errors, and the shorter they became, the larger it was.
        """
        self._refresh()
        if self._roundoff < 0.0:
            size, count = len(self._jacobian), self._constraints.count
            inexact = self._rounding * self._scales.length + self._violations_at_start()
            try:
                of_constraints = np.eye(size, count, count - size)
                moved = np.abs(self._equations.solve(of_constraints)[: self._size]) @ inexact
            except np.linalg.LinAlgError:  # redundant constraints
                self._roundoff = 0.0
            else:
                self._roundoff = self._scales.norm(moved.tolist())
        return self._roundoff

    def _violations_at_start(self) -> Array:
        """Return by how much the step before left each constraint violated."""
        end, time = np.array(self._positions), self._data.GetTime()
        self._positions[:] = self._start
        self._data.SetTime(self._data.GetTime(exu.ConfigurationType.StartOfStep))
        violations = np.abs(self._constraints.violations())
        self._positions[:] = end
        self._data.SetTime(time)
        return violations

    def filter_change(self, change: list[float]) -> list[float]:
        """Return what the last Jacobian leaves of a change of all coordinates."""
        self._refresh()
        solver, size = self._solver, self._size
        right = np.zeros(len(self._jacobian))
        inertia = np.dot(solver.GetSystemMassMatrix(), np.array(change))
        right[:size] = inertia * inertia_factor(solver)
        try:
            filtered = self._equations.solve(right)[:size]
        except np.linalg.LinAlgError:  # redundant constraints
            filtered = np.asarray(np.linalg.lstsq(self._jacobian, right, rcond=None)[0][:size])
        values: list[float] = filtered.tolist()
        return values
