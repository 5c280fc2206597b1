"""The local error of a step, relative to the tolerance and to the mechanism's own scales."""

import math

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.joint_error import JointError
from exu_press.model import Model

__all__ = ["StepError"]

Array = NDArray[np.float64]

VELOCITY_CONSTANT = 2.0 / 12.0
"""Of generalized-alpha's local error h^3 times the acceleration's second derivative (0.083 to 0.077
for spectral radii at infinity of 1 to 0.8), doubled: peaks of an impact rest on a few steps."""

ROUNDING = 1e-14
"""Of positions, m: coordinates of about a metre, known to 1e-16 of it, through an iteration. No
step is told apart from it, and the velocities at a step's end are no better than this over it."""


def share_of(tolerance: float) -> float:
    """Return what one step may have of a run's tolerance.

    Generalized-alpha is of second order: its local error goes with h^3, and a run needs about
    tolerance^(-1/2) steps. So that the error of the whole run follows the tolerance, one step may
    have tolerance^(3/2); below 1e-4 a hundredth of the tolerance, as impacts become no more.
    """
    return max(math.pow(tolerance, 1.5), 1e-2 * tolerance)


class StepError:
    """Estimates the error of the step just tried; 1 is what one step may have.

    Velocities: h^3 |second derivative of the acceleration| / 6 against the crank pin's speed (or,
    with a slow crank, the speed at which a journal has fallen through its clearance), as the
    largest of all bodies in the kinetic norm sqrt(|dx|^2 + (J/m) dphi^2). The derivative comes
    from the accelerations at three instants. Where that is too much, what counts is the part that
    Newton's matrix lets through: constraints, films and contacts undo the rest within the step
    (L. F. Shampine's filter for stiff systems, see Hairer and Wanner, Solving Ordinary Differential
    Equations II, IV.8).

    Clearance joints: what the eccentricity changes by, less the integral of its rate, against the
    joint's clearance.
    """

    def __init__(self, model: Model, tolerance: float) -> None:
        """Take the scales from the scene."""
        scene = model.scene
        self._mbs = model.mbs
        size = scene.press or scene.slider_crank
        assert size is not None
        share = share_of(tolerance)
        pin_speed = scene.angular_speed * size.crank_radius
        widest = max((joint.clearance for joint in model.clearance_joints.values()), default=0.0)
        fall_speed = math.sqrt(4.0 * scene.gravity * widest)
        self._velocity_limit = share * max(pin_speed, fall_speed)
        self._jump_limit = tolerance * max(pin_speed, fall_speed)
        self._bodies = _Bodies(model)
        self._mass: Array | None = None
        self._now = np.zeros(0)  # accelerations at the end of the last try
        self._before: Array | None = None  # at its beginning
        self._rate: Array | None = None  # of change of the accelerations, in the last step
        self._rate_before: Array | None = None  # in the step before
        self._joints = [
            JointError(joint, max(share * joint.clearance, ROUNDING))
            for joint in model.clearance_joints.values()
        ]

    def __call__(self, step: float) -> float:
        """Return the error of the step that ends in the current state."""
        data = self._mbs.systemData
        if self._mass is None:
            self._mass = np.diag(self._mbs.sys["dynamicSolver"].GetSystemMassMatrix())
        now = self._now = np.array(data.GetODE2Coordinates_tt(exu.ConfigurationType.Current, False))
        if self._before is None:
            start = data.GetODE2Coordinates_tt(exu.ConfigurationType.StartOfStep, False)
            self._before = np.array(start)
        self._rate = rate = (now - self._before) / step
        change = rate if self._rate_before is None else rate - self._rate_before
        error = self._velocity_error(step, change, self._mass)
        if error > 1.0:
            error = self._velocity_error(step, self._filtered(change), self._mass)
        return max([error, *(joint.error(step) for joint in self._joints)])

    def of_jump(self, step: float) -> float:
        """Return the error if a jump of the accelerations lies in the step just tried.

        However short the step, it is then of first order; at most half of the jump times the step,
        which is held against the tolerance itself as jumps are few.
        """
        assert self._before is not None and self._mass is not None
        jump = self._now - self._before
        largest = math.sqrt(self._bodies.largest(jump * jump * self._mass))
        return 0.5 * step * largest / self._jump_limit

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._rate_before, self._before = self._rate, self._now
        for joint in self._joints:
            joint.accept()

    def _velocity_error(self, step: float, change: Array, mass: Array) -> float:
        """Return the error that goes with a change of the accelerations' rate."""
        largest = self._bodies.largest(change * change * mass)
        limit = max(self._velocity_limit, ROUNDING / step)
        return VELOCITY_CONSTANT * step * step * math.sqrt(largest) / limit

    def _filtered(self, change: Array) -> Array:
        """Return what Newton's matrix, M (1 - alpha_m)/(1 - alpha_f) + ..., leaves of a change."""
        solver = self._mbs.sys["dynamicSolver"]
        jacobian = np.asarray(solver.GetSystemJacobian())
        right = np.zeros(len(jacobian))
        right[: len(change)] = np.asarray(solver.GetSystemMassMatrix()) @ change
        right *= (1.0 - solver.alphaM) / (1.0 - solver.alphaF)
        return np.asarray(np.linalg.solve(jacobian, right)[: len(change)])


class _Bodies:
    """Which coordinates belong to which body, and the bodies' masses."""

    def __init__(self, model: Model) -> None:
        masses = {body.name: body.mass for body in model.mechanism.bodies}
        self._starts, self._masses = [], []
        for name, node in sorted(model.nodes.items(), key=lambda item: item[1]):
            self._starts.append(model.mbs.GetNodeODE2Index(node))
            self._masses.append(masses.get(name, math.inf))  # modes and drive: no say

    def largest(self, twice_energy: Array) -> float:
        """Return the largest sum per body, over the body's mass."""
        return float((np.add.reduceat(twice_energy, self._starts) / self._masses).max())
