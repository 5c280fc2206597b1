"""What one joint is: ideal, dry or lubricated, and with which laws."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from exu_press.checks import Table, key
from exu_press.errors import InputError
from exu_press.scene.laws import asperity_onset
from exu_press.scene.tables import Contact, Film, Friction

__all__ = [
    "DEFAULT_KINDS",
    "JOINT_KINDS",
    "LAW_TABLES",
    "DryJoint",
    "IdealJoint",
    "Joint",
    "LubricatedJoint",
    "joint_dict",
    "keys_used",
]

DEFAULT_KINDS: dict[str, dict[str, str]] = {
    "press": {"crank_pin": "lubricated", "balls": "dry"},
    "slider_crank": {"crank_pin": "lubricated"},
}
"""The joints of a shipped mechanism in a scene without any [joints]; the others are ideal."""

DEFAULT_CLEARANCE = 1e-4  # m, Table 2
DEFAULT_RADIUS = 0.07  # m


@dataclass(frozen=True)
class IdealJoint(Table):
    """A joint without clearance."""

    kind: ClassVar[Literal["ideal"]] = "ideal"
    clearance: ClassVar[float] = 0.0


@dataclass(frozen=True)
class DryJoint(Table):
    """A joint whose journal or ball lies loose in its bearing or socket."""

    kind: ClassVar[Literal["dry"]] = "dry"
    clearance: float = key(DEFAULT_CLEARANCE, "radial clearance", "m", above=0)
    radius: float = key(DEFAULT_RADIUS, "of the journal or ball", "m", above=0)
    contact: Contact = dataclasses.field(default_factory=Contact)
    friction: Friction = dataclasses.field(default_factory=Friction)

    def __post_init__(self) -> None:
        """Check the keys and that the journal is larger than its clearance."""
        super().__post_init__()
        _check_clearance(self)

    @property
    def onset(self) -> float:
        """Gap at which the surfaces begin to touch, m."""
        return 0.0


@dataclass(frozen=True)
class LubricatedJoint(Table):
    """A journal in a bearing full of oil; with a mixed film its surfaces may touch as well.

    Contact and friction are None where the film alone carries.
    """

    kind: ClassVar[Literal["lubricated"]] = "lubricated"
    clearance: float = key(DEFAULT_CLEARANCE, "radial clearance", "m", above=0)
    radius: float = key(DEFAULT_RADIUS, "of the journal", "m", above=0)
    film: Film = dataclasses.field(default_factory=Film)
    contact: Contact | None = None
    friction: Friction | None = None

    def __post_init__(self) -> None:
        """Check the keys and that the journal is larger than its clearance."""
        super().__post_init__()
        _check_clearance(self)

    @property
    def onset(self) -> float | None:
        """Gap at which the surfaces' asperities begin to touch, m; None: the film ends the run."""
        return asperity_onset(self.film)


Joint = IdealJoint | DryJoint | LubricatedJoint
JOINT_KINDS: dict[str, type[Joint]] = {
    kind.kind: kind for kind in (IdealJoint, DryJoint, LubricatedJoint)
}

LAW_TABLES: dict[str, type[Table]] = {"contact": Contact, "friction": Friction, "film": Film}
"""What joints have of the scene unless they say otherwise."""


def keys_used(kind: Any, at_contact: Any) -> tuple[str, ...]:
    """Return the keys of a joint of this kind beside the kind itself."""
    size, touching = ("clearance", "radius"), ("contact", "friction")
    if kind == "dry":
        return size + touching
    if kind == "lubricated":
        return (*size, "film", *(touching if at_contact == "mixed" else ()))
    return ()


def joint_dict(joint: Joint, laws: Mapping[str, Table | None]) -> dict[str, Any]:
    """Return a joint as a nested mapping, of its laws what differs from the scene's."""
    found: dict[str, Any] = {"kind": joint.kind}
    for field in dataclasses.fields(joint):
        value = getattr(joint, field.name)
        if not isinstance(value, Table):
            found |= {} if value is None else {field.name: value}
            continue
        usual = laws[field.name]
        own = {
            inner.name: getattr(value, inner.name)
            for inner in dataclasses.fields(value)
            if usual is None or getattr(value, inner.name) != getattr(usual, inner.name)
        }
        found |= {field.name: own} if own else {}
    return found


def _check_clearance(joint: DryJoint | LubricatedJoint) -> None:
    if joint.clearance >= joint.radius:
        raise InputError(
            f"clearance = {joint.clearance!r}: allowed is a number < radius = {joint.radius!r}"
        )
