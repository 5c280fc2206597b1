"""What a reader of a run should know before believing its figures."""

from collections.abc import Mapping
from typing import Any

from exu_press.scene import Scene
from exu_press.scene.warnings import scene_warnings

__all__ = ["run_warnings"]

RESIDUAL = 0.01
"""Of the energy exchanged; beyond this the energy balance casts doubt on the integration."""

NEARLY_TOUCHING = 0.95
"""Eccentricity ratio from which a film is thinner than its law is good for."""


def run_warnings(summary: Mapping[str, Any], scene: Scene) -> list[str]:
    """Return the warnings of summary.json: about the run's figures, then about what was asked."""
    found = []
    residual = summary["energy"]["residual"]
    if summary["own_items"]:
        found.append(
            "no energy balance: what your own items put in, store and dissipate is not known"
        )
    if residual is not None and residual > RESIDUAL:
        found.append(
            f"the energy balance misses {residual:.2g} of the energy: try a smaller "
            "solver.tolerance or solver.step"
        )
    for name, joint in summary["joints"].items():
        lubricated = joint["kind"] == "lubricated"
        if lubricated and (ratio := joint["max_eccentricity_ratio"]) > NEARLY_TOUCHING:
            found.append(
                f"{name.replace('_', ' ')}: eccentricity ratio up to {ratio:.3f}; film laws for "
                "smooth surfaces are hardly valid there"
            )
    return [*found, *scene_warnings(scene)]
