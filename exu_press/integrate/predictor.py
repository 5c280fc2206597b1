"""The first guess of a step, and where Newton's method ends."""

import math
from typing import Any

from exu_press.integrate.jacobian import FlexibleJacobian, FrictionJacobian
from exu_press.integrate.task import Task
from exu_press.joints.guide_friction import guide_frictions

__all__ = ["Predictor"]


class Predictor:
    """Extrapolates accelerations to the end of a step, and asks for no more than rounding allows.

    Exudyn starts every step from accelerations of zero, which costs an iteration a step in
    lubricated motion and several where contact lasts. Here they go on as they did in the last step.
    A thin film answers the last digit of a speed with newtons: no iteration balances forces better.

    The constraints' directions that Exudyn gives Newton's method are right for Euler parameters of
    unit length only: where the expected ones have another length, what an iteration leaves in the
    constraints alternates from step to step, 1/(1 - spectral radius)^2 times as large in the
    accelerations. So the expected accelerations are those that lead to unit length.
    """

    def __init__(self, task: Task) -> None:
        """Guide the solver of a task."""
        system, tuning = task.system, task.tuning
        self._solver, self._joints, self._scales = task.solver, system.joints, task.scales
        self._rounding = tuning.rounding
        self._patience, self._reach = tuning.roundoff_after_iterations, tuning.max_extrapolation
        self._jacobian = FlexibleJacobian(task) if system.modal_stiffness else None
        if guide_frictions(system.mbs) and not system.modal_stiffness:
            FrictionJacobian(task)
        self._relative = tuning.newton_tolerance * task.tolerance
        current = system.current
        self._positions, self._velocities, self._accelerations = current.motion()
        self._multipliers: Any = current.multipliers.data
        self._multipliers_before: Any = system.start.multipliers.data
        # where they begin among the coordinates, and their reference values
        self._quaternions: list[tuple[int, list[float]]] = []
        for node in system.nodes:
            if node.rotations == 4:
                first = node.start + node.size - 4
                self._quaternions.append((first, system.reference[first : first + 4].tolist()))
        self._ratio = self._beta = self._gamma = 0.0
        self._now: list[float] = []  # accelerations at the last step's end
        self._rate: list[float] = []  # of them, over that step
        self._last = 0.0  # size of the last step, s
        self._absolute = 0.0  # Newton's absolute tolerance of the settings, N
        self._accepted = 0.0  # now, N

    def begin(self) -> None:
        """Start from the current state, when the solver is ready."""
        solver = self._solver
        self._ratio = (1.0 - solver.alphaF) / (1.0 - solver.alphaM)
        self._beta, self._gamma = solver.newmarkBeta, solver.newmarkGamma
        self._absolute = self._accepted = solver.newton.absoluteTolerance
        self._now = self._accelerations.read()
        self._rate = [0.0 for _ in self._now]

    def accept_step(self, step: float, accelerations: list[float]) -> None:
        """Take the accelerations at the end of an accepted step (s)."""
        last, now = self._now, accelerations
        self._rate = [(now[i] - last[i]) / step for i in range(len(now))]
        self._last, self._now = step, now

    def before_residual(self, step: float, iteration: int) -> None:
        """Set the start of the iteration of a step (s), and its limits."""
        if not iteration:
            self._predict(step)
            self._balance_to(0.0)
            if self._jacobian is not None:
                self._jacobian.begin(step)
            return
        if self._jacobian is not None:
            self._jacobian.request_if_stale(iteration)
        if iteration == self._patience and self._joints is not None:
            self._balance_to(self._rounding * self._joints.damping * self._scales.speed)

    def _predict(self, step: float) -> None:
        """Add the expected accelerations to a state that was advanced without any.

        As Newton's method adds an increment of them. With floats, as to call NumPy for a few takes
        longer than a step of Exudyn's.
        """
        now, rate, ahead = self._now, self._rate, min(step, self._reach * self._last)
        expected = [rate[i] * ahead + now[i] for i in range(len(now))]
        by_q, by_v = step * step * self._ratio * self._beta, step * self._ratio * self._gamma
        positions, velocities = self._positions.read(), self._velocities.read()
        if self._quaternions:
            self._normalise_quaternions(expected, positions, by_q)
        for i in range(len(expected)):
            position, velocity, change = positions[i], velocities[i], expected[i]
            positions[i] = position + by_q * change
            velocities[i] = velocity + by_v * change
        self._positions.write(positions)
        self._velocities.write(velocities)
        self._accelerations.write(expected)
        self._multipliers[:] = self._multipliers_before

    def _normalise_quaternions(
        self, expected: list[float], positions: list[float], by_q: float
    ) -> None:
        """Change expected accelerations to those with which Euler parameters have unit length.

        `by_q` (s^2) times accelerations is added to positions.
        """
        for first, reference in self._quaternions:
            parameters: list[float] = []
            square = 0.0
            for k in range(4):
                value = positions[first + k] + (reference[k] + by_q * expected[first + k])
                parameters.append(value)
                square += value * value
            longer = (1.0 / math.sqrt(square) - 1.0) / by_q
            for k in range(4):
                expected[first + k] += longer * parameters[k]

    def _balance_to(self, roundoff: float) -> None:
        """Let Newton's method end at its tolerance of the residual, or at a roundoff, N."""
        residual = max(self._relative * self._scales.force or self._absolute, roundoff)
        if residual != self._accepted:
            self._accepted = self._solver.newton.absoluteTolerance = residual
