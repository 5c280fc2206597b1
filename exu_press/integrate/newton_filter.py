"""Newton's matrix as a filter of errors, and the errors that rounding makes in it."""

import numpy as np

from exu_press.integrate.task import Task, inertia_factor
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
        self._solver, self._scales = task.solver, task.scales
        self._rounding = task.tuning.rounding
        self._size = len(task.system.current.accelerations)
        self._number = -1  # of the Jacobian at hand
        self._jacobian, self._equations = np.zeros((0, 0)), Equations(np.zeros((0, 0)))
        self._roundoff = -1.0  # of its constraints, m, once it was asked for

    def refresh(self) -> None:
        """Take the last Jacobian from the solver: of 70 unknowns that takes as long as a step."""
        number = int(self._solver.it.newtonJacobiCount)
        if number != self._number:
            self._number, self._roundoff = number, -1.0
            self._jacobian = np.asarray(self._solver.GetSystemJacobian())
            self._equations = Equations(self._jacobian)

    def roundoff_of_constraints(self) -> float:
        """Return how far rounded positions in constraints move a body, m.

        By far where a mechanism passes a position in which two of them are nearly redundant. As
        parallel cranks pass their change points, the last digit alone, 1.1e-16, was too little:
        steps took the rest for errors, and the shorter they became, the larger that was.
        """
        self.refresh()
        if self._roundoff < 0.0:
            size, count = len(self._jacobian), self._solver.GetAEsize()
            try:
                of_constraints = np.eye(size, count, count - size)
                moved = np.abs(self._equations.solve(of_constraints)[: self._size]).sum(axis=1)
            except np.linalg.LinAlgError:  # redundant constraints
                self._roundoff = 0.0
            else:
                self._roundoff = (
                    self._rounding * self._scales.length * self._scales.norm(moved.tolist())
                )
        return self._roundoff

    def filtered(self, change: list[float]) -> list[float]:
        """Return what the Jacobian at hand leaves of a change of all coordinates."""
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
