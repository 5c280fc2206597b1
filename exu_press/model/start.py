"""Initial deformation of flexible bodies: that of the quasi-static motion with ideal joints.

Undeformed bodies that start at full speed vibrate for a revolution. In the quasi-static motion
inertia, weight, springs and joint forces balance the modes' stiffness at every instant. Velocities
and accelerations are derivatives of this balance by the drive's angle, of the previous iteration.
Each iteration shrinks the error by the square of the drive's frequency over the lowest mode's:
about a hundred times.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism import Motion
from exu_press.model.constraints import turned_body
from exu_press.model.system import System
from exu_press.numerics.arrays import Array
from exu_press.numerics.threads import one_thread
from exu_press.scene import Scene

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart
    from fe_models import FlexibleBody
__all__ = ["deformed_start", "quasi_static_motion"]

SMALL = 0.1
"""Largest deformation over a body's size: modes describe small ones alone."""

CURRENT = exu.ConfigurationType.Current
ANGLES = np.radians(np.arange(-3.0, 4.0))
"""Angles of the drive from the start, rad: a polynomial of sixth degree through them is
differentiated.
From half to twice this spacing the result is the same to 1e-6."""

ITERATIONS = 4
"""Iterations, the first one at rest; the last one changes modes by 1e-4 of themselves. More would
let rounding grow, which differentiation multiplies."""

CORRECTIONS = 4
"""Newton iterations in the first iteration, from the undeformed start up to 3 degrees away; later
iterations continue from the previous one and need half as many."""


def deformed_start(
    ideal: System, speed: float
) -> tuple[dict[str, Motion], dict[str, "FrameStart"]]:
    """Return the motion of the rigid bodies and the frames of the flexible ones at the start.

    The system is assembled, in the start of undeformed bodies, and its joints are ideal; the speed
    is the crank's, rad/s.

    Raises:
        InputError: a body is so compliant that its deformation is not small.
    """
    from exu_press.model.flexible_body import start_from_state

    mbs = ideal.mbs
    turned = turned_body(ideal)
    coordinate = mbs.GetNodeODE2Index(ideal.nodes[turned])
    coordinate += ideal.rigid[turned].coordinates.index("angle")
    state = quasi_static_motion(mbs, ideal.forces["drive", "force"], coordinate, speed)

    def state_of(node: int) -> Iterator[Array]:
        indices = mbs.systemData.GetNodeLTGODE2(node)
        return (values[indices] for values in state)

    start, frames = {}, {}
    for name, rigid in ideal.rigid.items():
        q, q_t = (values[None, :] for values in state_of(rigid.node))
        start[name] = rigid.motion(q, q_t, np.zeros_like(q))
    for name, body in ideal.flexible.items():
        modes = [np.zeros(0)] * 2 if body.node_modes is None else list(state_of(body.node_modes))
        _refuse_too_compliant(ideal.scene, name, body, modes[0])
        frames[name] = start_from_state(mbs, body, *state_of(body.node_rigid), *modes)
    return start, frames


def _refuse_too_compliant(scene: Scene, name: str, body: "FlexibleBody", modes: Array) -> None:
    """Refuse a body whose deformation is not small, or not a number, for its modal coordinates."""
    shift = np.linalg.norm((body.reduced.modes @ modes).reshape(-1, 3), axis=1).max(initial=0.0)
    share = shift / float(np.ptp(body.reduced.nodes, axis=0).max())
    if not share <= SMALL:
        table = scene.bodies[name]
        than = "" if table.youngs_modulus is None else f" than {table.youngs_modulus:g} Pa"
        stiffer = f"larger youngs_modulus{than}" if table.matrices is None else "stiffer matrix"
        size = f"{share:.2g} of its size" if share < 1.0 else "more than its size"
        raise InputError(
            f"bodies.{name}: its ideal motion would bend it by {size}; allowed is {SMALL:g}, of a "
            f"{stiffer} or at a lower speed_rpm"
        )


def quasi_static_motion(
    mbs: exu.MainSystem, drive: int, coordinate: int, speed: float
) -> tuple[Array, Array]:
    """Return all coordinates, (n,), and their rates, of the quasi-static motion.

    Args:
        mbs: assembled, in the start of the same mechanism with rigid bodies. All joints are ideal.
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
        """Correct positions and constraint forces, in place, at an angle of the drive."""
        mbs, solver, size = self._mbs, self._solver, self.size
        mbs.systemData.GetODE2Coordinates(CURRENT, False)[:] = q
        mbs.systemData.GetODE2Coordinates_t(CURRENT, False)[:] = q_t
        solver.ComputeMassMatrix(mbs)
        solver.SetSystemJacobian(np.zeros((size + self.constraints,) * 2))
        solver.ComputeJacobianAE(mbs, 1.0, 1.0)
        matrix = self._matrix()
        residual = np.zeros(len(matrix))
        solver.ComputeODE2RHS(mbs)
        residual[:size] = self._residual()[:size]
        residual[:size] -= np.asarray(solver.GetSystemMassMatrix()) @ q_tt
        residual[:size] -= matrix[size:, :size].T @ forces
        solver.ComputeAlgebraicEquations(mbs, velocityLevel=False)
        residual[size:] = -self._residual()[size:]
        residual[size + self._driven] = angle - q[self._coordinate]  # constrained is its speed
        matrix[:size, :size] = self._stiffness
        try:
            correction = np.linalg.solve(matrix, residual)
        except np.linalg.LinAlgError:  # a deformation that is refused later
            correction = np.full(len(residual), np.nan)
        q += correction[:size]
        forces += correction[size:]

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
