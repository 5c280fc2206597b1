"""Declaration of a quantity of interest."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from enum import Enum
from typing import Any

from exu_press.quantities.kind import Kind
from exu_press.quantities.reading import Reading
from exu_press.quantities.uncertain import UNDERFLOW
from exu_press.scene import Scene

__all__ = ["Extreme", "Owner", "Quantity", "always"]


class Owner(Enum):
    """Kinds of owners of quantities; the value begins the full name."""

    RUN = ""
    JOINT = "joints"
    GUIDE = "guides"
    GEAR = "gears"
    SPRING = "springs"
    LOAD = "loads"
    BODY = "bodies"


class Extreme(Enum):
    """Kinds of extremes over a run, which the run continued can only exceed."""

    NONE = "none"
    LARGEST = "largest"
    LEAST = "least"


PREFIXES = {"n": 1e9, "u": 1e6, "m": 1e3, "k": 1e-3, "M": 1e-6, "": 1.0}

SCALED_UNITS = {"m/s": "mun", "m/s^2": "mun", **dict.fromkeys(("N", "N m", "J", "W"), "Mkmun")}
"""Unit -> prefixes that it may have in tables; lengths are in mm and um anyway."""

LEAST, MOST = 0.1, 1e4
"""Largest values of a line of a table that keep the usual unit."""


def exact_laws(scene: Scene, owner: str, value: float) -> float:
    """Return 0.0: no tabulated law decides the value."""
    return 0.0


def always(scene: Scene, owner: str) -> bool:
    """Return True: every scene with such an owner has the quantity."""
    return True


@dataclass(frozen=True)
class Quantity:
    """One number of a run.

    Attributes:
        name: without its owner, as "peak_force" of a joint; dotted where it has variants.
        unit: SI; "" where it has none.
        meaning: one sentence or phrase.
        kind: from which its least error follows.
        read: reading and name of the owner ("" of the run) -> value, None where the run is too
            short.
        owner: kind of its owner.
        available: scene and name of the owner -> whether its runs have the quantity.
        title: of its line in tables, without unit; "" where it is in none.
        display_unit: of tables; the SI unit unless given.
        digits: in tables, where no error is known.
        is_detail: whether its line is a detail of the line above.
        signed: whether it may be below zero.
        extreme: whether it is the largest or the least value.
        upper_bound: name of the quantity of the same owner that is never below it, or "".
        headline: whether it is among those that everybody looks at first.
        cumulative: whether it adds up over a run.
        law_error: scene, owner and value -> its error by those of tabulated laws.
        curve: whose extreme it is: a channel, CHANNEL:x of one of its columns, or the ending of a
            channel of the owner; "ratio" and "gap" follow from a joint's eccentricity.
        observe: window of a mean (s) or rate of samples (Hz), reading and owner -> value, of one
            that [output] readings may read with others than its own; None of all others.
    """

    name: str
    unit: str
    meaning: str
    kind: Kind
    read: Callable[[Reading, str], Any]
    owner: Owner = Owner.RUN
    available: Callable[[Scene, str], bool] = always
    title: str = ""
    display_unit: str = ""
    digits: int = 4
    is_detail: bool = False
    signed: bool = False
    extreme: Extreme = Extreme.NONE
    upper_bound: str = ""
    headline: bool = False
    cumulative: bool = False
    law_error: Callable[[Scene, str, float], float] = exact_laws
    curve: str = ""
    observe: Callable[[float, Reading, str], Any] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "display_unit", self.display_unit or self.unit)

    def full_name(self, owner: str) -> str:
        """Return the name in tables and files, which begins with its owner.

        >>> from exu_press.quantities import CATALOGUE
        >>> next(q for q in CATALOGUE if q.name == "min_film").full_name("crank_pin")
        'joints.crank_pin.min_film'
        """
        return self.name if self.owner is Owner.RUN else f"{self.owner.value}.{owner}.{self.name}"

    def in_scaled_unit(self, values: Iterable[float]) -> "Quantity":
        """Return the quantity in another unit where its own makes values very small or large.

        >>> from exu_press.quantities.catalogue import JOINT_FORCE
        >>> [JOINT_FORCE.in_scaled_unit([force]).display_unit for force in (2e3, 4.4, 0.02, 3e8)]
        ['kN', 'N', 'mN', 'MN']
        """
        largest = max(map(abs, values), default=0.0)
        is_usual = LEAST <= largest * self.scale < MOST or largest < UNDERFLOW
        if self.unit not in SCALED_UNITS or is_usual:
            return self
        prefixes = sorted(["", *SCALED_UNITS[self.unit]], key=lambda prefix: PREFIXES[prefix])
        prefix = next((p for p in prefixes if largest * PREFIXES[p] >= 1.0), prefixes[-1])
        return replace(self, display_unit=f"{prefix}{self.unit}")

    @property
    def scale(self) -> float:
        """Factor from the SI unit to the display unit."""
        if self.display_unit == self.unit:
            return 1.0
        return PREFIXES[self.display_unit.removesuffix(self.unit)]

    @property
    def head(self) -> str:
        """Title with the display unit."""
        return f"{self.title}, {self.display_unit}" if self.display_unit else self.title
