"""Our parts of generalized-alpha: a step's first guess, Newton's matrix, the mass of modes.

`Newton` tells where Newton's method starts and where it ends, `FlexibleJacobian` its matrix where
bodies are flexible, `ModalMass` the mass with which their modes keep their frequencies.
"""

import math
from contextlib import nullcontext
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import ObjectGenericODE2, VObjectGenericODE2

from exu_press.integrate.problem import FLEXIBLE, MODES, modal_item
from exu_press.integrate.settings import SAME, Task, inertia_factor
from exu_press.numerics.arrays import Array

__all__ = ["FlexibleJacobian", "LastingJacobian", "ModalMass", "Newton", "follow_modes"]

BALANCE = 0.2
"""Of the tolerance, to which part of the usual forces Newton's method balances them."""

PATIENCE = 4
"""Newton iterations after which rounding is thought of; most steps take one or two."""

LONGEST_PAUSE = 64
"""Steps without another try to keep a Jacobian."""

REACH = 2.0
"""Over the last step, how far ahead its rate of change is believed by the predictor."""


class Newton:
    """Extrapolates accelerations to the end of a step, and asks for no more than can be.

    Exudyn starts every step from accelerations of zero, which costs an iteration a step in
    lubricated motion and several where contact lasts. Here they go on as they did in the last step,
    and lasting contacts start from the force that held them. So do constraints.

    A thin film answers the last digit of a speed with newtons: no iteration balances forces better.

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
        self._part = BALANCE * task.tolerance
        self._rounding = task.tuning.rounding
        self._jacobian: FlexibleJacobian | LastingJacobian | None = None
        if problem.modal_stiffness:
            self._jacobian = FlexibleJacobian(task)
        elif not task.every_jacobian:
            self._jacobian = LastingJacobian(task)
        current = problem.current
        self._positions, self._velocities = current.positions, current.velocities
        self._accelerations, self._multipliers = current.accelerations, current.multipliers
        self._multipliers_before = problem.start.multipliers
        size = len(current.positions)
        self._expected, self._change = np.zeros(size), np.zeros(size)
        self._floats: Any = self._expected.data  # to get or set one takes a third of the time
        self._by = np.zeros(())  # arrays are multiplied by it in a third of a float's time
        # where they begin among the coordinates, their reference values, their displacements
        self._quaternions: list[tuple[int, list[float], Any]] = []
        for node in problem.nodes:
            if node.quaternion:
                first = node.start + node.size - 4
                four = slice(first, first + 4)
                reference: list[float] = problem.reference[four].tolist()
                self._quaternions.append((first, reference, current.positions[four]))
        self._ratio = self._beta = self._gamma = 0.0
        self._now, self._rate = np.zeros(size), np.zeros(size)  # at the last step's end, over it
        self._last = 0.0  # size of the last step, s
        self._given = 0.0  # Newton's absolute tolerance of the settings, N
        self._accepted = 0.0  # now, N

    def begin(self) -> None:
        """Start from the current state, when the solver is ready."""
        solver = self._solver
        self._ratio = (1.0 - solver.alphaF) / (1.0 - solver.alphaM)
        self._beta, self._gamma = solver.newmarkBeta, solver.newmarkGamma
        self._given = self._accepted = solver.newton.absoluteTolerance
        self._now[:] = self._accelerations

    def stepped(self, step: float) -> None:
        """Be told that the current state is the end of an accepted step (s)."""
        np.subtract(self._accelerations, self._now, self._rate)
        self._by.fill(step)
        np.divide(self._rate, self._by, self._rate)
        self._last, self._now[:] = step, self._accelerations

    def before_residual(self, step: float, iteration: int) -> None:
        """Set what an iteration of a step (s) starts from, and where it may end."""
        if not iteration:
            self._advance(step)
            self._accept(self._tolerance())
            if self._jacobian is not None:
                self._jacobian.begin(step)
        elif iteration in (2, 3) and self._jacobian is not None:
            self._jacobian.outdated(iteration)
        elif iteration == PATIENCE:
            self._accept(max(self._tolerance(), self._rounded()))

    def _rounded(self) -> float:
        """Return what the last digits of the state make of forces, N."""
        if self._joints is not None:
            return self._rounding * self._joints.damping * self._scales.speed
        size, forces = self._residual()
        if not 0.0 < size < math.inf:
            return 0.0
        state = self._positions, self._multipliers
        before = [np.array(part) for part in state]
        for part, whole in zip(state, (before[0] + self._reference, before[1]), strict=True):
            part[0::2] += self._rounding * whole[0::2]
            part[1::2] -= self._rounding * whole[1::2]
        changed = np.linalg.norm(self._residual()[1] - forces)
        for part, as_it_was in zip(state, before, strict=True):
            part[:] = as_it_was
        return size * float(changed / np.linalg.norm(forces))

    def _residual(self) -> tuple[float, Array]:
        """Return what forces and constraints leave in the current state, N, and it by coordinate.

        The latter are scaled with the step, but all alike.
        """
        solver = self._solver
        size = solver.ComputeNewtonResidual(self._mbs, self._mbs.sys["simulationSettings"])
        return size, np.array(solver.GetSystemResidual())

    def _advance(self, step: float) -> None:
        """Add the expected accelerations to a state that was advanced without any.

        As Newton's method adds an increment of them.
        """
        expected, change, by = self._expected, self._change, self._by
        by.fill(min(step, REACH * self._last))
        np.multiply(self._rate, by, expected)
        expected += self._now
        by_q = step * step * self._ratio * self._beta
        self._put_on_the_sphere(by_q)
        by.fill(by_q)
        np.multiply(expected, by, change)
        self._positions += change
        by.fill(step * self._ratio * self._gamma)
        np.multiply(expected, by, change)
        self._velocities += change
        self._accelerations[:] = expected
        self._multipliers[:] = self._multipliers_before

    def _put_on_the_sphere(self, by_q: float) -> None:
        """Change expected accelerations to those with which Euler parameters have unit length."""
        floats = self._floats
        for first, reference, displacement in self._quaternions:
            turned: list[float] = displacement.tolist()
            square = 0.0
            for k in range(4):
                turned[k] += reference[k] + by_q * floats[first + k]
                square += turned[k] * turned[k]
            longer = (1.0 / math.sqrt(square) - 1.0) / by_q
            for k in range(4):
                floats[first + k] += longer * turned[k]

    def _tolerance(self) -> float:
        """Return to what Newton's method is to balance forces, N."""
        return self._part * self._scales.force or self._given

    def _accept(self, residual: float) -> None:
        """Let Newton's method end at a residual, N."""
        if residual != self._accepted:
            self._accepted = self._solver.newton.absoluteTolerance = residual


class LastingJacobian:
    """Keeps Newton's matrix from step to step, while steps have one size and it serves.

    In large systems, and where it is differentiated through functions in Python, a Jacobian takes
    as long as ten iterations or more. A kept one may take two iterations; a third one gets a fresh
    one. Where that happens, the motion changes the matrix too fast, and fresh ones are made for as
    many steps as have been tried in vain before, doubled.
    """

    def __init__(self, task: Task) -> None:
        """Look at the solver of a task."""
        self._convergence: Any = task.solver.conv
        self._step = 0.0  # that it was made for
        self._kept = False
        self._pause, self._wait = 1, 0  # steps with fresh ones: after the next failure, and now

    def begin(self, step: float) -> None:
        """Choose whether the step (s) about to be tried starts with the Jacobian there is."""
        self._kept = self._wait == 0 and abs(step - self._step) <= SAME * step
        if not self._kept:
            self._convergence.jacobianUpdateRequested = True
            self._step = step
        if self._wait:
            self._wait -= 1

    def outdated(self, iteration: int) -> None:
        """Be told that a step has needed so many iterations."""
        if not self._kept:
            return
        if iteration == 2:
            self._convergence.jacobianUpdateRequested = True
        else:
            self._kept, self._wait = False, self._pause
            self._pause = min(2 * self._pause, LONGEST_PAUSE)


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

    def begin(self, step: float) -> None:
        """Choose whether the step (s) about to be tried starts with the Jacobian there is."""
        self._kept = self._serves and abs(step - self._step) <= SAME * step
        self._convergence.jacobianUpdateRequested = not self._kept
        self._serves = self._joints is not None

    def outdated(self, iteration: int) -> None:
        """Be told of a second iteration, or a third; for the latter, make a fresh one."""
        self._serves = False
        if self._kept and iteration == 2:
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


def follow_modes(mbs: exu.MainSystem) -> None:
    """Let `solve_dynamic` follow what impacts in clearance joints leave vibrating.

    To be called before `mbs.Assemble()`, when all ObjectFFRFreducedOrder are there. It adds one
    item without mass over their modes, which `solve_dynamic` gives the mass that belongs to the
    step, with clearance joints and with fixed steps. Other solvers are not concerned.

    Args:
        mbs: the system.
    """
    nodes = [item["nodeNumbers"][1] for item in _bodies(mbs)]
    if nodes:
        item = ObjectGenericODE2(nodeNumbers=nodes, visualization=VObjectGenericODE2(show=False))
        mbs.variables[MODES] = int(mbs.AddObject(item))


class ModalMass:
    """Return the change of the modes' mass in steps of a size.

    So flexible bodies vibrate at their own frequencies, in ten steps a period as in a hundred.

    Generalized-alpha slows vibrations down: what has the frequency omega takes omega (1 - kappa (h
    omega)^2 / 2) in steps of h, with kappa = 1/6 + 3/4 (alpha_f - alpha_m)^2. What an impact leaves
    vibrating is soon out of phase by that, and decides on how the next impact comes. But a mode's
    stiffness K is known beforehand. If it acts on q - kappa h^2 q_tt instead of on q, errors of
    phase go with h^4. That is the same as another mass of the modes,

        M - kappa h^2 K,

    with which forces at rest stay what they are. Each mode of a body has m / (1 + kappa (h
    omega)^2), which is the same to this order, and positive in steps of any size. For a spectral
    radius of 1 it is the method of Fox and Goodwin for the modes alone, Newmark's with beta = 1/12.
    The energies of a run are those of M.

    Source: L. Fox and E. T. Goodwin, Some new methods for the numerical integration of ordinary
    differential equations, Mathematical Proceedings of the Cambridge Philosophical Society 45
    (1949); T. J. R. Hughes, The Finite Element Method (1987), 9.1.
    """

    def __init__(self, mbs: exu.MainSystem, solver: Any, part: float) -> None:
        """Take a system.

        Args:
            mbs: the system.
            solver: that advances it.
            part: of what keeps the frequencies; 0.0 leaves the modes their own mass.
        """
        self._mbs, self._solver, self._part = mbs, solver, part
        self._item = modal_item(mbs) if part > 0.0 else None
        self._step = 0.0
        self._squares: Array = np.zeros(0)  # of the frequencies, 1/s^2
        self._weights: Array = np.zeros((0, 0))  # M times the modes of K and M
        self._places: Any = None  # where it changes
        self._entries: Array = np.zeros((0, 3))  # rows, columns and values there
        if self._item is not None:
            within = [int(node) for node in mbs.GetObject(self._item)["nodeNumbers"]]
            bodies = [item for item in _bodies(mbs) if int(item["nodeNumbers"][1]) in within]
            stiffness = _diagonal([item["stiffnessMatrixReduced"] for item in bodies])
            root = np.linalg.cholesky(_diagonal([item["massMatrixReduced"] for item in bodies]))
            inverse = np.linalg.inv(root)
            self._squares, modes = np.linalg.eigh(inverse @ stiffness @ inverse.T)
            self._weights = root @ modes
            self._places = np.nonzero(np.abs(self._weights) @ np.abs(self._weights.T))
            self._entries = np.column_stack([*self._places, np.zeros(len(self._places[0]))])

    def fit(self, step: float) -> None:
        """Let the modes have the mass that belongs to a step, s; 0.0 leaves them their own."""
        if self._item is None or step == self._step:
            return
        self._step = step
        offset = self._solver.alphaF - self._solver.alphaM
        kappa = self._part * (1.0 / 6.0 + 0.75 * offset * offset)
        squares = kappa * step * step * self._squares
        changes = self._weights * (-squares / (1.0 + squares)) @ self._weights.T
        self._entries[:, 2] = changes[self._places]
        mass, size = exu.MatrixContainer(), len(changes)
        mass.SetWithSparseMatrix(self._entries, size, size)
        self._mbs.SetObjectParameter(self._item, "massMatrix", mass)


def _diagonal(containers: list[Any]) -> Array:
    """Return a matrix with those of Exudyn's containers along its diagonal."""
    blocks = [container.Convert2DenseMatrix() for container in containers]
    ends = np.cumsum([len(block) for block in blocks])
    found = np.zeros((ends[-1], ends[-1]))
    for block, end in zip(blocks, ends, strict=True):
        found[end - len(block) : end, end - len(block) : end] = block
    return found


def _bodies(mbs: exu.MainSystem) -> list[dict[str, Any]]:
    """Return Exudyn's dictionaries of the flexible bodies of a system."""
    data: Any = mbs.systemData
    items = [mbs.GetObject(number) for number in range(data.NumberOfObjects())]
    return [item for item in items if item["objectType"] == FLEXIBLE]
