"""The truth of a case: from two integrators that share as little as possible.

Their mutual difference says how true it is. An error below ten times that difference says nothing
but "at most this", and stands in the report as that.
"""

from dataclasses import dataclass

from exu_press.studies.precision.errors import Errors
from exu_press.studies.precision.trajectory import Trajectory

__all__ = ["RESERVE", "Reference"]

RESERVE = 10.0
"""An error must be this many times the references' mutual difference to be believed."""


@dataclass(frozen=True)
class Reference:
    """What runs are compared with.

    Attributes:
        method: where it comes from, in words.
        trajectory: None if it could not be made.
        difference: between the two integrators, up to the horizon; zeros where it is exact.
    """

    method: str
    trajectory: Trajectory | None
    difference: Errors

    @property
    def floor(self) -> Errors:
        """Smallest errors that can be told."""
        d = self.difference
        return Errors(_above(d.position), _above(d.velocity), _above(d.peak_acceleration))


def _above(difference: float | None) -> float | None:
    return None if difference is None else RESERVE * difference
