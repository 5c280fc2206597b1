"""Depths worn off a joint's surfaces: the [joints.NAME.worn] table of a scene."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.laws.profile import Profile, profile
from exu_press.schema.checks import key
from exu_press.schema.table import Table

__all__ = ["WornDepths"]

FEWEST = 3


@dataclass(frozen=True)
class WornDepths(Table):
    """Depths worn off journal and bearing over the angle on each, from its body's x axis."""

    table: ClassVar[str] = "worn"
    angle_deg: tuple[float, ...] | None = key(
        None, "of the depths, counter-clockwise; all around in equal steps from 0 unless given",
        "deg", numbers=0,
    )  # fmt: skip
    bearing_depth: tuple[float, ...] | None = key(None, "worn off the bearing", "m", numbers=0)
    journal_depth: tuple[float, ...] | None = key(None, "worn off the journal", "m", numbers=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        both = {"bearing_depth": self.bearing_depth, "journal_depth": self.journal_depth}
        profiles = {name: depths for name, depths in both.items() if depths is not None}
        if not profiles:
            raise InputError("worn: allowed is a table with bearing_depth, journal_depth or both")
        for name, depths in profiles.items():
            if len(depths) < FEWEST or min(depths) < 0.0:
                raise InputError(
                    f"worn.{name}: {len(depths)} values, the least of them {min(depths, default=0)}"
                    f"; allowed are at least {FEWEST} numbers >= 0 (m)"
                )
        angles = self.angle_deg
        counts = {len(depths) for depths in profiles.values()}
        if angles is not None:
            counts.add(len(angles))
            for previous, following in pairwise(angles):
                if not previous < following < angles[0] + 360.0:
                    raise InputError(
                        f"worn.angle_deg = {following!r} after {previous!r}: allowed is "
                        "increasing, within one turn"
                    )
        if len(counts) > 1:
            raise InputError(
                f"worn: lists of {' and '.join(map(str, sorted(counts)))} values; allowed are as "
                "many depths as angles"
            )

    @property
    def even(self) -> float:
        """The mean depth of both surfaces together, by which the clearance is larger, m."""
        return sum(self._profile(depths).mean for depths in self._depths)

    def profiles(self) -> tuple[Profile, Profile] | None:
        """Return the wear of journal and bearing beyond their means; None where there is none."""
        if all(min(depths) == max(depths) for depths in self._depths):
            return None
        journal, bearing = (self._profile(d, self._profile(d).mean) for d in self._depths)
        return journal, bearing

    def whole(self) -> tuple[Profile, Profile]:
        """Return the whole wear of journal and bearing."""
        journal, bearing = (self._profile(depths) for depths in self._depths)
        return journal, bearing

    def refuse_sharp(self, clearance: float) -> None:
        """Refuse a shape that the journal cannot follow, with the clearance before any wear, m.

        Raises:
            InputError: somewhere the surface bends away faster than the journal can follow.
        """
        least = clearance + sum(self._profile(depths).sharpest for depths in self._depths)
        if least <= 0.0:
            raise InputError(
                "worn: depths change so fast with the angle that the journal would touch beside "
                f"the deepest place: clearance + w + w'' is {least:.3g} m where it is least; "
                "allowed are depths with which it is > 0, as `exu_press.laws.wear.reached` makes "
                "them"
            )

    @property
    def _depths(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Depths of journal and bearing; zeros where none are given."""
        journal, bearing = self.journal_depth, self.bearing_depth
        none = (0.0,) * len(journal or bearing or ())
        return journal or none, bearing or none

    def _profile(self, depths: tuple[float, ...], less: float = 0.0) -> Profile:
        count = len(depths)
        angles = (
            [2.0 * math.pi * i / count for i in range(count)]
            if self.angle_deg is None
            else [math.radians(angle) for angle in self.angle_deg]
        )
        return profile(angles, depths, less)
