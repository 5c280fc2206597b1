"""One scene that is judged."""

from dataclasses import dataclass

from exu_press.scene import Scene

__all__ = ["PAIRS", "Case"]

PAIRS = "pairs of extremes"
"""The axis of those cases that are at the end of two axes at once."""


@dataclass(frozen=True)
class Case:
    """One scene of a table.

    Attributes:
        name: unique.
        axis: what is varied.
        value: in words, as the map shows it; of a pair, the two.
        scene: complete.
    """

    name: str
    axis: str
    value: str
    scene: Scene
