"""The table [output]: contents of a run's file, and samples of the run."""

import fnmatch
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from exu_press.errors import InputError
from exu_press.schema.checks import check_increasing, key, nearest
from exu_press.schema.table import Table, nested_table

if TYPE_CHECKING:
    from exu_press.mechanism.section import Section
    from exu_press.scene.readings import Readings

__all__ = ["Output"]

ALWAYS = "time", "crank_angle"
"""Channels by which the others are read; every file keeps them."""


@dataclass(frozen=True)
class Output(Table):
    """Contents of a run's file: channels, their density, and samples where steps end exactly.

    Quantities are read from all channels at all steps, before any of them are left out.

    Raises:
        InputError: the angles are not between 0 and 360 deg, or not increasing; or channels are no
            list of names.
    """

    table: ClassVar[str] = "output"
    samples: tuple[float, ...] = key(
        None, "crank angles of every revolution, on each of which a step ends", "deg", numbers=0
    )
    channels: str | tuple[str, ...] = key(
        "all",
        'a list of the channels that the file keeps, by name or pattern, as "*_force"',
        choices=("all",),
        also=tuple,
    )
    readings: "Readings | None" = nested_table("scene.readings:Readings")
    every: int = key(1, "of so many steps the file keeps one", at_least=1)

    def __post_init__(self) -> None:
        if isinstance(self.channels, list):
            object.__setattr__(self, "channels", tuple(self.channels))
        super().__post_init__()
        if not all(isinstance(name, str) for name in self.channels):
            raise InputError(
                f"output.channels = {self.channels!r:.200}: allowed is a list of texts"
            )
        angles = self.samples or ()
        for angle in angles:
            if not 0.0 <= angle < 360.0:
                raise InputError(f"output.samples = {angle!r}: allowed are numbers from 0 to < 360")
        check_increasing("output.samples", angles)
        if self.samples == ():
            raise InputError("output.samples: allowed is at least one crank angle, in deg")

    @property
    def whole(self) -> bool:
        """Return whether the file keeps every channel at every step."""
        return self.channels == "all" and self.every == 1

    def kept_channels(self, names: Iterable[str]) -> list[str]:
        """Return those of some channels that the file keeps, with time and crank angle.

        Raises:
            InputError: a name or a pattern is none of them.
        """
        known = list(names)
        if isinstance(self.channels, str):
            return known
        names_kept = {*ALWAYS}
        for pattern in self.channels:
            matching = fnmatch.filter(known, pattern)
            if not matching:
                raise InputError(
                    f"output.channels: {pattern!r} is no channel of this scene"
                    f"{nearest(pattern, known)}; allowed are patterns, and {', '.join(known)}"
                )
            names_kept.update(matching)
        return [name for name in known if name in names_kept]

    def section(self, start: float) -> "Section":
        """Return the samples of a run that starts at a crank angle, rad."""
        from exu_press.mechanism.section import Section

        return Section([math.radians(angle) for angle in self.samples], start)
