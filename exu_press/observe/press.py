"""What press builders look at: dead centres, tilt, drive, shaking force, guides."""

from typing import Any

import numpy as np

from exu_press.arrays import Array
from exu_press.mechanism import Guide
from exu_press.observe.acceleration import mean_peak_of, peak
from exu_press.observe.dead_centre import bottom_dead_centres
from exu_press.piecewise import integral
from exu_press.result import Result
from exu_press.result.channel import guide_channel
from exu_press.scene import mechanism_of
from exu_press.scene.applied import applied_loads

__all__ = ["begin_of_whole_revolutions", "mean_rate", "press_summary"]


def press_summary(result: Result) -> dict[str, Any]:
    """Return strokes, drive, shaking, loads and guides of any mechanism for summary.json, SI.

    Peaks are largest magnitudes over the whole run; where impacts dominate them, they are given of
    the mean over 1 ms too, as accelerations are. Other means are over its last whole revolutions,
    since over a part of one they tell what the mechanism stores; null in a shorter run.

    Guides rub where `[guide]` has a clearance and friction; `dissipated` and `mean_power` have what
    that takes. A guide's `sliding_power` is the mean of side force times sliding speed: of one that
    does not rub, times a coefficient of friction, it is what that would take, W, beside the losses
    and the drive's power.
    """
    time, whole = result.time, begin_of_whole_revolutions(result)
    return {
        "strokes": _strokes(result),
        "slider_tilt": peak(result["slider_tilt"]),
        "slider_lateral": peak(result["slider_lateral"]),
        "drive": {
            "peak_torque": peak(result["drive_torque"]),
            "peak_torque_mean_1ms": mean_peak_of(time, result["drive_torque"]),
            "mean_torque": _mean(time, result["drive_torque"], whole),
            "peak_power": peak(result["drive_power"]),
            "mean_power": _mean(time, result["drive_power"], whole),
            **_speed(result, whole),
        },
        "shaking": {
            **_resultant(result, "shaking_force"),
            "without_counterweight": _resultant(result, "shaking_force_without_counterweight"),
            "frame": _resultant(result, "frame_force"),
        },
        "loads": {
            name: {
                "peak_force": peak(result[f"load_{name}_force"]),
                "work": float(result[f"load_{name}_work"][-1]),
            }
            for name in applied_loads(result.scene)
        },
        "guides": {
            guide.body: _guide(result, guide, whole) for guide in mechanism_of(result.scene).guides
        },
    }


def _guide(result: Result, guide: Guide, whole: float | None) -> dict[str, float | None]:
    """Return what one guide carries, dissipates and would take if it rubbed."""
    name, time = guide_channel(mechanism_of(result.scene), guide.body), result.time
    channels = {q: f"{name}_{q}" for q in ("force", "friction", "moment", "loss")}
    found = {
        quantity: result[channel] for quantity, channel in channels.items() if channel in result
    }
    sliding = None
    if "force" in found and len(time) > 1:
        position = result["body_position"][:, result.bodies.index(guide.body), :2]
        speed = np.gradient(position @ np.array(guide.direction), time)
        sliding = _mean(time, np.abs(found["force"] * speed), whole)
    lost = found.get("loss", np.zeros_like(time))
    return {
        "peak_force": peak(found["force"]) if "force" in found else None,
        "sliding_power": sliding,
        "peak_friction": peak(found["friction"]) if "friction" in found else None,
        "peak_moment": peak(found["moment"]) if "moment" in found else None,
        "dissipated": float(lost[-1]),
        "mean_power": mean_rate(time, lost, whole),
    }


def _speed(result: Result, whole: float | None) -> dict[str, float | None]:
    """Return mean and fluctuation of a motor's speed at the crank; null at constant speed.

    The coefficient of fluctuation is the largest less the smallest speed over the mean one.
    """
    found: dict[str, float | None] = {"mean_speed_rpm": None, "fluctuation": None}
    if result.scene.drive is None or whole is None:
        return found
    time, speed = result.time, result["crank_speed"]
    mean = _mean(time, speed, whole)
    assert mean is not None
    inside = speed[time >= whole]
    found["mean_speed_rpm"] = mean * 30.0 / np.pi
    found["fluctuation"] = float(np.ptp(inside)) / abs(mean) if mean else None
    return found


def _strokes(result: Result) -> dict[str, Any]:
    """Return the bottom dead centre of every stroke and how they scatter (repeatability)."""
    found = bottom_dead_centres(result)
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


def _resultant(result: Result, name: str) -> dict[str, Any]:
    """Return the peaks of a sum over the mechanism; null where there is none."""
    entries: dict[str, Any] = {}
    for column, direction in enumerate(("horizontal", "vertical")):
        force = result[name][:, column] if name in result else None
        entries[direction] = None if force is None else peak(force)
        mean = None if force is None else mean_peak_of(result.time, force)
        entries[f"{direction}_mean_1ms"] = mean
    return entries


def begin_of_whole_revolutions(result: Result) -> float | None:
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
    return mean_rate(time, integral(time, values), begin)


def mean_rate(time: Array, amount: Array, begin: float | None) -> float | None:
    """Return the mean rate of change of a channel (n,) from an instant on, None without one."""
    if begin is None:
        return None
    return float((amount[-1] - np.interp(begin, time, amount)) / (time[-1] - begin))
