"""A declaration of a channel: name, unit, meaning, columns, and which runs have it."""

from dataclasses import dataclass
from functools import cached_property

from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel

__all__ = ["NO_BRAKE", "NO_CLUTCH", "OWN", "PLACES", "UNBALANCED", "VECTOR", "Declared"]

VECTOR = "vector"
"""Columns of a vector: "space" at a spherical joint, "plane" elsewhere."""

PLACES = {
    "": "every run",
    "joint": "ideal joints whose force is known",
    "loose": "joints with clearance",
    "warm": "lubricated joints whose oil warms",
    "worn": "joints that are worn from the start",
    "wearing": "joints whose wear is asked for",
    "guide": "guides; that of the slider is `guide`",
    "load": "loads",
    "body": "flexible bodies",
    "faced": "joints of flexible bodies that turn on the frame",
}
"""Owner of a channel -> the runs that have it."""

OWN = "with items of a user's own in the model"
UNBALANCED = "of a mechanism without counterweight"
NO_CLUTCH, NO_BRAKE = "of a drive without clutch", "of a drive without brake"


@dataclass(frozen=True)
class Declared:
    """A channel.

    Attributes:
        name: in braces its owner, one of PLACES; nothing in braces is the whole run's.
        unit: SI.
        meaning: in words; in braces its place, and which `way` is positive.
        axis: meaning of its columns, see `exu_press.result.channel.AXES`, or VECTOR.
        always: whether all runs with such a place have it.
        unless: which runs do not have it.
    """

    name: str
    unit: str
    meaning: str
    axis: str = ""
    always: bool = True
    unless: str = ""

    def axis_at(self, place: str, *, spherical: bool) -> str:
        """Return the meaning of its columns at a place."""
        if self.axis == VECTOR:
            return "space" if spherical else "plane"
        return self.axis.format(**{self.of: place}) if self.of else self.axis

    @cached_property
    def of(self) -> str:
        """Its owner."""
        return self.name.partition("{")[2].partition("}")[0]

    def at(self, place: str) -> str:
        """Return its name at a place."""
        return self.name.format(**{self.of: place}) if self.of else self.name

    def record(
        self, values: Array, place: str = "", *, words: str = "", way: str = ""
    ) -> dict[str, Channel]:
        """Return the channel of a run, by its name there.

        Args:
            values: over time.
            place: joint, guide, load or body to which it belongs.
            words: for the place, unless its name says it.
            way: that is positive.
        """
        axis = self.axis_at(place, spherical=values.shape[1:] == (3,))
        named = {self.of or "whole": words or place.replace("_", " "), "way": way}
        return {self.at(place): Channel(values, self.unit, self.meaning.format(**named), axis)}
