"""References of runs, and their own error.

From two integrators that share as little as possible. Their mutual difference says how true it is:
an error below ten times that difference says nothing but "at most this", and stands in the report
as that.
"""

from dataclasses import astuple, dataclass, replace

import numpy as np

from exu_press.scene import Scene, mechanism_of
from exu_press.studies.precision.errors import (
    INSTANTS_APART,
    Errors,
    Trajectory,
    errors_of,
    instants_until,
)
from exu_press.studies.precision.timing import run_scene, shift_start
from exu_press.verification.growth import Growth, growth

__all__ = ["Reference", "closed_form", "divergence", "from_own"]

RESERVE = 10.0
"""An error must be this many times the references' mutual difference to be believed."""

DIVERGED = 1e-3
"""Distance of two sliders over the smallest clearance, beyond which neither is a reference."""

NO_GROWTH = Growth(None, None)
"""Growth of trajectories that do not diverge."""

KINEMATIC_STEP = 1e-5  # s, between the points of a closed-form trajectory

NO_ERRORS = Errors(None, None, None)

NEIGHBOUR_TOLERANCE = 4.0
"""Tolerance of the neighbouring run over the reference's."""

START_TOLERANCE = 10.0
"""The same of further starts, which diverge at the same instant whatever it is."""


@dataclass(frozen=True)
class Reference:
    """The reference of runs.

    Attributes:
        method: where it comes from, in words.
        trajectory: None if it could not be made.
        difference: between the two integrators, up to the horizon; zeros where it is exact.
        diverged: how fast neighbouring motions diverge, and the horizon.
        starts: further trajectories, of starts that differ by rounding, where trajectories
            diverge before the end.
    """

    method: str
    trajectory: Trajectory | None
    difference: Errors
    diverged: Growth = NO_GROWTH
    starts: tuple[Trajectory, ...] = ()

    @property
    def floor(self) -> Errors:
        """Smallest errors that this reference resolves."""
        differences = astuple(self.difference)
        return Errors(*(None if d is None else RESERVE * d for d in differences))


def closed_form(scene: Scene) -> Reference:
    """Return the kinematics of ideal joints, which need no integrator and never diverge."""
    count = round(scene.duration / KINEMATIC_STEP)
    time = np.linspace(0.0, scene.duration, count + 1)
    angle = scene.start_angle + scene.angular_speed * time
    motion = mechanism_of(scene).ideal_slider(angle, scene.angular_speed)
    return Reference("closed-form kinematics", Trajectory(time, *motion), Errors(0.0, 0.0, 0.0))


def from_own(scene: Scene, tolerance: float, step: float, starts: int) -> Reference:
    """Return the tightest tolerance, checked against fixed steps extrapolated to zero.

    A run at NEIGHBOUR_TOLERANCE times the tolerance measures how fast trajectories diverge, and
    so the horizon.

    Args:
        step: smallest fixed one, with twice it beside, s.
        starts: further ones, where trajectories diverge.
    """
    method = f"tolerance {tolerance:.0e} against fixed steps {2 * step:.0e}, {step:.0e} s"
    tight = run_scene(scene, "tolerance", tolerance).trajectory
    near = run_scene(scene, "tolerance", NEIGHBOUR_TOLERANCE * tolerance).trajectory
    failed = Reference(f"{method}: not all of them reached the end", None, NO_ERRORS)
    if tight is None or near is None:
        return failed
    diverged = divergence(scene, tight, near)
    horizon = scene.duration
    if diverged.horizon is not None:  # of whole milliseconds, as steps are
        horizon = INSTANTS_APART * max(1.0, np.floor(diverged.horizon / INSTANTS_APART))
        diverged = replace(diverged, horizon=horizon)
    until_horizon = scene.replace({"revolutions": scene.revolutions * horizon / scene.duration})
    coarse = run_scene(until_horizon, "step", 2.0 * step).trajectory
    fine = run_scene(until_horizon, "step", step).trajectory
    if coarse is None or fine is None:
        return failed
    instants = instants_until(horizon)
    position, velocity = (
        float(np.abs(f + (f - c) / 3.0 - t).max())  # second order, at step zero
        for c, f, t in zip(
            *(run.interpolate(instants) for run in (coarse, fine, tight)), strict=True
        )
    )
    peak = errors_of(fine, tight, horizon).peak_acceleration  # as sampled; no order to rely on
    difference = Errors(position, velocity, peak)
    runs = [
        run_scene(shift_start(scene, -n), "tolerance", START_TOLERANCE * tolerance).trajectory
        for n in range(1, starts + 1 if diverged.horizon is not None else 1)
    ]
    neighbours = tuple(run for run in runs if run is not None)
    return Reference(f"{method}, extrapolated", tight, difference, diverged, neighbours)


def divergence(scene: Scene, first: Trajectory, second: Trajectory) -> Growth:
    """Return the growth of two trajectories' distance, up to DIVERGED."""
    clearances = [joint.clearance for joint in scene.joints.with_clearance.values()]
    clearances += [
        g.guideway.clearance for g in mechanism_of(scene).guides if g.guideway is not None
    ]
    if not clearances:
        return NO_GROWTH
    second_position, _ = second.interpolate(np.clip(first.time, second.time[0], second.time[-1]))
    return growth(first.time, np.abs(first.position - second_position) / min(clearances), DIVERGED)
