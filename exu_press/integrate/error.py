"""The local error of a step, relative to the tolerance and to the mechanism's own scales."""

import math

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.joints import ClearanceJoint
from exu_press.model import Model

__all__ = ["StepError"]

Array = NDArray[np.float64]

TINY = 1e-14
"""Relative to the trace of the mass matrix: negligible beside any mass or mode."""

STEPS_ADD_UP = 10.0
"""One step may use a tenth of the tolerance: then the error of a whole run is about the tolerance,
as measured on the slider's velocity over a third of a revolution of the lubricated press."""


class StepError:
    """Estimates the error of the step just tried; 1 is the tolerance.

    Velocities: half of h |a1 - a0|, the difference between generalized-alpha and its first-order
    companion, against the crank pin's speed, as the largest of all bodies in the kinetic norm
    sqrt(|dx|^2 + (J/m) dphi^2). It goes with h^2 and the method is of second order, so that the
    global error follows the tolerance. Only what the constraints leave free counts: they hold the
    rest, and a change of step makes the accelerations ring in their directions.

    Clearance joints: the eccentricity's error h^2 |change of its acceleration| / 12 against the
    joint's clearance.
    """

    def __init__(self, model: Model, tolerance: float) -> None:
        """Take the scales from the scene."""
        scene = model.scene
        self._mbs = model.mbs
        size = scene.press or scene.slider_crank
        assert size is not None
        share = tolerance / STEPS_ADD_UP
        self._velocity_limit = 2.0 * share * scene.angular_speed * size.crank_radius
        self._bodies = _Bodies(model)
        self._mass: Array | None = None
        self._joints = [
            _JointError(joint, 12.0 * share * joint.clearance)
            for joint in model.clearance_joints.values()
        ]

    def __call__(self, step: float) -> float:
        """Return the error of the step that ends in the current state."""
        data = self._mbs.systemData
        if self._mass is None:
            self._mass = np.diag(self._mass_matrix())
        now = np.array(data.GetODE2Coordinates_tt(exu.ConfigurationType.Current, False))
        before = np.array(data.GetODE2Coordinates_tt(exu.ConfigurationType.StartOfStep, False))
        error = self._velocity_error(step, now - before, self._mass)
        if error > 1.0:
            error = self._velocity_error(step, self._free(now - before), self._mass)
        return max([error, *(joint.error(step) for joint in self._joints)])

    def accept(self, step: float) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        for joint in self._joints:
            joint.accept(step)

    def _velocity_error(self, step: float, jump: Array, mass: Array) -> float:
        """Return the error of a jump of the accelerations."""
        largest = self._bodies.largest(jump * jump * mass)
        return step * math.sqrt(largest) / self._velocity_limit

    def _free(self, jump: Array) -> Array:
        """Return the part of a jump that no constraint force can make or undo."""
        mass = self._mass_matrix()
        # Euler parameters have no mass along themselves, where a constraint holds them
        root = np.linalg.cholesky(mass + np.diag(np.full(len(jump), TINY * np.trace(mass))))
        jacobian = np.asarray(self._mbs.sys["dynamicSolver"].GetSystemJacobian())
        reactions = np.linalg.solve(root, jacobian[: len(jump), len(jump) :])
        weighted = root.T @ jump
        multipliers = np.linalg.lstsq(reactions, weighted, rcond=1e-12)[0]
        return np.asarray(np.linalg.solve(root.T, weighted - reactions @ multipliers))

    def _mass_matrix(self) -> Array:
        return np.asarray(self._mbs.sys["dynamicSolver"].GetSystemMassMatrix())


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


class _JointError:
    """The eccentricity's error of one clearance joint, from its velocities at the steps' ends."""

    def __init__(self, joint: ClearanceJoint, limit: float) -> None:
        self._joint = joint
        self._limit = limit
        self._velocity: tuple[float, ...] | None = None
        self._acceleration: tuple[float, ...] | None = None

    def error(self, step: float) -> float:
        mean = self._mean_acceleration(step)
        if mean is None or self._acceleration is None:
            return 0.0
        change = math.dist(mean, self._acceleration)
        return step * step * change / self._limit

    def accept(self, step: float) -> None:
        self._acceleration = self._mean_acceleration(step)
        self._velocity = self._joint.relative_velocity

    def _mean_acceleration(self, step: float) -> tuple[float, ...] | None:
        if self._velocity is None:
            return None
        now = self._joint.relative_velocity
        return tuple((v - v0) / step for v, v0 in zip(now, self._velocity, strict=True))
