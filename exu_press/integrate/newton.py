"""What Newton's method is told: where to start, with which matrix, and what is too much to ask.

Exudyn starts every step from accelerations of zero, which costs an iteration a step in lubricated
motion and several where contact lasts. Here they go on as they did in the last step, and lasting
contacts start from the force that held them. So do constraints.

A thin film answers the last digit of a speed with newtons: no iteration balances forces better.

Euler parameters must have unit length, and the constraints' directions that Exudyn gives Newton's
method are right on the unit sphere only: where the expected state leaves it, an iteration that puts
the length right moves the body by as much, and what that leaves in the constraints alternates from
step to step, 1/(1 - spectral radius)^2 times as large in the accelerations. So the expected
accelerations are those that end on the sphere.
"""

import math
from contextlib import nullcontext
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.arrays import Array
from exu_press.integrate.settings import SAME, Task

__all__ = ["FlexibleJacobian", "Newton"]

BALANCE = 0.2
"""Of the tolerance, to which part of the usual forces Newton's method balances them."""

PATIENCE = 4
"""Newton iterations after which rounding is thought of; most steps take one or two."""

REACH = 2.0
"""Over the last step, how far ahead its rate of change is believed by the predictor."""


class Newton:
    """Extrapolates accelerations to the end of a step, and asks for no more than can be."""

    def __init__(self, task: Task) -> None:
        """Guide the solver of a task."""
        problem = task.problem
        self._solver, self._joints, self._scales = task.solver, problem.joints, task.scales
        self._part = BALANCE * task.tolerance
        self._rounding, self._kept_balance = task.tuning.rounding, task.tuning.kept_balance
        self._jacobian = FlexibleJacobian(task) if problem.modal_stiffness else None
        current = problem.current
        self._positions, self._velocities = current.positions, current.velocities
        self._accelerations, self._multipliers = current.accelerations, current.multipliers
        self._multipliers_before = problem.start.multipliers
        self._expected: Any = np.zeros(len(current.positions))
        self._change: Any = np.zeros(len(current.positions))
        # where they begin among the coordinates, their reference values, their displacements
        self._quaternions: list[tuple[int, list[float], Any]] = []
        for node in problem.nodes:
            if node.quaternion:
                first = node.start + node.size - 4
                four = slice(first, first + 4)
                reference: list[float] = problem.reference[four].tolist()
                self._quaternions.append((first, reference, current.positions[four]))
        self._ratio = self._beta = self._gamma = 0.0
        self._now: list[float] = []  # accelerations at the end of the last accepted step
        self._rate: list[float] = []  # of change, in the last step
        self._last = 0.0  # size of the last step, s
        self._given = 0.0  # Newton's absolute tolerance of the settings, N
        self._accepted = 0.0  # now, N

    def begin(self, accelerations: list[float]) -> None:
        """Be told of all coordinates' accelerations at the start, when the solver is ready."""
        solver = self._solver
        self._ratio = (1.0 - solver.alphaF) / (1.0 - solver.alphaM)
        self._beta, self._gamma = solver.newmarkBeta, solver.newmarkGamma
        self._given = self._accepted = solver.newton.absoluteTolerance
        self._now = accelerations

    def stepped(self, step: float, accelerations: list[float]) -> None:
        """Be told of all coordinates' accelerations at the end of an accepted step (s)."""
        before = self._now
        self._rate = [(accelerations[i] - before[i]) / step for i in range(len(before))]
        self._last, self._now = step, accelerations

    def before_residual(self, step: float, iteration: int) -> None:
        """Set what an iteration of a step (s) starts from, and where it may end."""
        if not iteration:
            self._advance(step)
            self._accept(self._begin_jacobian() * self._tolerance())
        elif iteration == 1 and self._jacobian is not None:
            self._jacobian.renew()
        elif iteration == PATIENCE and self._joints is not None:
            rounding = self._rounding * self._joints.damping * self._scales.speed
            self._accept(max(self._tolerance(), rounding))

    def _begin_jacobian(self) -> float:
        """Return how much less than usual may be left, with a kept Jacobian."""
        if self._jacobian is None:
            return 1.0
        self._jacobian.begin_try()
        return self._kept_balance if self._jacobian.kept else 1.0

    def _advance(self, step: float) -> None:
        """Add the expected accelerations to a state that was advanced without any.

        As Newton's method adds an increment of them.
        """
        values, rate, change = self._now, self._rate, self._change
        if rate:
            ahead = min(step, REACH * self._last)
            values = [values[i] + ahead * rate[i] for i in range(len(rate))]
        by_q = step * step * self._ratio * self._beta
        if self._quaternions:
            values = self._on_the_sphere(values, by_q)
        expected = self._expected
        expected[:] = values
        np.multiply(expected, by_q, out=change)
        self._positions += change
        np.multiply(expected, step * self._ratio * self._gamma, out=change)
        self._velocities += change
        self._accelerations[:] = expected
        self._multipliers[:] = self._multipliers_before

    def _on_the_sphere(self, values: list[float], by_q: float) -> list[float]:
        """Return expected accelerations with which Euler parameters have unit length.

        In floats: half as long as arrays of four take.
        """
        values = values.copy()
        for first, reference, displacement in self._quaternions:
            moved: list[float] = displacement.tolist()
            turned = [reference[k] + moved[k] + by_q * values[first + k] for k in range(4)]
            vector = np.array(turned)
            length = math.sqrt(float(vector.dot(vector)))
            longer = (1.0 / length - 1.0) / by_q
            for k in range(4):
                values[first + k] += longer * turned[k]
        return values

    def _tolerance(self) -> float:
        """Return to what Newton's method is to balance forces, N."""
        return self._part * self._scales.force or self._given

    def _accept(self, residual: float) -> None:
        """Let Newton's method end at a residual, N."""
        if residual != self._accepted:
            self._accepted = self._solver.newton.absoluteTolerance = residual


class FlexibleJacobian:
    """Newton's matrix of a system with flexible bodies, which are differentiated but once.

    M (1 - alpha_m)/(1 - alpha_f) + beta h^2 K + gamma h D, bordered by the constraints. Exudyn
    differentiates bodies in floating frames numerically, which takes as long as forty residuals.
    But stiffness and damping belong to modes, whose coordinates turn with the frame: they stay as
    they are. What the frame's motion adds to them is less than a hundredth of the inertia over a
    step. The masses, the clearance joints' slopes and the constraints' directions are those of the
    state at hand.

    To put the matrix together and factorise it takes nearly half of a step. So one serves several
    steps of one size; where an iteration with it does not balance the forces, the next one gets a
    fresh one. Without clearance joints steps are long, and the constraints' directions change too
    much from one to the next.

    Attributes:
        kept: whether the step under way is tried with that of an earlier one.
    """

    def __init__(self, task: Task) -> None:
        """Let the solver of a task take this Jacobian instead of its own."""
        self._iteration: Any = task.solver.it
        self._convergence: Any = task.solver.conv
        self._joints = task.problem.joints
        self.kept = False
        self._most = 0 if self._joints is None else task.tuning.jacobian_steps
        self._step, self._age = 0.0, 0  # the step that the last one was made for, and steps since
        self._bodies: Array | None = None
        self._factors = 0.0, 0.0  # of stiffness and damping, and what they make of them
        self._combined: Array = np.zeros((0, 0))
        self._jacobian: Array = np.zeros((0, 0))
        task.solver.SetUserFunctionComputeNewtonJacobian(task.problem.mbs, self._compute)

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
        if (by_q, by_q_t) != self._factors:
            self._factors = by_q, by_q_t
            self._combined = np.dot(self._factors, self._bodies).reshape(size, size)
        bodies += self._combined
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
