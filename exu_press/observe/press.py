"""What press builders look at: dead centres, tilt, drive, shaking force, forces and losses."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid

from exu_press.observe.acceleration import mean_peak, peak
from exu_press.observe.dead_centre import bottom_dead_centres
from exu_press.result import Result

__all__ = ["press_summary"]

Array = NDArray[np.float64]

RESULTANTS = ("shaking_force", "shaking_force_without_counterweight", "frame_force")
NOT_CARRIED = (*RESULTANTS, "blanking_force", "blanking_moment")
"""Forces and moments that are no joint's and no guide's."""


def press_summary(result: Result, joints: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return the entries of "press" in summary.json, SI.

    Peaks are largest magnitudes over the whole run; where impacts dominate them, they are given of
    the mean over 1 ms too, as accelerations are. Other means are over its last whole revolutions,
    since over a part of one they tell what the mechanism stores; null in a shorter run.

    Guides do not rub. `guide_sliding_power` is the mean of side force times sliding speed, summed
    over the guides: times a coefficient of friction it is what rubbing guides would take, W, beside
    the losses and the drive's power.

    Args:
        result: of a press.
        joints: what the summary says of its clearance joints.
    """
    time, whole = result.time, _begin_of_whole_revolutions(result)
    films = [film for joint in joints.values() if (film := joint.get("min_film")) is not None]
    return {
        "bottom_dead_centre": _dead_centres(result),
        "slider_tilt": peak(result["slider_tilt"]),
        "slider_lateral": peak(result["slider_lateral"]),
        "drive": {
            "peak_torque": peak(result["drive_torque"]),
            "peak_torque_mean_1ms": _mean_peak(time, result["drive_torque"]),
            "mean_torque": _mean(time, result["drive_torque"], whole),
            "peak_power": peak(result["drive_power"]),
            "mean_power": _mean(time, result["drive_power"], whole),
        },
        **{name: _resultant(result, name) for name in RESULTANTS},
        "peak_forces": _peaks(result, "_force"),
        "peak_moments": _peaks(result, "_moment"),
        "losses": {
            name.removesuffix("_loss"): {
                "energy": float(result[name][-1]),
                "mean_power": _mean_rate(time, result[name], whole),
            }
            for name in result
            if name.endswith("_loss")
        },
        "guide_sliding_power": _mean(time, _sliding_power(result), whole),
        "min_film": min(films, default=None),
    }


def _sliding_power(result: Result) -> Array:
    """Return side force times sliding speed of all guides, (n,), W; tilting moments left out."""
    power = np.zeros_like(result.time)
    if len(power) < 2:
        return power
    for name in result:
        if name.endswith("guide_force"):
            body = name.removesuffix("guide_force").removesuffix("_")
            height = result["body_position"][:, result.bodies.index(body or "slider"), 1]
            power += np.abs(result[name] * np.gradient(height, result.time))
    return power


def _dead_centres(result: Result) -> dict[str, Any]:
    """Return the bottom dead centre of every stroke and how they scatter (repeatability)."""
    found = bottom_dead_centres(
        result.time, result["crank_angle"], result["slider_position"], result["slider_velocity"]
    )
    positions = np.array([centre.position for centre in found])
    instants = [centre.time for centre in found]
    tilts = np.interp(instants, result.time, result["slider_tilt"])
    several = len(found) > 1
    return {
        "positions": positions.tolist(),
        "crank_angles_deg": [float(np.degrees(centre.crank_angle)) for centre in found],
        "tilts": tilts.tolist(),
        "mean": float(positions.mean()) if found else None,
        "range": float(np.ptp(positions)) if several else None,
        "standard_deviation": float(positions.std(ddof=1)) if several else None,
    }


def _resultant(result: Result, name: str) -> dict[str, float | None] | None:
    """Return the peaks of a sum over the mechanism, or None where there is none."""
    if name not in result:
        return None
    entries: dict[str, float | None] = {}
    for direction, force in zip(("horizontal", "vertical"), result[name].T, strict=True):
        entries[direction] = peak(force)
        entries[f"{direction}_mean_1ms"] = _mean_peak(result.time, force)
    return entries


def _peaks(result: Result, suffix: str) -> dict[str, float]:
    """Return the largest magnitude of what every joint or guide carries."""
    return {
        name.removesuffix(suffix): peak(values if values.ndim == 1 else np.hypot.reduce(values, 1))
        for name, values in ((name, result[name]) for name in result)
        if name.endswith(suffix)
        and name not in NOT_CARRIED
        and result.channels[name].axis != "ends"
    }


def _begin_of_whole_revolutions(result: Result) -> float | None:
    """Return the instant from which to the end the crank turns whole revolutions, or None."""
    angle = result["crank_angle"]
    turns = np.floor((angle[-1] - angle[0]) / (2 * np.pi) + 1e-6)
    if turns < 1.0:
        return None
    return max(
        float(result.time[0]), float(np.interp(angle[-1] - 2 * np.pi * turns, angle, result.time))
    )


def _mean(time: Array, values: Array, begin: float | None) -> float | None:
    """Return the mean of a channel (n,) from an instant on, None without one."""
    if begin is None:
        return None
    return _mean_rate(time, _integral(time, values), begin)


def _mean_rate(time: Array, amount: Array, begin: float | None) -> float | None:
    """Return the mean rate of change of a channel (n,) from an instant on, None without one."""
    if begin is None:
        return None
    return float((amount[-1] - np.interp(begin, time, amount)) / (time[-1] - begin))


def _mean_peak(time: Array, values: Array) -> float | None:
    """Return the largest magnitude of the mean over 1 ms, None where the record is shorter."""
    return mean_peak(time, _integral(time, values))


def _integral(time: Array, values: Array) -> Array:
    return np.asarray(cumulative_trapezoid(values, time, initial=0.0))
