"""The dictionary of summary.json."""

from typing import Any

import numpy as np

from exu_press.observe.acceleration import differentiated_peak, mean_peak, peak
from exu_press.observe.clearance import joint_summary
from exu_press.observe.energy import energy_summary
from exu_press.observe.fatigue import fatigue_summary
from exu_press.observe.press import begin_of_whole_revolutions, mean_rate, press_summary
from exu_press.observe.warnings import run_warnings
from exu_press.result import Result
from exu_press.scene import IdealJoint

__all__ = ["summary"]


def summary(result: Result) -> dict[str, Any]:
    """Return what interface and terminal show of a run: plain numbers, texts and dictionaries."""
    info = dict(result.info)
    versions = info.pop("versions")
    time, position = result.time, result["slider_position"]
    velocity = result["slider_velocity"]
    joints = {name: _joint(result, name) for name in result.joints}
    found = {
        **info,
        "peak_acceleration": {
            "resolved": peak(result["slider_acceleration"]),
            "mean_1ms": mean_peak(time, velocity),
            "differentiated_1khz": differentiated_peak(time, position, velocity),
        },
        "peak_velocity": peak(velocity),
        "stroke": float(np.ptp(position)),
        "bottom_dead_centre": float(position.min()),
        "joints": joints,
        **press_summary(result),
        "energy": energy_summary(result),
        "versions": versions,
        "scene": result.scene.to_dict(),
    }
    if lives := fatigue_summary(result):
        found["fatigue"] = lives
    return found | {"warnings": run_warnings(found, result.scene)}


def _joint(result: Result, name: str) -> dict[str, Any]:
    """Return the entries of one joint."""
    joint = result.scene.joints[name]
    entries = joint_summary(
        result.time,
        result.joints[name],
        onset=None if isinstance(joint, IdealJoint) else joint.onset,
    )
    if not isinstance(joint, IdealJoint):
        lost = result[f"{name}_loss"]
        entries["dissipated"] = float(lost[-1])
        entries["mean_power"] = mean_rate(result.time, lost, begin_of_whole_revolutions(result))
    return entries
