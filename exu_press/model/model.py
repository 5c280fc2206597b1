"""An assembled Exudyn system and what its items are called."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import exudyn as exu

from exu_press.integrate import Outcome, Tuning
from exu_press.model.loads import Place, next_corner
from exu_press.rigid import RigidBody
from exu_press.scene.applied import AppliedLoad
from exu_press.solving import DEFAULTS, Assembled, solve

if TYPE_CHECKING:
    from exu_press.placed_part import PlacedPart

__all__ = ["Model", "count_items"]


@dataclass(frozen=True)
class Model(Assembled):
    """An assembled system and what its items are called.

    Attributes:
        SC: Exudyn's system container; its main system is `mbs`.
        bodies: name -> object number.
        rigid: name -> rigid body.
        drive: object number of the constraint that turns the crank.
        loads: name -> load that acts, and what tells its place on its curve.
        parts: name -> flexible body's part; empty for rigid bodies.
        made: number of objects and loads that the scene was made of.
    """

    SC: exu.SystemContainer
    bodies: dict[str, int]
    rigid: Mapping[str, RigidBody]
    drive: int
    loads: Mapping[str, tuple[AppliedLoad, Place]]
    parts: Mapping[str, "PlacedPart"]
    made: int

    @property
    def own_items(self) -> int:
        """Number of objects and loads that the user has added since."""
        return count_items(self.mbs) - self.made

    def solve(self, *, tuning: Tuning = DEFAULTS, quiet: bool = True) -> Outcome:
        """Run to the end time or to an early stop; what was computed stays in the sensors.

        Items that were added to `mbs` since, and assembled, take part.
        `exu_press.result.record(model, outcome)` makes a result of it.

        Args:
            tuning: the numbers of step control, to vary them.
            quiet: False shows the progress on standard error.
        """
        return solve(self, tuning=tuning, quiet=quiet)

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a load has a corner, s, or infinity."""
        return next_corner(self.loads, self.scene, time)


def count_items(mbs: exu.MainSystem) -> int:
    """Return the number of objects and loads of a system."""
    return int(mbs.systemData.NumberOfObjects() + mbs.systemData.NumberOfLoads())
