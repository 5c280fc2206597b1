"""Channels of a run, one quantity over time each, and how recorders declare them."""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

from exu_press.errors import InputError
from exu_press.mechanism import Mechanism, Point
from exu_press.numerics.arrays import Array
from exu_press.schema.stored import LARGEST

__all__ = [
    "AXES",
    "NO_BRAKE",
    "NO_CLUTCH",
    "OWN",
    "OWNERS",
    "UNBALANCED",
    "VECTOR",
    "Channel",
    "Declaration",
    "Declarations",
    "direction_text",
    "guide_channel",
]

AXES = {
    "": (),
    "plane": ("x", "y"),
    "space": ("x", "y", "z"),
    "pose": ("x", "y", "angle"),
    "ends": ("journal", "bearing"),
    "guided": ("back", "front"),
}
"""The columns of a channel."""


@dataclass(frozen=True)
class Channel:
    """One recorded quantity.

    Attributes:
        values: (n,), or (n, k) with one of AXES as columns, or (n, bodies, 3) for "pose".
        unit: SI.
        long_name: its meaning in words.
        axis: name of the columns: in AXES, or BODY_mode for a flexible body's modes.

    Raises:
        InputError: the values have another shape, or one of them is no number.
    """

    values: Array
    unit: str
    long_name: str
    axis: str = ""

    def __post_init__(self) -> None:
        shape, columns = self.values.shape, AXES.get(self.axis)
        axes = {"": 1, "pose": 3}.get(self.axis, 2)
        if len(shape) != axes or (columns and shape[-1] != len(columns)):
            raise InputError(f"{self.long_name}: shape {shape}; columns are {self.axis!r}")
        most, least = self.values.max(initial=0.0), self.values.min(initial=0.0)
        if not -LARGEST < least <= most < LARGEST:  # nor where one is no number
            raise InputError(f"{self.long_name}: allowed are numbers below {LARGEST:g}")


VECTOR = "vector"
"""Columns of a vector: "space" at a spherical joint, "plane" elsewhere."""

OWNERS = {
    "": "every run",
    "joint": "ideal joints whose force is known",
    "loose": "joints with clearance",
    "warm": "lubricated joints whose oil warms",
    "uneven": "joints that are worn from the start, or whose journal is inclined",
    "wearing": "joints whose wear is asked for",
    "guide": "guides; that of the slider is `guide`",
    "gear": "gears whose torque is determined",
    "spring": "springs between bodies",
    "load": "loads",
    "body": "flexible bodies",
    "pivoted": "joints of flexible bodies that turn on the frame",
    "bent": "joints of flexible bodies that are no balls",
}
"""Kind of a channel's owner -> the runs that have it."""

OWN = "with items of a user's own in the model"
UNBALANCED = "of a mechanism without counterweight"
NO_CLUTCH, NO_BRAKE = "of a drive without clutch", "of a drive without brake"


@dataclass(frozen=True)
class Declaration:
    """Name, unit, meaning and columns of a channel, and which runs have it.

    Attributes:
        name: in braces its owner's kind, one of OWNERS; nothing in braces is the whole run's.
        unit: SI.
        meaning: in words; in braces its owner, and which direction is `positive`.
        axis: meaning of its columns, in AXES or VECTOR.
        always: whether all runs with such an owner have it.
        unless: which runs do not have it.
    """

    name: str
    unit: str
    meaning: str
    axis: str = ""
    always: bool = True
    unless: str = ""

    @cached_property
    def owner(self) -> str:
        """Kind of its owner."""
        return self.name.partition("{")[2].partition("}")[0]

    def name_of(self, owner: str) -> str:
        """Return the channel's name at an owner."""
        return self.name.format(**{self.owner: owner}) if self.owner else self.name

    def axis_of(self, owner: str, *, spherical: bool) -> str:
        """Return the meaning of its columns at an owner."""
        if self.axis == VECTOR:
            return "space" if spherical else "plane"
        return self.axis.format(**{self.owner: owner}) if self.owner else self.axis


class Declarations(tuple[Declaration, ...]):
    """Channels that a recorder declares."""

    def __new__(cls, *declared: Declaration) -> Self:
        """Return the channels in the order of tables."""
        return super().__new__(cls, declared)

    def record(
        self, owner: str = "", *, label: str = "", positive: str = "", **values: Array
    ) -> dict[str, Channel]:
        """Return channels by their names in a run.

        Args:
            owner: joint, guide, load or body to which they belong.
            label: of the owner in their meaning; its name unless given.
            positive: direction.
            values: over time, by the declared name behind the owner.
        """
        by_quantity = {declared.name.rpartition("}_")[2]: declared for declared in self}
        channels = {}
        for quantity, history in values.items():
            declared = by_quantity[quantity]
            axis = declared.axis_of(owner, spherical=history.shape[1:] == (3,))
            texts = {declared.owner or "run": label or owner.replace("_", " ")}
            meaning = declared.meaning.format(**texts, positive=positive)
            channels[declared.name_of(owner)] = Channel(history, declared.unit, meaning, axis)
        return channels


def guide_channel(mechanism: Mechanism, name: str) -> str:
    """Return the prefix of the names of a guide's channels; the slider's is "guide"."""
    of_slider = mechanism.frame_guide(mechanism.slider)
    if of_slider is not None and name == of_slider.name:
        return "guide"
    return f"{name}_slot" if mechanism.guide(name).is_slot else f"{name}_guide"


def direction_text(direction: Point) -> str:
    """Return the direction of a unit vector in the drawing, in words.

    >>> direction_text((0.0, 1.0)), direction_text((0.6, 0.8))
    ('upwards', 'along [0.6, 0.8]')
    """
    x, y = (round(component, 9) + 0.0 for component in direction)
    names = {
        (0.0, 1.0): "upwards",
        (0.0, -1.0): "downwards",
        (1.0, 0.0): "to the right",
        (-1.0, 0.0): "to the left",
    }
    return names.get((x, y), f"along [{x:.4g}, {y:.4g}]")
