"""What a reader of a report should know first, and the assumptions behind it."""

from collections.abc import Mapping
from typing import Any

from exu_press.scene import Scene
from exu_press.scene.assumptions import used_assumptions

__all__ = ["assumption_rows", "warnings_of"]


def warnings_of(summary: Mapping[str, Any]) -> list[str]:
    """Return how a run ended, unless it completed, and its warnings."""
    ended = [f"{summary['status']}: {summary['reason']}"] if summary["reason"] else []
    return [*ended, *summary["warnings"]]


def assumption_rows(scene: Scene) -> list[list[str]]:
    """Return number, text, and the keys left at their defaults, for every assumption in use."""
    return [
        [f"A-{assumption.number}", assumption.text, ", ".join(map(str, keys))]
        for assumption, keys in used_assumptions(scene).items()
    ]
