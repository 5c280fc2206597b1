"""Newton's matrix as a filter of errors, and the errors that rounding makes in it."""

import numpy as np

from exu_press.integrate.lasting import Lasting
from exu_press.integrate.settings import LARGE, Task, inertia_factor
from exu_press.numerics.linear import Equations

__all__ = ["NewtonMatrix"]

EPSILON = 1.1e-16
"""Last digit of a number, over it."""

LARGER = 4.0
"""Over the kinetic energy of a change, from where that of the filtered one is of last digits."""


class NewtonMatrix:
    """The last Jacobian of a task's solver: M (1 - alpha_m)/(1 - alpha_f) + ..., with constraints.

    Constraints, films and contacts undo within the step what it does not let through (L. F.
    Shampine's filter for stiff systems, see Hairer and Wanner, Solving Ordinary Differential
    Equations II, IV.8).
    """

    def __init__(self, task: Task) -> None:
        """Take a task."""
        self._solver, self._scales = task.solver, task.scales
        self._joints = task.problem.joints
        self._size = len(task.problem.current.accelerations)
        self._made = -1  # Jacobians before the one at hand
        self._jacobian, self._equations = np.zeros((0, 0)), Equations(np.zeros((0, 0)))
        self._lasting = None if task.impacts or self._size < LARGE else Lasting()
        self._serves = False  # whether the one at hand is tried for the step under way

    def serves(self, step: float) -> bool:
        """Return whether the Jacobian at hand may do for a step, s."""
        if self._lasting is None:
            return False
        if self._serves:
            self._lasting.served()
        self._serves = self._lasting.serves(step)
        return self._serves

    def renew(self) -> bool:
        """Take the Jacobian from the solver; return whether it is another one than before.

        Of 70 unknowns that takes as long as a step, of 1300 as long as three. One that is asked for
        where that of an earlier step was tried tells that this has not served.
        """
        if self._serves and self._lasting is not None:
            self._serves = False
            self._lasting.failed()
        made = int(self._solver.it.newtonJacobiCount)
        another = made != self._made
        if another:
            self._made = made
            self._jacobian = np.asarray(self._solver.GetSystemJacobian())
            self._equations = Equations(self._jacobian)
        return another

    def left_in_constraints(self) -> float:
        """Return how far the last digits of constraints move a body, m.

        By far where a mechanism passes a position in which two of them nearly say the same.
        """
        size, count = self._size, self._solver.GetAEsize()
        self.renew()
        unknowns = len(self._jacobian)
        try:
            of_constraints = np.eye(unknowns, count, count - unknowns)
            moved = np.abs(self._equations.solve(of_constraints)[:size]).sum(axis=1)
        except np.linalg.LinAlgError:  # constraints that say the same
            return 0.0
        return EPSILON * self._scales.length * self._scales.norm(moved.tolist())

    def filtered(self, *changes: list[float]) -> list[list[float]]:
        """Return what the matrix at hand leaves of changes."""
        solver = self._solver
        before, mass = np.array(changes).T, solver.GetSystemMassMatrix()
        size = len(before)
        right = np.zeros((size + solver.GetODE1size() + solver.GetAEsize(), len(changes)))
        inertia = np.dot(mass, before)
        right[:size] = inertia * inertia_factor(solver)
        try:
            filtered = self._equations.solve(right)[:size]
            # masses and springs make nothing larger, but constraints that nearly say the same
            if self._joints is None:
                energy = np.vdot(filtered, np.dot(mass, filtered))
                same = not energy <= LARGER * np.vdot(before, inertia)
            else:
                same = False
        except np.linalg.LinAlgError:  # constraints that say the same
            same = True
        if same:
            filtered = np.asarray(np.linalg.lstsq(self._jacobian, right, rcond=None)[0][:size])
        found: list[list[float]] = filtered.T.tolist()
        return found
