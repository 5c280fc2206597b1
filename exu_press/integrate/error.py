"""The local error of a step, relative to the tolerance and to the mechanism's own scales."""

import math
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.integrate.local_error import BodyError, ErrorPerStep, FirstOrderError, JointError
from exu_press.integrate.problem import Problem
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.tuning import Tuning

__all__ = ["StepError"]

CURRENT = exu.ConfigurationType.Current
START = exu.ConfigurationType.StartOfStep

EPSILON = 1.1e-16
"""Last digit of a number, over it."""


class StepError:
    """Estimates the error of the step just tried; 1 is what one step may have.

    Velocities, against the scale of speeds: `BodyError`;
    first-order coordinates likewise, against their largest values: `FirstOrderError`. Where
    that is too much, what counts is the part that Newton's matrix lets through: constraints, films
    and contacts undo the rest within the step (L. F. Shampine's filter for stiff systems, see
    Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8). Without films and contacts
    also velocities that follow from constraints, at each instant against the tolerance itself.

    Clearance joints: what the eccentricity changes by, less the integral of its rate, against the
    joint's clearance and penetration, in films against the clearance and the time: `JointError`.

    Attributes:
        accelerations: of all coordinates at the end of the step last tried.
        start: accelerations of all coordinates at the run's start, where they are not Exudyn's.
    """

    def __init__(
        self,
        problem: Problem,
        solver: Any,
        scales: FoundScales,
        tolerance: float,
        longest: float,
        duration: float,
        tuning: Tuning,
    ) -> None:
        """Look at what is solved.

        Args:
            problem: what is solved.
            solver: an exu.MainSolverImplicitSecondOrder, which is about to solve it.
            scales: of the motion; are told of it.
            tolerance: of the run.
            longest: step that may be taken, s.
            duration: of the run, s.
            tuning: numbers.
        """
        self._problem, self._solver, self._scales = problem, solver, scales
        self._data: Any = problem.mbs.systemData
        self._tolerance, self._tuning = tolerance, tuning
        per_step = ErrorPerStep.of(
            tolerance, duration, tuning.many_steps, problem.joints is not None
        )
        self._per_step = per_step
        self.accelerations: list[float] = []
        self.start: list[float] = []
        self._bodies: BodyError | None = None
        self._first_order: FirstOrderError | None = None
        self._per_time = tolerance / (tuning.kept_steps * longest)
        self._joints: list[JointError] = []

    def __call__(self, step: float) -> float:
        """Return the error of the step that ends in the current state."""
        if self._bodies is None:
            self._bodies = self._first_look()
            if self._problem.first_order:
                self._first_order = FirstOrderError(self._data, self._per_step)
        self.accelerations = self._data.GetODE2Coordinates_tt(CURRENT, False).tolist()
        if self._scales.resting:
            velocities = self._data.GetODE2Coordinates_t(CURRENT, False).tolist()
            self._scales.set_out(velocities, self.accelerations)
        error = self._bodies.tried(self.accelerations, step)
        if error > 1.0:
            error = self._bodies.error(self._filtered(self._bodies.change), step)
        if not self._joints:  # else impacts and films need finer steps, by far
            offset = self._relative(self._bodies.offset(step))
            if not self._problem.switching:  # whose accelerations jump
                offset = max(offset, self._bodies.curvature(step, self._tolerance))
            error = max(error, math.pow(offset, 1.5))  # as the step's cube
        if self._first_order is not None:
            error = max(error, self._first_order.error(step))
        if self._problem.switching:
            error = max(error, self.of_switch(step))
        left = 0.0
        for joint in self._joints:
            found = joint.error(step)
            if found > 1.0:
                left = left or self._left_in_constraints()
                found = joint.error(step, left)
            error = max(error, found)
        return error

    def of_switch(self, step: float) -> float:
        """Return the error of a step in which Exudyn's contacts or friction have switched.

        The switch lies anywhere in the step, and its force is at most about as large as what the
        accelerations show: half of it acted too long. As switches are few, that is held against
        the tolerance itself.
        """
        if not self._solver.it.discontinuousIteration:
            return 0.0
        assert self._bodies is not None
        return self._relative(0.5 * step * self._bodies.largest())

    def of_jump(self, step: float) -> float:
        """Return the error if a jump of the accelerations lies in the step just tried.

        However short the step, it is then of first order; at most half of the jump times the step,
        which is held against the tolerance itself as jumps are few.
        """
        assert self._bodies is not None
        return self._relative(0.5 * step * self._bodies.of_jump())

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        assert self._bodies is not None
        self._bodies.accept()
        if not self._scales.fixed:
            velocities = self._data.GetODE2Coordinates_t(CURRENT, False).tolist()
            self._scales.update(velocities, self.accelerations)
        if self._first_order is not None:
            self._first_order.accept()

    def _relative(self, speed: float) -> float:
        """Return an error of a speed (m/s) over what the run may have of it."""
        allowed = self._tolerance * self._scales.speed
        return speed / allowed if allowed > 0.0 else 0.0

    def _first_look(self) -> BodyError:
        """Return the bodies' errors from the first step's beginning on; look at the joints too."""
        noise = self._scales.alternating(self._tuning.rounding, self._solver.alphaF)
        if self._problem.joints is not None:
            whole, per_time = self._per_step.whole, self._per_time
            self._joints = [
                JointError(j, whole * j.clearance, per_time * j.clearance, noise, self._tuning)
                for j in self._problem.joints.joints
            ]
        start = self.start or self._data.GetODE2Coordinates_tt(START, False).tolist()
        return BodyError(
            accelerations=start,
            per_step=self._per_step,
            scales=self._scales,
            tuning=self._tuning,
            noise=noise,
        )

    def _left_in_constraints(self) -> float:
        """Return how far the last digits of constraints move a body, m.

        By far where a mechanism passes a position in which two of them nearly say the same.
        """
        jacobian = np.asarray(self._solver.GetSystemJacobian())
        size, first = len(self.accelerations), len(jacobian) - self._solver.GetAEsize()
        try:
            moved = np.abs(np.linalg.inv(jacobian)[:size, first:]).sum(axis=1)
        except np.linalg.LinAlgError:  # constraints that say the same
            return 0.0
        assert self._bodies is not None
        return EPSILON * self._scales.length * self._bodies.largest_of(moved.tolist())

    def _filtered(self, change: list[float]) -> list[float]:
        """Return what Newton's matrix, M (1 - alpha_m)/(1 - alpha_f) + ..., leaves of a change."""
        solver = self._solver
        jacobian = np.asarray(solver.GetSystemJacobian())
        right = np.zeros(len(jacobian))
        right[: len(change)] = np.asarray(solver.GetSystemMassMatrix()) @ change
        right *= (1.0 - solver.alphaM) / (1.0 - solver.alphaF)
        try:
            filtered = np.linalg.solve(jacobian, right)[: len(change)]
        except np.linalg.LinAlgError:  # constraints that say the same
            return change
        found: list[float] = filtered.tolist()
        return found
