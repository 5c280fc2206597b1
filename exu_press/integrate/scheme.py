"""Our parts of generalized-alpha: a step's first guess, and Newton's matrix.

`Newton` tells where Newton's method starts and where it ends, `FlexibleJacobian` its matrix where
bodies are flexible.
"""

import math
from contextlib import nullcontext
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.lasting import Lasting
from exu_press.integrate.settings import SAME, Task, inertia_factor
from exu_press.numerics.arrays import Array
from exu_press.numerics.floats import Floats

__all__ = ["FlexibleJacobian", "LastingJacobian", "Newton"]

BALANCE = 0.2
"""Part of the usual forces, over the tolerance, to which Newton's method balances them."""

BALANCE_NEARLY = 1e-3
"""The same without clearance joints where a Jacobian is kept, or constraints have other directions
in it than their positions, as at rigid markers of flexible bodies: an iteration leaves a hundredth
of what it finds, metres of constraints too, which the next step takes for accelerations. One with a
fresh Jacobian leaves next to nothing."""

LIGHTER = 10.0
"""Ratio of inertias up to which the same balance of forces does for all coordinates."""

PATIENCE = 4
"""Newton iterations after which rounding is thought of; most steps take one or two."""

STALE = 3
"""Newton iterations in which a kept Jacobian does not serve: one takes as long as ten."""

REACH = 2.0
"""Over the last step, how far ahead its rate of change is believed by the predictor."""


class Newton:
    """Extrapolates accelerations to the end of a step, and asks for no more than can be.

    Exudyn starts every step from accelerations of zero, which costs an iteration a step in
    lubricated motion and several where contact lasts. Here they go on as they did in the last step,
    and lasting contacts start from the force that held them. So do constraints.

    A thin film answers the last digit of a speed with newtons: no iteration balances forces better.
    And what is left of a force moves light coordinates most, as the slopes of a cable's ends: their
    accelerations, carried on from step to step, drifted until steps were too small by a thousand.
    So forces are balanced to as much less as the lightest inertia is below a tenth of the heaviest.

    Euler parameters must have unit length, and the constraints' directions that Exudyn gives
    Newton's method are right on the unit sphere only: where the expected state leaves it, an
    iteration that puts the length right moves the body by as much, and what that leaves in the
    constraints alternates from step to step, 1/(1 - spectral radius)^2 times as large in the
    accelerations. So the expected accelerations are those that end on the sphere.
    """

    def __init__(self, task: Task) -> None:
        """Guide the solver of a task."""
        problem = task.problem
        self._solver, self._joints, self._scales = task.solver, problem.joints, task.scales
        self._mbs, self._reference = problem.mbs, problem.reference
        self._smooth = problem.joints is None and not task.fixed
        self._rounding = task.tuning.rounding
        self._jacobian: FlexibleJacobian | LastingJacobian | None = None
        if problem.modal_stiffness:
            self._jacobian = FlexibleJacobian(task)
        elif not task.every_jacobian:
            self._jacobian = LastingJacobian(task)
        nearly = problem.joints is None and (problem.rigid_markers or not task.every_jacobian)
        self._part = (BALANCE_NEARLY if nearly else BALANCE) * task.tolerance
        current = problem.current
        self._state, self._multipliers = current, current.multipliers
        self._positions, self._velocities = Floats(current.positions), Floats(current.velocities)
        self._accelerations = Floats(current.accelerations)
        self._multipliers_before = problem.start.multipliers
        # where they begin among the coordinates, and their reference values
        self._quaternions: list[tuple[int, list[float]]] = []
        for node in problem.nodes:
            if node.quaternion:
                first = node.start + node.size - 4
                self._quaternions.append((first, problem.reference[first : first + 4].tolist()))
        self._ratio = self._beta = self._gamma = 0.0
        self._now: list[float] = []  # accelerations at the last step's end
        self._rate: list[float] = []  # of them, over that step
        self._last = 0.0  # size of the last step, s
        self._given = 0.0  # Newton's absolute tolerance of the settings, N
        self._accepted = 0.0  # now, N

    def begin(self) -> None:
        """Start from the current state, when the solver is ready."""
        solver = self._solver
        self._ratio = (1.0 - solver.alphaF) / (1.0 - solver.alphaM)
        self._beta, self._gamma = solver.newmarkBeta, solver.newmarkGamma
        self._given = self._accepted = solver.newton.absoluteTolerance
        if self._smooth:
            self._part *= min(1.0, LIGHTER * self._scales.lightest())
        self.start_again()

    def start_again(self) -> None:
        """Extrapolate from the current accelerations alone, as at a start or where they jumped."""
        self._now = self._accelerations.get()
        self._rate = [0.0 for _ in self._now]
        if self._jacobian is not None:
            self._jacobian.drop()

    def stepped(self, step: float) -> None:
        """Be told that the current state is the end of an accepted step (s)."""
        before, now = self._now, self._accelerations.get()
        self._rate = [(now[i] - before[i]) / step for i in range(len(now))]
        self._last, self._now = step, now

    def before_residual(self, step: float, iteration: int) -> None:
        """Set the start of the iteration of a step (s), and its limits."""
        if not iteration:
            self._advance(step)
            self._accept(self._tolerance())
            if self._jacobian is not None:
                self._jacobian.begin(step)
            return
        if self._jacobian is not None:
            self._jacobian.needed(iteration)
        if iteration == PATIENCE:
            self._accept(max(self._tolerance(), self._rounded()))

    def _rounded(self) -> float:
        """Return the rounding errors of forces, N: the last digits of the state."""
        if self._joints is not None:
            return self._rounding * self._joints.damping * self._scales.speed
        size, forces = self._residual()
        if not 0.0 < size < math.inf:
            return 0.0
        state = self._state.positions, self._multipliers
        before = [np.array(part) for part in state]
        for part, whole in zip(state, (before[0] + self._reference, before[1]), strict=True):
            part[0::2] += self._rounding * whole[0::2]
            part[1::2] -= self._rounding * whole[1::2]
        changed = np.linalg.norm(self._residual()[1] - forces)
        for part, as_it_was in zip(state, before, strict=True):
            part[:] = as_it_was
        return size * float(changed / np.linalg.norm(forces))

    def _residual(self) -> tuple[float, Array]:
        """Return the residual of the current state, N, as a whole and by coordinate.

        The latter are scaled with the step, but all alike.
        """
        solver = self._solver
        size = solver.ComputeNewtonResidual(self._mbs, self._mbs.sys["simulationSettings"])
        return size, np.array(solver.GetSystemResidual())

    def _advance(self, step: float) -> None:
        """Add the expected accelerations to a state that was advanced without any.

        As Newton's method adds an increment of them. With floats, as to call NumPy for a few takes
        longer than a step of Exudyn's.
        """
        now, rate, ahead = self._now, self._rate, min(step, REACH * self._last)
        expected = [rate[i] * ahead + now[i] for i in range(len(now))]
        by_q, by_v = step * step * self._ratio * self._beta, step * self._ratio * self._gamma
        positions, velocities = self._positions.get(), self._velocities.get()
        self._put_on_the_sphere(expected, positions, by_q)
        for i in range(len(expected)):
            position, velocity, change = positions[i], velocities[i], expected[i]
            positions[i] = position + by_q * change
            velocities[i] = velocity + by_v * change
        self._positions.set(positions)
        self._velocities.set(velocities)
        self._accelerations.set(expected)
        if len(self._multipliers):
            self._multipliers[:] = self._multipliers_before

    def _put_on_the_sphere(
        self, expected: list[float], positions: list[float], by_q: float
    ) -> None:
        """Change expected accelerations to those with which Euler parameters have unit length.

        Args:
            expected: accelerations, in SI.
            positions: before they are added.
            by_q: times accelerations, what is added to positions, s^2.
        """
        for first, reference in self._quaternions:
            turned: list[float] = []
            square = 0.0
            for k in range(4):
                value = positions[first + k] + (reference[k] + by_q * expected[first + k])
                turned.append(value)
                square += value * value
            longer = (1.0 / math.sqrt(square) - 1.0) / by_q
            for k in range(4):
                expected[first + k] += longer * turned[k]

    def _tolerance(self) -> float:
        """Return the limit of the residual in Newton's method, N."""
        return self._part * self._scales.force or self._given

    def _accept(self, residual: float) -> None:
        """Let Newton's method end at a residual, N."""
        if residual != self._accepted:
            self._accepted = self._solver.newton.absoluteTolerance = residual


class LastingJacobian:
    """Keeps Newton's matrix from step to step, while steps have one size and it serves.

    In large systems, and where it is differentiated through functions in Python, a Jacobian takes
    as long as ten iterations or more. A kept one may take three iterations; a fourth gets a fresh
    one, and the kept one has not served (`exu_press.integrate.lasting`).
    """

    def __init__(self, task: Task) -> None:
        """Look at the solver of a task."""
        self._convergence: Any = task.solver.conv
        self._lasting, self._kept = Lasting(), False

    def drop(self) -> None:
        """Be told that the solver's matrix was another one meanwhile: its factors are gone."""
        self._lasting.drop()

    def begin(self, step: float) -> None:
        """Choose whether the step (s) about to be tried starts with the Jacobian there is."""
        self._kept = self._lasting.serves(step)
        if not self._kept:
            self._convergence.jacobianUpdateRequested = True

    def needed(self, iterations: int) -> None:
        """Be told that a step has needed so many iterations so far."""
        if not self._kept:
            return
        if iterations == STALE:
            self._convergence.jacobianUpdateRequested = True
        elif iterations > STALE:
            self._kept = False
            self._lasting.failed()


class FlexibleJacobian:
    """Newton's matrix of a system with flexible bodies, which are differentiated but once.

    M (1 - alpha_m)/(1 - alpha_f) + beta h^2 K + gamma h D, bordered by the constraints. Exudyn
    differentiates bodies in floating frames numerically, which takes as long as forty residuals.
    But stiffness and damping belong to modes, whose coordinates turn with the frame: they stay as
    they are. What the frame's motion adds to them is less than a hundredth of the inertia over a
    step. The masses, the clearance joints' slopes and the constraints' directions are those of the
    state at hand.

    To put the matrix together and factorise it takes as long as two iterations. So one serves steps
    of one size until one of them needs a second iteration, which it still serves; a third one, or
    the next step, gets a fresh one. Without clearance joints steps are long, and the constraints'
    directions change too much from one to the next.
    """

    def __init__(self, task: Task) -> None:
        """Let the solver of a task take this Jacobian instead of its own."""
        self._convergence: Any = task.solver.conv
        self._joints = task.problem.joints
        self._serves = False  # whether it has balanced each step in one iteration
        self._kept = False  # whether the step under way is tried with that of an earlier one
        self._step = 0.0  # that the last one was made for
        self._bodies: Array | None = None
        self._factors = 0.0, 0.0  # of stiffness and damping, and what they make of them
        self._combined: Array = np.zeros((0, 0))
        self._jacobian: Array = np.zeros((0, 0))
        task.solver.SetUserFunctionComputeNewtonJacobian(task.problem.mbs, self._compute)

    def drop(self) -> None:
        """Be told that the solver's matrix was another one meanwhile: its factors are gone."""
        self._step = 0.0

    def begin(self, step: float) -> None:
        """Choose whether the step (s) about to be tried starts with the Jacobian there is."""
        self._kept = self._serves and abs(step - self._step) <= SAME * step
        self._convergence.jacobianUpdateRequested = not self._kept
        self._serves = self._joints is not None

    def needed(self, iterations: int) -> None:
        """Be told that a step has needed so many iterations so far."""
        if iterations > 1:
            self._serves = False
        if self._kept and iterations == 2:
            self._convergence.jacobianUpdateRequested = True

    def _compute(self, solver: Any, mbs: exu.MainSystem, settings: exu.SimulationSettings) -> bool:
        """Give the solver its Jacobian in the current state; return that this went well."""
        size = solver.GetODE2size()
        if self._bodies is None:
            self._bodies = self._differentiated(solver, mbs)
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

    def _differentiated(self, solver: Any, mbs: exu.MainSystem) -> Array:
        """Return stiffness and damping of all but the clearance joints, a row each."""
        size, found = solver.GetODE2size(), []
        with nullcontext() if self._joints is None else self._joints.left_out():
            for factors in ((-1.0, 0.0), (0.0, -1.0)):
                solver.ComputeJacobianODE2RHS(mbs, *factors)
                found.append(np.array(solver.GetSystemJacobian())[:size, :size].ravel())
        return np.array(found)
