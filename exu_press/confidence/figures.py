"""The headline figures of a summary by their dotted names."""

from collections.abc import Mapping
from typing import Any

__all__ = ["figures"]

NO_FIGURES = {
    "scene",
    "versions",
    "errors",
    "errors_from",
    "amplification",
    "warnings",
    "end_time",
    "wall_time",
    "total_time",
    "steps",
    "rejected_steps",
    "newton_iterations",
    "law_evaluations",
    "own_items",
    "coordinates",
    "bodies",
    "connectors",
    "clearance",
    "residual",
    "time",
}
"""Keys of what is asked, of what the run took, of what is a measure of error itself, and of the
instants of peaks: two that are nearly as high may change places."""


def figures(summary: Mapping[str, Any], prefix: str = "") -> dict[str, float]:
    """Return every figure of a summary, as "joints.crank_pin.peak_force"; counts are figures too.

    >>> figures({"stroke": 0.026, "peak_acceleration": {"resolved": 857.0, "mean_1ms": None}})
    {'stroke': 0.026, 'peak_acceleration.resolved': 857.0}
    """
    found: dict[str, float] = {}
    for key, value in summary.items():
        if key in NO_FIGURES:
            continue
        if isinstance(value, Mapping):
            found |= figures(value, f"{prefix}{key}.")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            found[prefix + key] = float(value)
    return found
