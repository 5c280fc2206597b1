"""References of a scene: closed form, or the package's own integrator two ways."""

from dataclasses import replace

import numpy as np

from exu_press.scene import Scene, mechanism_of
from exu_press.studies.precision.amount import Amount
from exu_press.studies.precision.cases import Case
from exu_press.studies.precision.errors import (
    INSTANTS_APART,
    Errors,
    errors_of,
    instants_until,
)
from exu_press.studies.precision.own import moved, run_scene
from exu_press.studies.precision.trajectory import Array, Trajectory
from exu_press.studies.precision.truth import Reference, parting

__all__ = ["closed_form", "from_own"]

KINEMATIC_STEP = 1e-5  # s, between the points of a closed-form trajectory


NOTHING = Errors(None, None, None)

NEIGHBOUR = 4.0
LOOSER = 10.0
"""Times the reference's tolerance for further starts: they part as soon whatever it is."""


def closed_form(scene: Scene) -> Reference:
    """Return the kinematics of ideal joints, which need no integrator and never part."""
    count = round(scene.duration / KINEMATIC_STEP)
    time = np.linspace(0.0, scene.duration, count + 1)
    angle = scene.start_angle + scene.angular_speed * time
    motion = mechanism_of(scene).ideal_slider(angle, scene.angular_speed)
    return Reference("closed-form kinematics", Trajectory(time, *motion), Errors(0.0, 0.0, 0.0))


def from_own(case: Case, scene: Scene, amount: Amount) -> Reference:
    """Return the tightest tolerance, checked against fixed steps extrapolated to zero.

    How neighbouring motions part, and so the horizon, is measured by a run at NEIGHBOUR times the
    tolerance.

    Args:
        case: with the settings of its reference.
        scene: the case's scene, perhaps shortened.
        amount: how much is run.
    """
    tolerance = case.reference_tolerance * amount.loosen
    step = max(case.reference_step, amount.reference_step)
    method = f"tolerance {tolerance:.0e} against fixed steps {2 * step:.0e}, {step:.0e} s"
    tight = run_scene(scene, "tolerance", tolerance).trajectory
    near = run_scene(scene, "tolerance", NEIGHBOUR * tolerance).trajectory
    if tight is None or near is None:
        return Reference(f"{method}: not all of them reached the end", None, NOTHING)
    parted = parting(scene, tight, near)
    horizon = scene.duration
    if parted.horizon is not None:  # of whole milliseconds, as steps are
        horizon = INSTANTS_APART * max(1.0, np.floor(parted.horizon / INSTANTS_APART))
        parted = replace(parted, horizon=horizon)
    until_horizon = scene.replace(revolutions=scene.revolutions * horizon / scene.duration)
    coarse = run_scene(until_horizon, "step", 2.0 * step).trajectory
    fine = run_scene(until_horizon, "step", step).trajectory
    if coarse is None or fine is None:
        return Reference(f"{method}: not all of them reached the end", None, NOTHING)
    instants = instants_until(horizon)
    position, velocity = (
        float(np.abs(_at_zero(c, f) - t).max())
        for c, f, t in zip(*(run.at(instants) for run in (coarse, fine, tight)), strict=True)
    )
    peak = errors_of(fine, tight, horizon).peak_acceleration  # as sampled; no order to rely on
    difference = Errors(position, velocity, peak)
    starts: tuple[Trajectory, ...] = ()
    if parted.horizon is not None:
        starts = _starts(scene, LOOSER * tolerance, amount.starts)
    return Reference(f"{method}, extrapolated", tight, difference, parted, starts)


def _starts(scene: Scene, tolerance: float, count: int) -> tuple[Trajectory, ...]:
    """Return runs from starts beside the scene's own."""
    runs = (run_scene(moved(scene, -n), "tolerance", tolerance) for n in range(1, count + 1))
    return tuple(run.trajectory for run in runs if run.trajectory is not None)


def _at_zero(coarse: Array, fine: Array) -> Array:
    """Return what a second-order method would give at step zero, from a step and its double."""
    return np.asarray(fine + (fine - coarse) / 3.0)
