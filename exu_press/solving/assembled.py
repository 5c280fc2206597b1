"""What solving needs of a scene's model."""

from collections.abc import Mapping
from typing import Protocol

import exudyn as exu

from exu_press.joints.joint import ClearanceJoint
from exu_press.mechanism import Mechanism
from exu_press.mechanism.holding import Holding
from exu_press.scene import Scene

__all__ = ["Assembled"]


class Assembled(Protocol):
    """What solving needs of a scene's model; `exu_press.model.Model` is one."""

    @property
    def scene(self) -> Scene:
        """What was asked."""

    @property
    def mechanism(self) -> Mechanism:
        """Bodies, joints and guides."""

    @property
    def holding(self) -> Holding:
        """Which ideal joints and guides hold what."""

    @property
    def mbs(self) -> exu.MainSystem:
        """Exudyn's main system, assembled."""

    @property
    def nodes(self) -> Mapping[str, int]:
        """Name -> node number."""

    @property
    def clearance_joints(self) -> Mapping[str, ClearanceJoint]:
        """Name -> joint."""

    @property
    def ways(self) -> Mapping[str, tuple[ClearanceJoint, ClearanceJoint]]:
        """Name of a body with play in its guide -> the contacts of its two ends."""

    @property
    def sensors(self) -> Mapping[tuple[str, str], int]:
        """(name, quantity) -> sensor number."""

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a load has a corner, s, or infinity."""
