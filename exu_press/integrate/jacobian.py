"""Newton's matrix where Exudyn's own takes too long, or lacks a part."""

from contextlib import nullcontext
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.task import SAME, Task, inertia_factor
from exu_press.joints.guide_friction import guide_frictions
from exu_press.numerics.arrays import Array

__all__ = ["FlexibleJacobian", "FrictionJacobian"]


class FrictionJacobian:
    """Newton's matrix of a system in which guides rub in proportion to their constraints' forces.

    Exudyn's own, and behind it how friction changes with these multipliers.
    """

    def __init__(self, task: Task) -> None:
        """Let the solver of a task take this Jacobian instead of its own."""
        self._frictions = guide_frictions(task.system.mbs)
        task.solver.SetUserFunctionComputeNewtonJacobian(task.system.mbs, self._compute)

    def _compute(self, solver: Any, mbs: exu.MainSystem, settings: exu.SimulationSettings) -> bool:
        """Give the solver its Jacobian in the current state; return that this went well."""
        size, step = solver.GetODE2size(), solver.it.currentStepSize
        by_q, by_q_t = solver.newmarkBeta * step * step, solver.newmarkGamma * step
        solver.SetSystemJacobian(np.zeros((size + solver.GetAEsize(),) * 2))
        loads = settings.timeIntegration.computeLoadsJacobian
        solver.ComputeJacobianODE2RHS(mbs, -by_q, -by_q_t, computeLoadsJacobian=loads)
        jacobian = np.array(solver.GetSystemJacobian())
        jacobian[:size, :size] += inertia_factor(solver) * solver.GetSystemMassMatrix()
        for friction in self._frictions:
            rows, multiplier, partials = friction.multiplier_partials()
            jacobian[rows, size + multiplier] += partials
        solver.SetSystemJacobian(jacobian)
        solver.ComputeJacobianAE(mbs, 1.0, by_q_t / by_q)  # adds the constraints
        return True


STALE = 4
"""Newton iterations of a step after which all is differentiated again; most steps take one."""


class FlexibleJacobian:
    """Newton's matrix of a system with flexible bodies, which are differentiated but seldom.

    M (1 - alpha_m)/(1 - alpha_f) + beta h^2 K + gamma h D, bordered by the constraints. Exudyn
    differentiates bodies in floating frames numerically, which takes as long as forty residuals.
    But stiffness and damping belong to modes, whose coordinates turn with the frame. What its
    motion adds to them is less than a hundredth of the inertia over a step. What
    else has slopes that change, as a forming force that fades where the output comes to rest, shows
    by many iterations: all is differentiated again then.

    To assemble and factorise the matrix takes as long as two iterations. So one serves steps of one
    size until one of them needs a second iteration, which it still serves; a third one, or the next
    step, gets a fresh one (modified Newton). Without clearance joints steps are long, and the
    constraints' directions change too much for that.
    """

    def __init__(self, task: Task) -> None:
        """Let the solver of a task take this Jacobian instead of its own."""
        self._convergence: Any = task.solver.conv
        self._joints = task.system.joints
        self._serves = False  # whether it has balanced each step in one iteration
        self._is_reused = False  # whether the step under way is tried with that of an earlier one
        self._step = 0.0  # that the last one was made for
        self._bodies: Array | None = None
        self._factors = 0.0, 0.0  # of stiffness and damping, and what they make of them
        self._combined: Array = np.zeros((0, 0))
        self._jacobian: Array = np.zeros((0, 0))
        task.solver.SetUserFunctionComputeNewtonJacobian(task.system.mbs, self._compute)

    def begin(self, step: float) -> None:
        """Choose whether the step (s) about to be tried starts with the Jacobian there is."""
        self._is_reused = self._serves and abs(step - self._step) <= SAME * step
        self._convergence.jacobianUpdateRequested = not self._is_reused
        self._serves = self._joints is not None

    def request_if_stale(self, iterations: int) -> None:
        """Request a fresh one where a step has needed so many iterations so far."""
        if iterations > 1:
            self._serves = False
        if self._is_reused and iterations == 2:
            self._convergence.jacobianUpdateRequested = True
        if iterations == STALE:
            self._bodies = None
            self._convergence.jacobianUpdateRequested = True

    def _compute(self, solver: Any, mbs: exu.MainSystem, settings: exu.SimulationSettings) -> bool:
        """Give the solver its Jacobian in the current state; return that this went well."""
        size = solver.GetODE2size()
        if self._bodies is None:
            self._bodies = self._partial_derivatives(solver, mbs, settings)
            self._factors = 0.0, 0.0
            self._jacobian = np.zeros((size + solver.GetAEsize(),) * 2)
        step, jacobian = solver.it.currentStepSize, self._jacobian
        self._step = step
        by_q, by_q_t = solver.newmarkBeta * step * step, solver.newmarkGamma * step
        bodies = jacobian[:size, :size]
        np.multiply(solver.GetSystemMassMatrix(), inertia_factor(solver), out=bodies)
        if (by_q, by_q_t) != self._factors:
            self._factors = by_q, by_q_t
            self._combined = np.dot(self._factors, self._bodies).reshape(size, size)
        bodies += self._combined
        if self._joints is not None:
            self._joints.add_partials(jacobian, by_q, by_q_t)
        solver.SetSystemJacobian(jacobian)
        solver.ComputeJacobianAE(mbs, 1.0, by_q_t / by_q)  # adds the constraints
        return True

    def _partial_derivatives(
        self, solver: Any, mbs: exu.MainSystem, settings: exu.SimulationSettings
    ) -> Array:
        """Return stiffness and damping of all but the clearance joints, a row each."""
        loads = settings.timeIntegration.computeLoadsJacobian
        size, rows = solver.GetODE2size(), []
        with nullcontext() if self._joints is None else self._joints.left_out():
            for factors in ((-1.0, 0.0), (0.0, -1.0)):
                solver.ComputeJacobianODE2RHS(mbs, *factors, computeLoadsJacobian=loads)
                rows.append(np.array(solver.GetSystemJacobian())[:size, :size].ravel())
        return np.array(rows)
