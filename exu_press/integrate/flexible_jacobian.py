"""Newton's matrix of a system with flexible bodies, whose stiffness is differentiated but once.

Exudyn differentiates bodies in floating frames numerically, which takes as long as forty residuals.
But stiffness and damping belong to modes, whose coordinates turn with the frame: they stay as they
are. What the frame's motion adds to them is less than a hundredth of the inertia over a step. The
masses, the clearance joints' slopes and the constraints' directions are those of the state at hand.

To put the matrix together and factorise it takes nearly half of a step. So one serves several steps
of one size; where an iteration with it does not balance the forces, the next one gets a fresh one.
Without clearance joints steps are long, and the constraints' directions change too much from one to
the next.
"""

from contextlib import nullcontext
from typing import Any

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.settings import Tuning
from exu_press.joints.overlay import JointOverlay

__all__ = ["FlexibleJacobian"]

Array = NDArray[np.float64]

SAME = 1e-6
"""Steps that differ by less, relative, are one size: the clock's last digits."""


class FlexibleJacobian:
    """M (1 - alpha_m)/(1 - alpha_f) + beta h^2 K + gamma h D, bordered by the constraints.

    Attributes:
        kept: whether the step under way is tried with that of an earlier one.
    """

    def __init__(
        self, mbs: exu.MainSystem, solver: Any, joints: JointOverlay | None, tuning: Tuning
    ) -> None:
        """Let a solver take this Jacobian instead of its own.

        Args:
            mbs: the system.
            solver: an exu.MainSolverImplicitSecondOrder.
            joints: the system's clearance joints, if it has any.
            tuning: numbers.
        """
        self._iteration: Any = solver.it
        self._convergence: Any = solver.conv
        self._joints = joints
        self.kept = False
        self._most = 0 if joints is None else tuning.jacobian_steps
        self._step, self._age = 0.0, 0  # the step that the last one was made for, and steps since
        self._bodies: Array | None = None
        self._jacobian: Array = np.zeros((0, 0))
        solver.SetUserFunctionComputeNewtonJacobian(mbs, self._compute)

    def begin_try(self) -> None:
        """Choose whether the step that is about to be tried starts with the one there is."""
        step = self._iteration.currentStepSize
        same = abs(step - self._step) <= SAME * step
        self.kept = same and self._age < self._most
        self._age += 1
        self._convergence.jacobianUpdateRequested = not self.kept

    def renew(self) -> None:
        """Let the next iteration of the step have a fresh one, if it was tried with a kept one."""
        if self.kept:
            self._convergence.jacobianUpdateRequested = True

    def _compute(self, solver: Any, mbs: exu.MainSystem, settings: exu.SimulationSettings) -> bool:
        """Give the solver its Jacobian in the current state; return that this went well."""
        size = solver.GetODE2size()
        if self._bodies is None:
            self._bodies = self._differentiated(solver, mbs)
            self._jacobian = np.zeros((size + solver.GetAEsize(),) * 2)
        step, jacobian = solver.it.currentStepSize, self._jacobian
        self._step, self._age = step, 0
        by_q, by_q_t = solver.newmarkBeta * step * step, solver.newmarkGamma * step
        inertia = (1.0 - solver.alphaM) / (1.0 - solver.alphaF)
        bodies = jacobian[:size, :size]
        np.multiply(solver.GetSystemMassMatrix(), inertia, out=bodies)
        bodies += np.dot((by_q, by_q_t), self._bodies).reshape(size, size)
        if self._joints is not None:
            self._joints.add_slopes(jacobian, by_q, by_q_t)
        solver.SetSystemJacobian(jacobian)
        solver.ComputeJacobianAE(mbs, 1.0, by_q_t / by_q)  # adds the constraints
        return True

    def _differentiated(self, solver: Any, mbs: exu.MainSystem) -> Array:
        """Return stiffness and damping of all but the clearance joints, a row each."""
        size, found = solver.GetODE2size(), []
        with nullcontext() if self._joints is None else self._joints.left_out():
            for factors in ((-1.0, 0.0), (0.0, -1.0)):
                solver.ComputeJacobianODE2RHS(mbs, *factors)
                found.append(np.array(solver.GetSystemJacobian())[:size, :size].ravel())
        return np.array(found)
