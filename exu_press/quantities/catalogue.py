"""Every quantity of the package, and those of the user's own."""

import math
import numbers
import sys
from dataclasses import dataclass
from functools import cached_property

from exu_press.errors import InputError
from exu_press.quantities.cost import COSTS
from exu_press.quantities.energy import BALANCE
from exu_press.quantities.fatigue import BODIES
from exu_press.quantities.gears_and_springs import GEARS, SPRINGS
from exu_press.quantities.joints import JOINTS
from exu_press.quantities.observed import find_observed, with_observed
from exu_press.quantities.oil import OIL
from exu_press.quantities.press import DRIVE, GUIDES, LOADS, SHAKING
from exu_press.quantities.quantity import PREFIXES, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.quantities.sheet import SHEETS
from exu_press.quantities.slider import SLIDER, STROKES
from exu_press.quantities.slopes import SLOPES
from exu_press.quantities.start_stop import START_STOP
from exu_press.quantities.wear import WEAR
from exu_press.scene import Scene, mechanism_of
from exu_press.schema.checks import demand_known, demand_name

__all__ = [
    "CATALOGUE",
    "GROUPS",
    "QuantityAt",
    "add",
    "find_quantity",
    "own_modules",
    "quantities_of",
    "quantity_of",
]

GROUPS: dict[str, tuple[Quantity, ...]] = {
    "motion": (*SLIDER, *STROKES),
    "joints": (*JOINTS, *SLOPES, *OIL, *WEAR),
    "forces": (*SHAKING, *LOADS, *SHEETS, *GUIDES, *GEARS, *SPRINGS),
    "drive and energy": (*DRIVE, *START_STOP, *BALANCE),
    "bodies": BODIES,
    "the run itself": COSTS,
}
"""Headings of tables, and the quantities below them."""

CATALOGUE: list[Quantity] = [quantity for group in GROUPS.values() for quantity in group]
"""In the order of tables."""

_DECLARED_IN: dict[Quantity, str | None] = {}
"""Modules whose import adds a user's own quantity."""


def _declared_as(name: str, owner: Owner = Owner.RUN) -> Quantity:
    return next(q for q in CATALOGUE if q.name == name and q.owner is owner)


PEAK_ACCELERATION = _declared_as("peak_acceleration.resolved")
MEAN_ACCELERATION = _declared_as("peak_acceleration.mean_1ms")
DEAD_CENTRE = _declared_as("bottom_dead_centre")
DEAD_CENTRE_MEAN = _declared_as("strokes.mean")
DEAD_CENTRE_RANGE = _declared_as("strokes.range")
PEAK_TORQUE = _declared_as("drive.peak_torque")
SHAKING_MEANS = tuple(
    _declared_as(f"shaking.{which}_mean_1ms")
    for which in ("vertical", "without_counterweight.vertical", "horizontal")
)
JOINT_FORCE = _declared_as("peak_force", Owner.JOINT)
GUIDE_FORCE = _declared_as("peak_force", Owner.GUIDE)
ECCENTRICITY_RATIO = _declared_as("max_eccentricity_ratio", Owner.JOINT)
"""Those that pictures and studies show by themselves."""


@dataclass(frozen=True)
class QuantityAt:
    """A quantity of one owner.

    Attributes:
        quantity: as it is declared.
        owner: name of the joint, guide, gear, spring, load or body; "" of the run.
    """

    quantity: Quantity
    owner: str = ""

    @cached_property
    def name(self) -> str:
        """Its full name."""
        return self.quantity.full_name(self.owner)

    def read(self, run: Reading) -> float | int | None:
        """Return its value, None where the run is too short to have it, or where it is no number.

        Raises:
            InputError: a quantity of the user's own gives something else.
        """
        value = self.quantity.read(run, self.owner)
        if value is None:
            return None
        if isinstance(value, numbers.Integral):
            return int(value)
        if not isinstance(value, numbers.Real):
            raise InputError(
                f"quantity {self.name}: gives {value!r:.80}; allowed is a number, or None where "
                "the run has none"
            )
        return float(value) if math.isfinite(value) else None


def add(quantity: Quantity) -> Quantity:
    """Declare a quantity of one's own; every run read from now on has it.

    Workers of studies import the module that does so at its top level.

    Raises:
        InputError: it is declared already, files cannot hold the name, or the display unit is not
            the unit with a prefix.
    """
    for word in str(quantity.name).split("."):
        demand_name(f"quantity {quantity.name!r}", word)
    units = [f"{prefix}{quantity.unit}" for prefix in PREFIXES]
    if quantity.display_unit not in units:
        raise InputError(
            f"quantity {quantity.name}: display_unit = {quantity.display_unit!r}; allowed are "
            f"{', '.join(units)}"
        )
    for declared in CATALOGUE:
        if (declared.owner, declared.name) == (quantity.owner, quantity.name):
            raise InputError(
                f"quantity {quantity.name}: is declared already; allowed is another name"
            )
    CATALOGUE.append(quantity)
    caller = sys._getframe(1)
    imported = caller.f_code.co_name == "<module>"
    _DECLARED_IN[quantity] = str(caller.f_globals["__name__"]) if imported else None
    return quantity


def own_modules() -> tuple[str, ...]:
    """Return the modules that declare the user's own quantities when a worker imports them.

    Raises:
        InputError: a quantity was added where no import does it again.
    """
    modules = {
        quantity: module for quantity, module in _DECLARED_IN.items() if quantity in CATALOGUE
    }
    for quantity, module in modules.items():
        if module in (None, "__main__"):
            raise InputError(
                f"quantity {quantity.name}: is added in the script itself or in a function, which "
                "workers of a study do not run; allowed is `add` at the top level of a module that "
                "the script imports"
            )
    return tuple(dict.fromkeys(module for module in modules.values() if module))


def find_quantity(name: str) -> QuantityAt | None:
    """Return the quantity of a full name, whatever the scene; None where there is none.

    >>> find_quantity("joints.crank_pin.peak_force").quantity.unit
    'N'
    """
    kind, _, rest = name.partition(".")
    owner, _, inner = rest.partition(".")
    for quantity in CATALOGUE:
        if quantity.owner is Owner.RUN and quantity.name == name:
            return QuantityAt(quantity)
        if (quantity.owner.value, quantity.name) == (kind, inner):
            return QuantityAt(quantity, owner)
    observed = find_observed(CATALOGUE, name)
    return None if observed is None else QuantityAt(observed)


def quantities_of(scene: Scene) -> dict[str, QuantityAt]:
    """Return every quantity that a run of a scene has, by its full name; known before it runs."""
    owners = _owners(scene)
    placed = (
        QuantityAt(quantity, owner)
        for quantity in with_observed(CATALOGUE, scene)
        for owner in owners[quantity.owner]
        if quantity.available(scene, owner)
    )
    return {entry.name: entry for entry in placed}


def quantity_of(scene: Scene, name: str) -> QuantityAt:
    """Return one quantity of a scene by its full name.

    Raises:
        InputError: the scene has no such quantity.
    """
    declared_here = quantities_of(scene)
    demand_known(f"quantity {name!r}: this scene has none of this name", name, declared_here)
    return declared_here[name]


def _owners(scene: Scene) -> dict[Owner, tuple[str, ...]]:
    mechanism = mechanism_of(scene)
    return {
        Owner.RUN: ("",),
        Owner.JOINT: tuple(joint.name for joint in mechanism.joints),
        Owner.GUIDE: tuple(guide.name for guide in mechanism.guides),
        Owner.GEAR: tuple(gear.name for gear in mechanism.gears),
        Owner.SPRING: tuple(spring.name for spring in mechanism.springs),
        Owner.LOAD: tuple(scene.applied_loads),
        Owner.BODY: tuple(scene.bodies),
    }
