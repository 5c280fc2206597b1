"""A quantity of interest: declared once, read by everything that shows, compares or varies it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any

from exu_press.quantities.kind import Kind
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene

__all__ = ["Extreme", "Place", "Quantity", "always"]


class Place(Enum):
    """The owner of a quantity; the value begins its full name."""

    RUN = ""
    JOINT = "joints"
    GUIDE = "guides"
    LOAD = "loads"
    BODY = "bodies"


class Extreme(Enum):
    """Kinds of extremes over a run, which the run continued can only exceed."""

    NONE = "none"
    LARGEST = "largest"
    LEAST = "least"


PREFIXES = {"n": 1e9, "u": 1e6, "m": 1e3, "k": 1e-3, "M": 1e-6, "": 1.0}

SIZED = ("m/s", "m/s^2", "N", "N m", "J", "W")
"""Units that a small machine has with smaller prefixes; lengths are in mm and um anyway."""

SMALL = 1e-3
"""In the unit that is usually shown: a line whose values are all below it has another one."""


def exact_laws(scene: Scene, owner: str, value: float) -> float:
    """Return 0.0: no law that decides the value is a table."""
    return 0.0


def always(scene: Scene, place: str) -> bool:
    """Say that every scene with such a place has the quantity."""
    return True


@dataclass(frozen=True)
class Quantity:
    """One number of a run.

    Attributes:
        name: within its place, as "peak_force" of a joint; dotted where it has variants.
        unit: SI; "" where it has none.
        meaning: one sentence or phrase.
        kind: from which its error follows.
        read: returns it from a reading and the name of the place ("" of the run); None where the
            run is too short to have it.
        place: its owner.
        has: whether a scene has it at a place, known before it runs.
        title: of its line in tables, without unit; "" where it is in none.
        shown: the unit in which tables show it; the SI unit unless given.
        digits: shown where no error is known.
        under: whether its line is a detail of the line above.
        signed: whether it may be below zero.
        extreme: whether it is the largest or the least value.
        at_most: name of the quantity at the same place that is never below it, or "".
        headline: whether it is among those that everybody looks at first.
        cumulative: whether it adds up over a run.
        of_laws: a scene, the place and the value -> what errors of tabulated laws make of it.
        curve: whose extreme it is: a channel, CHANNEL:x of one of its columns, or, at a place, what
            the place's channel ends in; "ratio" and "gap" follow from a joint's eccentricity.
    """

    name: str
    unit: str
    meaning: str
    kind: Kind
    read: Callable[[Reading, str], Any]
    place: Place = Place.RUN
    has: Callable[[Scene, str], bool] = always
    title: str = ""
    shown: str = ""
    digits: int = 4
    under: bool = False
    signed: bool = False
    extreme: Extreme = Extreme.NONE
    at_most: str = ""
    headline: bool = False
    cumulative: bool = False
    of_laws: Callable[[Scene, str, float], float] = exact_laws
    curve: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "shown", self.shown or self.unit)

    def full_name(self, owner: str) -> str:
        """Return the name in tables and files: that of its joint, guide, body or load before it.

        >>> from exu_press.quantities import CATALOGUE
        >>> next(q for q in CATALOGUE if q.name == "min_film").full_name("crank_pin")
        'joints.crank_pin.min_film'
        """
        return self.name if self.place is Place.RUN else f"{self.place.value}.{owner}.{self.name}"

    def in_scaled_unit(self, values: Iterable[float]) -> "Quantity":
        """Return the quantity in the unit of small machines, where its own makes values small.

        >>> from exu_press.quantities.catalogue import JOINT_FORCE
        >>> [JOINT_FORCE.in_scaled_unit([largest]).shown for largest in (2e3, 0.02)]
        ['kN', 'mN']
        """
        largest = max(map(abs, values), default=0.0)
        if self.unit not in SIZED or not 0.0 < largest * self.scale < SMALL:
            return self
        prefix = next(
            (candidate for candidate in ("", "m", "u") if largest * PREFIXES[candidate] >= 1.0), "n"
        )
        return replace(self, shown=f"{prefix}{self.unit}")

    @property
    def scale(self) -> float:
        """Factor from the SI unit to the one that tables show."""
        if self.shown == self.unit:
            return 1.0
        return PREFIXES[self.shown.removesuffix(self.unit)]

    @property
    def head(self) -> str:
        """Its title with the unit that is shown."""
        return f"{self.title}, {self.shown}" if self.shown else self.title
