"""Distance of a trajectory from the reference: pointwise up to a horizon, by figures beyond it.

Trajectories diverge in dry impacts, so that after a while no two integrators agree point
by point. What happens then is compared as a whole: when surfaces touch, how large the forces are,
and how far apart the graphs of the velocity lie.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.distance import directed_hausdorff

from exu_press.numerics.arrays import Array, lengths
from exu_press.result import Result

__all__ = [
    "INSTANTS_APART",
    "Errors",
    "Trajectory",
    "WholeRunErrors",
    "errors_of",
    "instants_until",
    "trajectory_of",
    "whole_run_errors",
]


@dataclass(frozen=True)
class Trajectory:
    """The slider's motion at the instants of a solver, and one joint's force and penetration.

    Attributes:
        time: (n,), s, increasing.
        position: (n,), m.
        velocity: (n,), m/s.
        acceleration: (n,), m/s^2.
        force: (n,) magnitude of the joint force, N; None without a clearance joint.
        penetration: (n,) eccentricity less clearance, m; None of a joint without contact.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    force: Array | None = None
    penetration: Array | None = None

    def interpolate(self, instants: Array) -> tuple[Array, Array]:
        """Return position and velocity at other instants, (m,), by cubic Hermite polynomials."""
        position = CubicHermiteSpline(self.time, self.position, self.velocity)
        velocity = CubicHermiteSpline(self.time, self.velocity, self.acceleration)
        return np.asarray(position(instants)), np.asarray(velocity(instants))

    def until(self, end: float) -> "Trajectory":
        """Return the part before an instant, s."""
        is_before = self.time <= end * (1.0 + 1e-12)
        parts: list[Any] = [v if v is None else v[is_before] for v in vars(self).values()]
        return Trajectory(*parts)


def trajectory_of(result: Result) -> Trajectory:
    """Return the trajectory in a result; the joint is its first dry one, else its first one."""
    names = result.clearance_joints
    dry = [name for name in names if result.joints[name].kind == "dry"]
    force = penetration = None
    if names:
        joint = result.joints[(dry or list(names))[0]]
        force = lengths(joint.force)
        penetration = -joint.gap if dry else None
    return Trajectory(
        result.time,
        result["slider_position"],
        result["slider_velocity"],
        result["slider_acceleration"],
        force,
        penetration,
    )


INSTANTS_APART = 1e-3
"""s, between the instants that are compared: every fixed step up to it lands on them."""

PEAKS_APART = 0.0125
"""s; at 240 rpm a twentieth of a revolution. The largest acceleration in each such span is a peak:
that needs no threshold, and no two count for one impact."""

GRAPH_POINTS = 4001
"""Points of a graph over the whole run; the distance is resolved to about the run's length over
this."""


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


@dataclass(frozen=True)
class WholeRunErrors:
    """Errors of figures of a whole dry run, in which trajectories diverge.

    Attributes:
        impacts: touches in the joint.
        impact_time: largest difference of the touches' instants, s; None unless as many as in the
            reference.
        peak_force: relative error.
        rms_force: relative error.
        graph_distance: Hausdorff distance of the slider velocity's graph, time over the run's
            length and velocity over its peak.
        mean_of_peaks: relative error of the mean of its acceleration's peaks, one in each span of
            PEAKS_APART; the mean over all starts.
        large_peaks: the same of their 95th percentile.
    """

    impacts: int
    impact_time: float | None
    peak_force: float
    rms_force: float
    graph_distance: float
    mean_of_peaks: float
    large_peaks: float


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


def whole_run_errors(
    run: Trajectory,
    reference: Trajectory,
    starts: Sequence[Trajectory] = (),
    reference_starts: Sequence[Trajectory] = (),
) -> WholeRunErrors | None:
    """Return the errors of figures of a whole dry run; None where no surfaces touch.

    Args:
        reference: the truth until trajectories diverge.
        starts: more of the run, from starts that differ by less than is known.
        reference_starts: the same of the reference.
    """
    if run.force is None or reference.force is None or run.penetration is None:
        return None
    if not reference.force.any():
        return None
    touches, true_touches = _touches(run), _touches(reference)
    same = len(touches) == len(true_touches) > 0
    rms, true_rms = _rms(run), _rms(reference)
    mean, large = _peaks((run, *starts))
    true_mean, true_large = _peaks((reference, *reference_starts))
    return WholeRunErrors(
        impacts=len(touches),
        impact_time=float(np.abs(touches - true_touches).max()) if same else None,
        peak_force=abs(float(run.force.max()) / float(reference.force.max()) - 1.0),
        rms_force=abs(rms / true_rms - 1.0),
        graph_distance=_graph_distance(run, reference),
        mean_of_peaks=abs(mean / true_mean - 1.0),
        large_peaks=abs(large / true_large - 1.0),
    )


def _peaks(runs: Sequence[Trajectory]) -> tuple[float, float]:
    """Return mean and 95th percentile of a run's peaks, m/s^2, as means over runs."""
    statistics = []
    for run in runs:
        count = max(1, round(float(run.time[-1] - run.time[0]) / PEAKS_APART))
        bounds = run.time[0] + PEAKS_APART * np.arange(count)
        peaks = np.maximum.reduceat(np.abs(run.acceleration), np.searchsorted(run.time, bounds))
        statistics.append((float(peaks.mean()), float(np.percentile(peaks, 95))))
    mean, large = np.mean(statistics, axis=0)
    return float(mean), float(large)


def _touches(run: Trajectory) -> Array:
    """Return the instants at which surfaces begin to touch, s."""
    assert run.penetration is not None
    touching = run.penetration > 0.0
    return np.asarray(run.time[1:][touching[1:] & ~touching[:-1]])


def _rms(run: Trajectory) -> float:
    assert run.force is not None
    mean_square = np.trapezoid(run.force**2, run.time) / (run.time[-1] - run.time[0])
    return float(np.sqrt(mean_square))


def _graph_distance(run: Trajectory, reference: Trajectory) -> float:
    end, speed = float(reference.time[-1]), float(np.abs(reference.velocity).max())
    instants = np.linspace(0.0, end, GRAPH_POINTS)
    graphs = [
        np.column_stack([instants / end, np.interp(instants, t.time, t.velocity) / speed])
        for t in (run, reference)
    ]
    return float(max(directed_hausdorff(*graphs)[0], directed_hausdorff(*graphs[::-1])[0]))
