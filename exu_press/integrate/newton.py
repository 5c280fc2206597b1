"""What Newton's method is told: where to start, and what is too much to ask.

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
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.flexible_jacobian import FlexibleJacobian
from exu_press.integrate.problem import Node
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.settings import Tuning
from exu_press.joints.overlay import JointOverlay

__all__ = ["Newton"]

CURRENT = exu.ConfigurationType.Current
START = exu.ConfigurationType.StartOfStep

BALANCE = 0.2
"""Of the tolerance, to which part of the usual forces Newton's method balances them."""

PATIENCE = 4
"""Newton iterations after which rounding is thought of; most steps take one or two."""

REACH = 2.0
"""Over the last step, how far ahead its rate of change is believed by the predictor."""


class Newton:
    """Extrapolates accelerations to the end of a step, and asks for no more than can be.

    Attributes:
        data: of the system, `mbs.systemData`; to ask for it costs as much as what it is asked.
        now: accelerations at the end of the last accepted step.
    """

    def __init__(
        self,
        mbs: exu.MainSystem,
        solver: Any,
        joints: JointOverlay | None,
        scales: FoundScales,
        tolerance: float,
        tuning: Tuning,
        nodes: tuple[Node, ...],
        jacobian: FlexibleJacobian | None,
    ) -> None:
        """Guide the solver of a system.

        Args:
            mbs: the system.
            solver: an exu.MainSolverImplicitSecondOrder, which is about to solve it.
            joints: its clearance joints, if it has any.
            scales: of its motion.
            tolerance: of the run.
            tuning: numbers.
            nodes: of the system, with its coordinates.
            jacobian: that of flexible bodies, if it is not Exudyn's.
        """
        self.data: Any = mbs.systemData
        self._solver, self._joints = solver, joints
        self._scales, self._part = scales, BALANCE * tolerance
        self._rounding = tuning.rounding
        self._jacobian, self._kept_balance = jacobian, tuning.kept_balance
        self._quaternions = [self._reference(node) for node in nodes if node.quaternion]
        self._weights: tuple[float, float, float] | None = None
        self._start: float | None = None  # of the step under way, s
        self.now: list[float] = []
        self._rate: list[float] = []  # of change, in the last step
        self._last = 0.0  # size of the last step, s
        self._given: float | None = None  # Newton's absolute tolerance of the settings, N
        self._accepted = 0.0  # now, N

    def stepped(self, time: float, accelerations: list[float]) -> None:
        """Be told where an accepted step ends: the time, s, and all coordinates' accelerations."""
        if self._start is not None:
            self._last, before = time - self._start, self.now
            last = self._last
            self._rate = [(accelerations[i] - before[i]) / last for i in range(len(before))]
        self._start, self.now = time, accelerations

    def before_residual(self, time: float, iteration: int) -> None:
        """Set what an iteration of a step to `time`, s, starts from, and where it may end."""
        if not iteration:
            assert self._start is not None
            self._advance(time - self._start)
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
        """Add the expected accelerations to a state that was advanced without any."""
        if self._weights is None:
            solver = self._solver
            ratio = (1.0 - solver.alphaF) / (1.0 - solver.alphaM)
            self._weights = ratio, solver.newmarkBeta, solver.newmarkGamma
        ratio, beta, gamma = self._weights
        ahead, values = min(step, REACH * self._last), self.now
        if self._rate:
            now, rate = self.now, self._rate
            values = [now[i] + ahead * rate[i] for i in range(len(rate))]
        expected = np.array(values)
        # as Newton's method adds an increment of them
        data, by_q = self.data, step * step * ratio * beta
        positions = data.GetODE2Coordinates(CURRENT, False)
        for i, reference in self._quaternions:
            rotation_tt = expected[i : i + 4]
            turned = reference + positions[i : i + 4] + by_q * rotation_tt
            length = math.sqrt(float(turned @ turned))
            rotation_tt += (1.0 / length - 1.0) / by_q * turned
        positions += by_q * expected
        velocities = data.GetODE2Coordinates_t(CURRENT, False)
        velocities += (step * ratio * gamma) * expected
        data.GetODE2Coordinates_tt(CURRENT, False)[:] = expected
        data.GetAECoordinates(CURRENT, False)[:] = data.GetAECoordinates(START, False)

    def _reference(self, node: Node) -> tuple[int, Any]:
        """Return where a node's Euler parameters begin, and what their coordinates add to."""
        first = node.start + node.size - 4
        reference = self.data.GetODE2Coordinates(exu.ConfigurationType.Reference)
        return first, np.array(reference[first : first + 4])

    def _tolerance(self) -> float:
        """Return to what Newton's method is to balance forces, N."""
        if self._given is None:
            self._given = self._accepted = self._solver.newton.absoluteTolerance
        return self._part * self._scales.force or self._given

    def _accept(self, residual: float) -> None:
        """Let Newton's method end at a residual, N."""
        if residual != self._accepted:
            self._accepted = self._solver.newton.absoluteTolerance = residual
