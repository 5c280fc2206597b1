"""Depths of wear on a joint's surfaces, and the scene that has them."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.laws.profile import profile
from exu_press.laws.wear import Contacts, accessible_depths, worn_after
from exu_press.numerics.arrays import Array
from exu_press.quantities.wear import SECTORS
from exu_press.scene import DryJoint, LubricatedJoint, Scene

__all__ = ["ANGLES", "Depths", "initial_depths", "worn_scene"]

ANGLES = 2.0 * np.pi * (np.arange(SECTORS) + 0.5) / SECTORS
"""Middles of the sectors, rad."""

LEAST = 1e-15
"""m: a smaller depth is rounding of the smoothing."""


@dataclass(frozen=True)
class Depths:
    """Worn depths of journal and bearing by sectors, (72,) each, m."""

    journal: Array
    bearing: Array

    @classmethod
    def even(cls, depth: float) -> "Depths":
        """Return equal depths of the bearing all around, m."""
        return cls(np.zeros(SECTORS), np.full(SECTORS, depth))

    def add_strokes(self, strokes: float, clearance: float, contacts: Contacts) -> "Depths":
        """Return the depths after strokes with some contacts, for an unworn clearance, m."""
        return Depths(*worn_after(self.journal, self.bearing, clearance, contacts, strokes))

    def accessible(self, clearance: float) -> "Depths":
        """Return the depths that are in reach of the mating surface, for an unworn clearance, m."""
        journal = accessible_depths(self.journal, 0.5 * clearance)
        sharpest = profile(ANGLES.tolist(), journal.tolist()).sharpest
        return Depths(journal, accessible_depths(self.bearing, clearance + min(0.0, sharpest)))

    @property
    def deepest(self) -> float:
        """Largest clearance that they add, m."""
        return float(self.journal.max() + self.bearing.max())

    def difference(self, depths: "Depths") -> float:
        """Return the largest difference from other depths, m."""
        journal, bearing = self.journal - depths.journal, self.bearing - depths.bearing
        return float(max(np.abs(journal).max(), np.abs(bearing).max()))


def initial_depths(scene: Scene, joint: str) -> Depths:
    """Return the wear of a scene's joint at the start."""
    worn = _rubbing(scene, joint).worn
    if worn is None:
        return Depths.even(0.0)
    return Depths(*(np.array([s.derivatives(a)[0] for a in ANGLES.tolist()]) for s in worn.whole()))


def worn_scene(scene: Scene, worn: Mapping[str, Depths]) -> Scene:
    """Return a scene with worn joints, as far as depths are accessible."""
    changes = {}
    for name, depths in worn.items():
        if not (depths.journal.any() or depths.bearing.any()):
            continue
        shape = depths.accessible(_rubbing(scene, name).clearance)
        changes[f"joints.{name}.worn"] = {
            "angle_deg": np.degrees(ANGLES).round(9).tolist(),
            "bearing_depth": np.where(shape.bearing < LEAST, 0.0, shape.bearing).tolist(),
            "journal_depth": np.where(shape.journal < LEAST, 0.0, shape.journal).tolist(),
        }
    return scene.replace(changes) if changes else scene


def _rubbing(scene: Scene, joint: str) -> DryJoint | LubricatedJoint:
    described = scene.joints[joint]
    assert isinstance(described, DryJoint | LubricatedJoint)
    return described
