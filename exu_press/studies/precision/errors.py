"""Distance of a trajectory from the reference: pointwise up to a horizon, by its peaks beyond it.

Trajectories diverge in dry impacts, so that after a while no two integrators agree point by point.
What happens then is compared as a whole: how large the peaks of the acceleration are.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from exu_press.numerics.arrays import Array
from exu_press.result import Result

__all__ = [
    "INSTANTS_APART",
    "Errors",
    "Trajectory",
    "errors_of",
    "instants_until",
    "peaks_error",
    "trajectory_of",
]


@dataclass(frozen=True)
class Trajectory:
    """The slider's motion at the instants of a solver.

    Attributes:
        time: (n,), s, increasing.
        position: (n,), m.
        velocity: (n,), m/s.
        acceleration: (n,), m/s^2.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array

    def interpolate(self, instants: Array) -> tuple[Array, Array]:
        """Return position and velocity at other instants, (m,), by cubic Hermite polynomials."""
        position = CubicHermiteSpline(self.time, self.position, self.velocity)
        velocity = CubicHermiteSpline(self.time, self.velocity, self.acceleration)
        return np.asarray(position(instants)), np.asarray(velocity(instants))

    def until(self, end: float) -> "Trajectory":
        """Return the part before an instant, s."""
        is_before = self.time <= end * (1.0 + 1e-12)
        return Trajectory(*(values[is_before] for values in vars(self).values()))


def trajectory_of(result: Result) -> Trajectory:
    """Return the trajectory in a result."""
    names = "slider_position", "slider_velocity", "slider_acceleration"
    return Trajectory(result.time, *(result[name] for name in names))


INSTANTS_APART = 1e-3
"""s, between the instants that are compared: every fixed step up to it lands on them."""

PEAKS_APART = 0.0125
"""s; at 240 rpm a twentieth of a revolution. The largest acceleration in each such span is a peak:
that needs no threshold, and no two count for one impact."""


@dataclass(frozen=True)
class Errors:
    """Largest errors up to the horizon; None where there is nothing to compare.

    Attributes:
        position: m (rad for the squeezer).
        velocity: m/s (rad/s).
        peak_acceleration: of the largest magnitude, relative.
    """

    position: float | None
    velocity: float | None
    peak_acceleration: float | None


def instants_until(horizon: float) -> Array:
    """Return the instants that are compared, s."""
    count = int(horizon / INSTANTS_APART * (1 + 1e-9)) + 1
    return np.asarray(INSTANTS_APART * np.arange(count), dtype=float)


def errors_of(run: Trajectory, reference: Trajectory, horizon: float) -> Errors:
    """Return the errors of a completed run."""
    instants = instants_until(horizon)
    (position, velocity), (x, v) = run.interpolate(instants), reference.interpolate(instants)
    peak, true_peak = (float(np.abs(t.until(horizon).acceleration).max()) for t in (run, reference))
    return Errors(
        float(np.abs(position - x).max()),
        float(np.abs(velocity - v).max()),
        abs(peak / true_peak - 1.0),
    )


def peaks_error(
    run: Trajectory,
    reference: Trajectory,
    starts: Sequence[Trajectory] = (),
    reference_starts: Sequence[Trajectory] = (),
) -> float:
    """Return the error of a whole run's peaks, one in each span of PEAKS_APART, relative.

    The larger one of their mean and of their 95th percentile; both are means over all starts.

    Args:
        reference: the truth until trajectories diverge.
        starts: more of the run, from starts that differ by less than is known.
        reference_starts: the same of the reference.
    """
    errors = _peaks((run, *starts)) / _peaks((reference, *reference_starts)) - 1.0
    return float(np.abs(errors).max())


def _peaks(runs: Sequence[Trajectory]) -> Array:
    """Return mean and 95th percentile of a run's peaks, m/s^2, as means over runs."""
    statistics = []
    for run in runs:
        count = max(1, round(float(run.time[-1] - run.time[0]) / PEAKS_APART))
        bounds = run.time[0] + PEAKS_APART * np.arange(count)
        peaks = np.maximum.reduceat(np.abs(run.acceleration), np.searchsorted(run.time, bounds))
        statistics.append((peaks.mean(), np.percentile(peaks, 95)))
    return np.asarray(np.mean(statistics, axis=0))
