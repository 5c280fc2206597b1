"""What a reader of a run should know before believing it."""

from collections.abc import Mapping
from typing import Any

from exu_press.scene import Scene
from exu_press.scene.assumptions import assumed_line, used_assumptions

__all__ = ["assumption_rows", "warnings_of"]

RESIDUAL = 0.01
"""Of the largest work; beyond this the energy balance casts doubt on the integration."""

NEARLY_TOUCHING = 0.95
"""Eccentricity ratio from which a film is thinner than its law is good for."""


def warnings_of(summary: Mapping[str, Any], scene: Scene) -> list[str]:
    """Return warnings about a run, the gravest first; the defaults that were assumed come last."""
    found = []
    if summary["reason"]:
        found.append(f"{summary['status']}: {summary['reason']}")
    residual = summary["energy"]["residual"]
    if residual > RESIDUAL:
        found.append(
            f"the energy balance misses {residual:.2g} of the largest work: try a smaller "
            "solver.tolerance or solver.step"
        )
    for name, joint in summary["joints"].items():
        lubricated = joint["kind"] == "lubricated"
        if lubricated and (ratio := joint["max_eccentricity_ratio"]) > NEARLY_TOUCHING:
            found.append(
                f"{name.replace('_', ' ')}: eccentricity ratio up to {ratio:.3f}; film laws for "
                "smooth surfaces are hardly valid there"
            )
    line = assumed_line(scene)
    if line:
        found.append(f"{line}: defaults of this program, not the paper's")
    return found


def assumption_rows(scene: Scene) -> list[list[str]]:
    """Return number, text, and the keys left at their defaults, for every assumption in use."""
    return [
        [f"A-{assumption.number}", assumption.text, ", ".join(map(str, keys))]
        for assumption, keys in used_assumptions(scene).items()
    ]
