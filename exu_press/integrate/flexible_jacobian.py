"""Newton's matrix of a system with flexible bodies, whose stiffness is differentiated but once.

Exudyn differentiates bodies in floating frames numerically, which takes as long as forty residuals.
But stiffness and damping belong to modes, whose coordinates turn with the frame: they stay as they
are. What the frame's motion adds to them is less than a hundredth of the inertia over a step. The
masses, the clearance joints' slopes and the constraints' directions are those of the state at hand.
"""

from contextlib import nullcontext
from typing import Any

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.joints.overlay import JointOverlay

__all__ = ["FlexibleJacobian"]

Array = NDArray[np.float64]


class FlexibleJacobian:
    """M (1 - alpha_m)/(1 - alpha_f) + beta h^2 K + gamma h D, bordered by the constraints."""

    def __init__(self, mbs: exu.MainSystem, solver: Any, joints: JointOverlay | None) -> None:
        """Let a solver take this Jacobian instead of its own.

        Args:
            mbs: the system.
            solver: an exu.MainSolverImplicitSecondOrder.
            joints: the system's clearance joints, if it has any.
        """
        self._joints = joints
        self._bodies: Array | None = None
        self._jacobian: Array = np.zeros((0, 0))
        solver.SetUserFunctionComputeNewtonJacobian(mbs, self._compute)

    def _compute(self, solver: Any, mbs: exu.MainSystem, settings: exu.SimulationSettings) -> bool:
        """Give the solver its Jacobian in the current state; return that this went well."""
        size = solver.GetODE2size()
        if self._bodies is None:
            self._bodies = self._differentiated(solver, mbs)
            self._jacobian = np.zeros((size + solver.GetAEsize(),) * 2)
        step, jacobian = solver.it.currentStepSize, self._jacobian
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
