"""The motion that a driven mechanism of flexible bodies settles on, where it starts unperturbed.

Undeformed bodies that start at full speed ring for a revolution. What the ideal motion deforms them
by is found here: at every instant inertia, weight, springs and the forces of joints balance the
modes' stiffness, with velocities and accelerations that follow from how the balance itself changes
with the drive's angle. So they lag behind by one turn of an iteration, which shrinks the error by
the square of the drive's frequency over the lowest mode's: about a hundred times.
"""

from typing import Any

import exudyn as exu
import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.numerics.threads import one_thread

__all__ = ["quasi_static_motion"]

CURRENT = exu.ConfigurationType.Current

ANGLES = np.radians(np.arange(-3.0, 4.0))
"""Angles of the drive about the start's, rad: a polynomial of sixth degree differentiates there.
From half to twice this spacing the result is the same to 1e-6."""

ITERATIONS = 4
"""Turns of the iteration: the first one at rest, the last one changes modes by 1e-4 of themselves.
More would let rounding grow, which differentiating multiplies."""

CORRECTIONS = 4
"""Steps of Newton's method in the first turn, from the undeformed start's position up to 3 degrees
away; later ones start where the last one ended and take half as many."""


def quasi_static_motion(
    mbs: exu.MainSystem, drive: int, coordinate: int, speed: float
) -> tuple[Array, Array]:
    """Return all coordinates, (n,), and their rates, on the motion without vibrations.

    Args:
        mbs: assembled, on the start of the same mechanism with rigid bodies. All joints are ideal.
        drive: object number of the constraint that prescribes the drive's speed.
        coordinate: the drive's angle among all coordinates.
        speed: of the drive, rad/s.
    """
    with one_thread(), np.errstate(over="ignore", invalid="ignore"):  # compliant bodies
        balance = _Balance(mbs, drive, coordinate)
        rate = speed * _differentiation(ANGLES)
        q = np.zeros((len(ANGLES), balance.size))
        forces = np.zeros((len(ANGLES), balance.constraints))
        q_t = q_tt = np.zeros_like(q)
        for iteration in range(ITERATIONS):
            for i, angle in enumerate(ANGLES):
                for _ in range(CORRECTIONS if iteration == 0 else CORRECTIONS // 2):
                    balance.correct(angle, q[i], q_t[i], q_tt[i], forces[i])
            q_t = rate @ q
            q_tt = rate @ q_t
    middle = len(ANGLES) // 2
    return q[middle], q_t[middle]


class _Balance:
    """Equations of motion of a system, solved for positions by Newton's method.

    Attributes:
        size: number of coordinates.
        constraints: number of constraints.
    """

    def __init__(self, mbs: exu.MainSystem, drive: int, coordinate: int) -> None:
        """Take what `quasi_static_motion` takes."""
        settings = exu.SimulationSettings()
        settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
        settings.solution.file.write = False
        settings.timeIntegration.verboseMode = 0
        self._mbs = mbs
        solver: Any = exu.MainSolverImplicitSecondOrder()  # whose type stub forgets `self`
        self._solver = solver
        solver.InitializeSolver(mbs, settings)
        self._coordinate, self._driven = coordinate, mbs.systemData.GetObjectLTGAE(drive)[0]
        self.size, self.constraints = self._solver.GetODE2size(), self._solver.GetAEsize()
        self._solver.ComputeJacobianODE2RHS(mbs, -1.0, 0.0)  # of modes and springs: constant
        self._stiffness = self._matrix()[: self.size, : self.size]

    def correct(self, angle: float, q: Array, q_t: Array, q_tt: Array, forces: Array) -> None:
        """Correct positions and the constraints' forces, in place, at an angle of the drive."""
        mbs, solver, size = self._mbs, self._solver, self.size
        mbs.systemData.GetODE2Coordinates(CURRENT, False)[:] = q
        mbs.systemData.GetODE2Coordinates_t(CURRENT, False)[:] = q_t
        solver.ComputeMassMatrix(mbs)
        solver.SetSystemJacobian(np.zeros((size + self.constraints,) * 2))
        solver.ComputeJacobianAE(mbs, 1.0, 1.0)
        matrix = self._matrix()
        missing = np.zeros(len(matrix))
        solver.ComputeODE2RHS(mbs)
        missing[:size] = self._residual()[:size]
        missing[:size] -= np.asarray(solver.GetSystemMassMatrix()) @ q_tt
        missing[:size] -= matrix[size:, :size].T @ forces
        solver.ComputeAlgebraicEquations(mbs, velocityLevel=False)
        missing[size:] = -self._residual()[size:]
        missing[size + self._driven] = angle - q[self._coordinate]  # its speed is held
        matrix[:size, :size] = self._stiffness
        found = np.linalg.solve(matrix, missing)
        q += found[:size]
        forces += found[size:]

    def _matrix(self) -> Array:
        return np.array(self._solver.GetSystemJacobian())

    def _residual(self) -> Array:
        return np.array(self._solver.GetSystemResidual())


def _differentiation(points: Array) -> Array:
    """Return the matrix that differentiates values at points, by the polynomial through them."""
    scale = float(np.abs(points).max())
    powers = np.vander(points / scale, increasing=True)
    slopes = np.zeros_like(powers)
    slopes[:, 1:] = powers[:, :-1] * np.arange(1, len(points))
    return np.asarray(np.linalg.solve(powers.T, slopes.T).T / scale)
