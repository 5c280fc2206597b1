"""The truth of a case: from two integrators that share as little as possible.

Their mutual difference says how true it is. An error below ten times that difference says nothing
but "at most this", and stands in the report as that.
"""

from dataclasses import dataclass

import numpy as np

from exu_press.confidence import Growth, growth
from exu_press.scene import Scene, mechanism_of
from exu_press.studies.precision.errors import Errors
from exu_press.studies.precision.trajectory import Trajectory

__all__ = ["KNOWN", "RESERVE", "STAYS", "Reference", "parting"]

RESERVE = 10.0
"""An error must be this many times the references' mutual difference to be believed."""

KNOWN = 1e-3
"""Of the smallest clearance: two references whose sliders are further apart are none any more."""

STAYS = Growth(None, None)
"""Of motions that do not part."""


@dataclass(frozen=True)
class Reference:
    """What runs are compared with.

    Attributes:
        method: where it comes from, in words.
        trajectory: None if it could not be made.
        difference: between the two integrators, up to the horizon; zeros where it is exact.
        parted: how fast neighbouring motions part, and the horizon: from when on errors exceed what
            is looked at.
        starts: further trajectories, of starts that differ by what nobody knows, where motions part
            before the end.
    """

    method: str
    trajectory: Trajectory | None
    difference: Errors
    parted: Growth = STAYS
    starts: tuple[Trajectory, ...] = ()

    @property
    def floor(self) -> Errors:
        """Smallest errors that can be told."""
        d = self.difference
        return Errors(_above(d.position), _above(d.velocity), _above(d.peak_acceleration))


def parting(scene: Scene, one: Trajectory, other: Trajectory) -> Growth:
    """Return how two trajectories of a scene part, until they are KNOWN apart."""
    clearances = [joint.clearance for joint in scene.joints.with_clearance.values()]
    clearances += [g.ways.clearance for g in mechanism_of(scene).guides if g.ways is not None]
    if not clearances:
        return STAYS
    there, _ = other.at(np.clip(one.time, other.time[0], other.time[-1]))
    return growth(one.time, np.abs(one.position - there) / min(clearances), KNOWN)


def _above(difference: float | None) -> float | None:
    return None if difference is None else RESERVE * difference
