"""What is read off a run: the measures that the paper's numbers and trends are compared with."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from exu_press.observe import differentiated_peak, mean_peak, peak
from exu_press.result import Result
from exu_press.scene import IdealJoint, mechanism_of
from paper.contact_modes import contact_modes

__all__ = ["MODELS", "OBSERVED", "WHY_OBSERVED", "observed_span", "readings"]

Array = NDArray[np.float64]

MODELS = ("resolved", "mean_1ms", "differentiated_1khz")
"""Of observation: the integrator's own steps, means over 1 ms, 1 kHz samples."""

OBSERVED = "mean_1ms"
"""The one that verdicts are made under, for every number alike."""

WHY_OBSERVED = (
    "The paper's program printed one value a millisecond, from steps of a millisecond: what an "
    "impact of 75 us does in such a step is its change of velocity, spread over the step. The mean "
    "over a moving millisecond is that, and unlike samples it does not depend on where they fall."
)

WINDOW = 1e-3  # s
RATE = 1e3  # samples per second


def observed_span(result: Result) -> tuple[float, float]:
    """Return from when to when a run is observed, s: its last revolution, or all of a short run."""
    end = float(result.time[-1])
    turn = 60.0 / result.scene.speed_rpm
    return (max(0.0, end - turn) if end > 1.5 * turn else 0.0), end


def readings(result: Result, span: tuple[float, float] | None = None) -> dict[str, Any]:
    """Return every measure of a run: numbers, or one number under each of MODELS.

    Args:
        result: of the run.
        span: from when to when, s; `observed_span` unless told.

    Returns:
        peak_acceleration (m/s^2), peak_velocity (m/s) and bottom_dead_centre (m) under each model;
        bottom_dead_centres (m) of every stroke; oscillation_frequency (Hz); joints: contact modes
        and largest force of each; losses: mean powers (W) of the balls' contact and of the pin,
        whose film is sheared and pressed.
    """
    start, end = span or observed_span(result)
    inside = (result.time >= start - 1e-12) & (result.time <= end + 1e-12)
    time = result.time[inside]
    position, velocity, acceleration = (
        result[f"slider_{level}"][inside] for level in ("position", "velocity", "acceleration")
    )
    motion = CubicHermiteSpline(time, position, velocity)
    samples = motion(np.arange(time[0], time[-1], 1.0 / RATE))
    return {
        "peak_acceleration": {
            "resolved": peak(acceleration),
            "mean_1ms": mean_peak(time, velocity),
            "differentiated_1khz": differentiated_peak(time, position, velocity),
        },
        "peak_velocity": {
            "resolved": peak(velocity),
            "mean_1ms": _largest_mean_velocity(time, motion),
            "differentiated_1khz": peak(np.diff(samples) * RATE) if len(samples) > 1 else None,
        },
        "bottom_dead_centre": {
            "resolved": float(position.min()),
            "mean_1ms": _lowest_mean(time, motion),
            "differentiated_1khz": float(samples.min()),
        },
        "bottom_dead_centres": _bottom_dead_centres(result),
        "oscillation_frequency": _oscillation_frequency(result, time, motion),
        "joints": {name: _joint(result, name, inside) for name in result.clearance_joints},
        "losses": _losses(result, inside),
    }


def _largest_mean_velocity(time: Array, motion: CubicHermiteSpline) -> float | None:
    late = time[time >= time[0] + WINDOW]
    return peak((motion(late) - motion(late - WINDOW)) / WINDOW) if len(late) else None


def _lowest_mean(time: Array, motion: CubicHermiteSpline) -> float | None:
    """Return the least position averaged over the window."""
    late = time[time >= time[0] + WINDOW]
    area = motion.antiderivative()
    return float(((area(late) - area(late - WINDOW)) / WINDOW).min()) if len(late) else None


def _bottom_dead_centres(result: Result) -> list[float]:
    """Return the lowest position of every complete revolution, m."""
    turns = (result["crank_angle"] - result["crank_angle"][0]) / (2.0 * np.pi)
    position = result["slider_position"]
    whole = int(turns[-1] + 1e-6)
    return [
        float(position[(turns >= n - 1e-9) & (turns <= n + 1 + 1e-9)].min()) for n in range(whole)
    ]


def _oscillation_frequency(result: Result, time: Array, motion: CubicHermiteSpline) -> float | None:
    """Return the mean frequency of the velocity's deviation from the ideal, in 1 kHz samples, Hz.

    It is Rice's: the root of the mean square of the derivative over that of the deviation, over
    2 pi (S. O. Rice, Bell System Technical Journal 24 (1945) 46-156); none without a deviation.
    """
    at = np.arange(time[0], time[-1], 1.0 / RATE)
    if len(at) < 3:
        return None
    angle = result.scene.start_angle + result.scene.angular_speed * at
    ideal = mechanism_of(result.scene).ideal_slider(angle, result.scene.angular_speed)[1]
    deviation = motion(at, 1) - ideal
    size = float(np.std(deviation))
    if size < 1e-9:
        return None
    return float(np.sqrt(np.mean(np.diff(deviation) ** 2)) * RATE / (2.0 * np.pi * size))


def _losses(result: Result, inside: NDArray[np.bool_]) -> dict[str, float]:
    """Return mean powers over the instants that are `inside` (n,), W: of both balls and the pin."""
    time = result.time[inside]
    span = float(time[-1] - time[0]) or 1.0
    lost = {"balls": 0.0, "pin": 0.0}
    for name in result.clearance_joints:
        energy = result[f"{name}_loss"][inside]
        lost["pin" if name == "crank_pin" else "balls"] += float(energy[-1] - energy[0]) / span
    return lost


def _joint(result: Result, name: str, inside: NDArray[np.bool_]) -> dict[str, Any]:
    """Return contact modes, largest force (N) and eccentricity ratio of one joint."""
    joint, record = result.scene.joints[name], result.joints[name]
    assert not isinstance(joint, IdealJoint)
    gap = record.gap[inside]
    return {
        **contact_modes(result.time[inside], (joint.onset or 0.0) - gap),
        "peak_force": peak(np.linalg.norm(record.force[inside], axis=1)),
        "max_eccentricity_ratio": float(record.distance[inside].max() / joint.clearance),
    }
