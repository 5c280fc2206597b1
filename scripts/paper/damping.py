"""The contact damping of Table 2, which can be read in two ways."""

from collections.abc import Mapping
from pathlib import Path

from exu_press.scene import Scene

__all__ = ["DAMPINGS", "DIMENSIONAL", "directory_of", "with_damping"]

DIMENSIONAL = "2.5545e8"
"""The reading that scenes have by default."""

DAMPINGS: Mapping[str, float] = {DIMENSIONAL: 2.5545e8, "0.01": 0.01}
"""What c_max (N s/m) is taken for: Table 2's value in SI units, or its 0.01, which has no unit.

Section 3.4 explains 0.01 as the part of the stiffness that the damping is; taken literally it is
almost no damping, in SI units as in the mm, kg, s of ADAMS (10 N s/m).
"""


def with_damping(scene: Scene, damping: str) -> Scene:
    """Return a scene with one of DAMPINGS; without contact there is nothing to change."""
    if scene.contact is None:
        return scene
    return scene.replace("contact.damping_max", DAMPINGS[damping])


def directory_of(directory: Path, damping: str) -> Path:
    """Return where results and pictures of one reading are kept.

    >>> directory_of(Path("out"), "0.01").name
    'c_max_0.01'
    """
    return directory if damping == DIMENSIONAL else directory / f"c_max_{damping}"
