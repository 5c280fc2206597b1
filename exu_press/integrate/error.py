"""The local error of a step, relative to the tolerance and to the mechanism's own scales."""

import math

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.joints import ClearanceJoint
from exu_press.model import Model

__all__ = ["StepError"]

Array = NDArray[np.float64]

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
        scene, bodies = model.scene, model.mechanism.bodies
        self._mbs = model.mbs
        size = scene.press or scene.slider_crank
        assert size is not None
        share = tolerance / STEPS_ADD_UP
        self._velocity_limit = 2.0 * share * scene.angular_speed * size.crank_radius
        self._mass = np.array([m for body in bodies for m in (body.mass, body.mass, body.inertia)])
        self._norm = np.array(
            [
                m / body.mass
                for body, m in zip(
                    [body for body in bodies for _ in range(3)], self._mass, strict=True
                )
            ]
        )
        self._joints = [
            _JointError(joint, 12.0 * share * clearance)
            for joint, clearance in model.joint_clearances()
        ]

    def __call__(self, step: float) -> float:
        """Return the error of the step that ends in the current state."""
        data = self._mbs.systemData
        now = np.array(data.GetODE2Coordinates_tt(exu.ConfigurationType.Current, False))
        before = np.array(data.GetODE2Coordinates_tt(exu.ConfigurationType.StartOfStep, False))
        error = self._velocity_error(step, now - before)
        if error > 1.0:
            error = self._velocity_error(step, self._free(now - before))
        return max([error, *(joint.error(step) for joint in self._joints)])

    def accept(self, step: float) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        for joint in self._joints:
            joint.accept(step)

    def _velocity_error(self, step: float, jump: Array) -> float:
        """Return the error of a jump of the accelerations."""
        per_body = (jump * jump * self._norm).reshape(-1, 3).sum(axis=1)
        return step * math.sqrt(float(per_body.max())) / self._velocity_limit

    def _free(self, jump: Array) -> Array:
        """Return the part of a jump that no constraint force can make or undo."""
        jacobian = np.asarray(self._mbs.sys["dynamicSolver"].GetSystemJacobian())
        size = len(jump)
        reactions = jacobian[:size, size:] / np.sqrt(self._mass)[:, None]
        weighted = jump * np.sqrt(self._mass)
        multipliers = np.linalg.lstsq(reactions, weighted, rcond=1e-12)[0]
        return np.asarray((weighted - reactions @ multipliers) / np.sqrt(self._mass))


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
