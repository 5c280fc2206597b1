"""The truth of a case: from two integrators that share as little as possible.

Their mutual difference says how true it is. An error below ten times that difference says nothing
but "at most this", and stands in the report as that.
"""

from dataclasses import dataclass

import numpy as np

from exu_press.scene import Scene, mechanism_of
from exu_press.studies.precision.cases import Amount, Case
from exu_press.studies.precision.compiled import CompiledModel
from exu_press.studies.precision.errors import Errors, errors_of, instants_until
from exu_press.studies.precision.own import run_scene
from exu_press.studies.precision.peers import PEERS
from exu_press.studies.precision.trajectory import Array, Trajectory

__all__ = ["RESERVE", "Reference", "closed_form", "from_own", "from_reduced", "published"]

RESERVE = 10.0
"""An error must be this many times the references' mutual difference to be believed."""

KINEMATIC_STEP = 1e-5  # s, between the points of a closed-form trajectory


@dataclass(frozen=True)
class Reference:
    """What runs are compared with.

    Attributes:
        method: where it comes from, in words.
        trajectory: None if it could not be made.
        difference: between the two integrators, up to the horizon; zeros where it is exact.
    """

    method: str
    trajectory: Trajectory | None
    difference: Errors

    @property
    def floor(self) -> Errors:
        """Smallest errors that can be told."""
        d = self.difference
        return Errors(_above(d.position), _above(d.velocity), _above(d.peak_acceleration))


def _above(difference: float | None) -> float | None:
    return None if difference is None else RESERVE * difference


NOTHING = Errors(None, None, None)


def closed_form(scene: Scene) -> Reference:
    """Return the kinematics of ideal joints, which need no integrator."""
    count = round(scene.duration / KINEMATIC_STEP)
    time = np.linspace(0.0, scene.duration, count + 1)
    angle = scene.start_angle + scene.angular_speed * time
    motion = mechanism_of(scene).ideal_slider(angle, scene.angular_speed)
    return Reference("closed-form kinematics", Trajectory(time, *motion), Errors(0.0, 0.0, 0.0))


def published() -> Reference:
    """Return the squeezer's endpoint as a reference; 13 digits are given."""
    return Reference("published endpoint, tolerance 1e-14", None, Errors(1e-13, 1e-9, None))


def from_reduced(model: CompiledModel, horizon: float, amount: Amount) -> Reference:
    """Return SciPy's Radau on the reduced slider-crank, checked against its LSODA."""
    peers = {peer.name: peer for peer in PEERS}
    tight = {"SciPy Radau": 1e-10 * amount.loosen, "SciPy LSODA": 1e-12 * amount.loosen}
    radau, lsoda = (peers[name].trajectory(model, tol) for name, tol in tight.items())
    method = " against ".join(f"{name} {tol:.0e}" for name, tol in tight.items())
    return Reference(f"two coordinates: {method}", radau, errors_of(lsoda, radau, horizon))


def from_own(case: Case, scene: Scene, horizon: float, amount: Amount) -> Reference:
    """Return the tightest tolerance, checked against fixed steps extrapolated to zero.

    Args:
        case: with the settings of its reference.
        scene: the case's scene, perhaps shortened.
        horizon: s.
        amount: how much is run.
    """
    tolerance = case.reference_tolerance * amount.loosen
    step = max(case.reference_step, amount.reference_step)
    method = f"tolerance {tolerance:.0e} against fixed steps {2 * step:.0e}, {step:.0e} s"
    tight = run_scene(scene, "tolerance", tolerance).trajectory
    until_horizon = scene.replace(revolutions=scene.revolutions * horizon / scene.duration)
    coarse = run_scene(until_horizon, "step", 2.0 * step).trajectory
    fine = run_scene(until_horizon, "step", step).trajectory
    if tight is None or coarse is None or fine is None:
        return Reference(f"{method}: not all of them reached the end", None, NOTHING)
    instants = instants_until(horizon)
    position, velocity = (
        float(np.abs(_at_zero(c, f) - t).max())
        for c, f, t in zip(*(run.at(instants) for run in (coarse, fine, tight)), strict=True)
    )
    peak = errors_of(fine, tight, horizon).peak_acceleration  # as sampled; no order to rely on
    return Reference(f"{method}, extrapolated", tight, Errors(position, velocity, peak))


def _at_zero(coarse: Array, fine: Array) -> Array:
    """Return what a second-order method would give at step zero, from a step and its double."""
    return np.asarray(fine + (fine - coarse) / 3.0)
