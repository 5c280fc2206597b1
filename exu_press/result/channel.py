"""One recorded quantity over time."""

from dataclasses import dataclass

from exu_press.errors import InputError
from exu_press.mechanism import Mechanism, Point
from exu_press.numerics.arrays import Array
from exu_press.schema.stored import LARGEST

__all__ = ["AXES", "Channel", "guide_channel", "positive"]

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


def guide_channel(mechanism: Mechanism, body: str) -> str:
    """Return the beginning of the names of a guide's channels; the slider's is the guide."""
    return "guide" if body == mechanism.slider else f"{body}_guide"


def positive(direction: Point) -> str:
    """Return in words which way a unit vector of the drawing points.

    >>> positive((0.0, 1.0)), positive((0.6, 0.8))
    ('upwards', 'along [0.6, 0.8]')
    """
    x, y = (round(part, 9) + 0.0 for part in direction)
    words = {
        (0.0, 1.0): "upwards",
        (0.0, -1.0): "downwards",
        (1.0, 0.0): "to the right",
        (-1.0, 0.0): "to the left",
    }
    return words.get((x, y), f"along [{x:.4g}, {y:.4g}]")
