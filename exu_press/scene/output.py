"""The table [output]: at which crank angles a run is sampled."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.mechanism.section import Section
from exu_press.schema.checks import Table, key

__all__ = ["Output"]


@dataclass(frozen=True)
class Output(Table):
    """What a run keeps beside its channels: samples at crank angles, where steps end exactly.

    Raises:
        InputError: the angles are not between 0 and 360 deg, or not increasing.
    """

    table: ClassVar[str] = "output"
    samples: tuple[float, ...] = key(
        None, "crank angles of every revolution, on each of which a step ends", "deg", numbers=0
    )

    def __post_init__(self) -> None:
        """Check the angles."""
        super().__post_init__()
        angles = self.samples or ()
        for angle in angles:
            if not 0.0 <= angle < 360.0:
                raise InputError(f"output.samples = {angle!r}: allowed are numbers from 0 to < 360")
        for before, after in pairwise(angles):
            if not after > before:
                raise InputError(
                    f"output.samples = {after!r} after {before!r}: allowed is increasing"
                )
        if not angles:
            raise InputError("output.samples: allowed is at least one crank angle, in deg")

    def section(self, start: float) -> Section:
        """Return the samples of a run that starts at a crank angle, rad."""
        return Section([math.radians(angle) for angle in self.samples], start)
