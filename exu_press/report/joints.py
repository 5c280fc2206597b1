"""Every joint of a run in one table: what the few in the summary's lines leave out."""

from collections.abc import Mapping
from typing import Any

from exu_press.observe.uncertain import uncertain
from exu_press.plots.words import joint_in_words
from exu_press.report.html import table

__all__ = ["joint_table"]

MOST_JOINTS = 3
"""Joints with clearance that the lines of the summary name."""

COLUMNS: dict[str, tuple[str, float]] = {
    "peak force, kN": ("peak_force", 1e-3),
    "eccentricity ratio, max": ("max_eccentricity_ratio", 1.0),
    "penetration, max, um": ("peak_penetration", 1e6),
    "film, min, um": ("min_film", 1e6),
    "impacts": ("impacts", 1.0),
    "share in contact": ("share_contact", 1.0),
    "dissipated, J": ("dissipated", 1.0),
}
"""Head -> entry of a joint in the summary, and the factor to its unit."""


def joint_table(summary: Mapping[str, Any]) -> str:
    """Return a table of all joints, those with the largest forces first; nothing where few are.

    Args:
        summary: of the run.
    """
    joints, errors = summary["joints"], summary.get("errors", {})
    if sum(joint["kind"] != "ideal" for joint in joints.values()) <= MOST_JOINTS:
        return ""
    rows = []
    for name in sorted(joints, key=lambda name: -joints[name]["peak_force"]):
        joint = joints[name]
        clearance = f"{joint['clearance'] * 1e6:g}" if joint["clearance"] else "-"
        figures = [
            uncertain(joint.get(entry), errors.get(f"joints.{name}.{entry}"), scale)
            for entry, scale in COLUMNS.values()
        ]
        rows.append([joint_in_words(name), joint["kind"], clearance, *figures])
    return table(("joint", "kind", "clearance, um", *COLUMNS), rows, "All joints")
