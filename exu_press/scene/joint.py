"""The kind of one joint, ideal, dry or lubricated, with its laws."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, cast

from exu_press.errors import InputError
from exu_press.scene.custom import CustomJoint, UnresolvedJoint, custom_class
from exu_press.scene.tables import Contact, Film, Friction, asperity_onset
from exu_press.schema.checks import Table, demand_keys, key, plain

if TYPE_CHECKING:
    from exu_press.scene.oil import Oil
    from exu_press.scene.worn import Worn

__all__ = [
    "JOINT_KINDS",
    "LAW_TABLES",
    "SIZES",
    "DryJoint",
    "IdealJoint",
    "Joint",
    "LooseJoint",
    "LubricatedJoint",
    "joint_dict",
    "keys_used",
    "oil_of",
    "refuse_missing",
    "refuse_missing_damping",
    "unworn",
]

SIZES = ("clearance", "radius")
"""Keys that a joint with clearance needs; a mechanism may have them for all joints."""


@dataclass(frozen=True)
class IdealJoint(Table):
    """A joint without clearance."""

    kind: ClassVar[Literal["ideal"]] = "ideal"
    clearance: ClassVar[float] = 0.0
    contact: ClassVar[None] = None
    friction: ClassVar[None] = None
    worn: ClassVar[None] = None
    onset: ClassVar[None] = None


@dataclass(frozen=True)
class DryJoint(Table):
    """A joint whose journal or ball lies loose in its bearing or socket.

    Keys that are not given are None until the scene fills them in.
    """

    kind: ClassVar[Literal["dry"]] = "dry"
    clearance: float = key(None, "radial clearance", "m", above=0, example=5e-5)
    radius: float = key(None, "of the journal or ball", "m", above=0, example=0.03)
    contact: Contact = dataclasses.field(default=cast(Any, None))
    friction: Friction = dataclasses.field(default=cast(Any, None))
    worn: "Worn | None" = None

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_clearance(self)

    @property
    def onset(self) -> float:
        """Gap at which the surfaces begin to touch, m."""
        return 0.0


@dataclass(frozen=True)
class LubricatedJoint(Table):
    """A journal or ball in its bearing or socket, full of oil; they touch with a mixed film alone.

    Keys that are not given are None until the scene fills them in; contact and friction stay None
    where the film alone carries.
    """

    kind: ClassVar[Literal["lubricated"]] = "lubricated"
    clearance: float = key(None, "radial clearance", "m", above=0, example=5e-5)
    radius: float = key(None, "of the journal or ball", "m", above=0, example=0.03)
    film: Film = dataclasses.field(default=cast(Any, None))
    contact: Contact | None = None
    friction: Friction | None = None
    worn: "Worn | None" = None

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_clearance(self)

    @property
    def onset(self) -> float | None:
        """Gap at which the surfaces' asperities begin to touch, m; None: the film ends the run."""
        return asperity_onset(self.film)


def unworn(joint: DryJoint | LubricatedJoint) -> DryJoint | LubricatedJoint:
    """Return a joint of the same mean clearance whose surfaces are round."""
    if joint.worn is None:
        return joint
    clearance = joint.clearance + joint.worn.even
    return dataclasses.replace(joint, clearance=clearance, worn=None)


LooseJoint = DryJoint | LubricatedJoint | CustomJoint
Joint = IdealJoint | LooseJoint
JOINT_KINDS: dict[str, type[Joint]] = {
    kind.kind: kind for kind in (IdealJoint, DryJoint, LubricatedJoint)
}

LAW_TABLES: dict[str, type[Table]] = {"contact": Contact, "friction": Friction, "film": Film}
"""Tables of the scene that hold for a joint unless it has its own."""


def oil_of(joint: Joint) -> "Oil | None":
    """Return the oil of a joint whose film warms, or None."""
    return joint.film.oil if isinstance(joint, LubricatedJoint) else None


def keys_used(kind: Any, at_contact: Any) -> tuple[str, ...]:
    """Return the keys of a joint of this kind beside the kind itself."""
    touching = ("contact", "friction")
    if kind == "dry":
        return (*SIZES, *touching, "worn")
    if kind == "lubricated":
        return (*SIZES, "film", *(touching if at_contact == "mixed" else ()), "worn")
    own = None if kind == "ideal" else custom_class(kind, CustomJoint)
    return () if own is None else tuple(field.name for field in dataclasses.fields(own))


def refuse_missing(place: str, joint: Joint, *, revolute: bool) -> None:
    """Raise InputError for the first missing key that decides a joint's behaviour."""
    if isinstance(joint, IdealJoint | UnresolvedJoint):
        return
    sizes: tuple[str, ...] = SIZES
    if isinstance(joint, CustomJoint):
        sizes = tuple(field.name for field in dataclasses.fields(joint))
    needed: dict[str, tuple[Table, tuple[str, ...]]] = {"": (joint, sizes)}
    if joint.contact is not None:
        dry = isinstance(joint, DryJoint)
        length = ("length",) if dry and revolute and joint.contact.shape == "cylindrical" else ()
        needed["contact"] = (joint.contact, length + _of_damping(joint.contact))
    if isinstance(joint, LubricatedJoint):
        oil, length = joint.film.oil, ("length",) if revolute else ()
        needed["film"] = (joint.film, length if oil else ("viscosity", *length))
        if oil is not None:
            needed["film.oil"] = (oil, oil.needed)
    for law, (table, keys) in needed.items():
        where = f"[{law}] or [{place}.{law}]" if law else f"[{place}]"
        demand_keys(place, table, keys, law, where)


def refuse_missing_damping(place: str, contact: Contact) -> None:
    """Raise InputError for the first key that the damping of a contact needs and does not have."""
    demand_keys(place, contact, _of_damping(contact), "contact", "[contact]")


def _of_damping(contact: Contact) -> tuple[str, ...]:
    return ("damping_max", "damping_depth") if contact.damping == "step" else ()


def joint_dict(joint: Joint, laws: Mapping[str, Table | None]) -> dict[str, Any]:
    """Return a joint as a nested mapping, with the keys of laws that differ from the scene's."""
    found: dict[str, Any] = {"kind": joint.kind}
    if isinstance(joint, UnresolvedJoint):
        return {**found, **joint.keys}
    for field in dataclasses.fields(joint):
        value = getattr(joint, field.name)
        if not isinstance(value, Table):
            found |= {} if value is None else {field.name: value}
            continue
        usual = laws.get(field.name)
        own = {
            key: each
            for key, each in plain(value).items()
            if usual is None or getattr(value, key) != getattr(usual, key)
        }
        found |= {field.name: own} if own else {}
    return found


def _check_clearance(joint: DryJoint | LubricatedJoint) -> None:
    if joint.worn is not None and joint.clearance is not None:
        joint.worn.refuse_sharp(joint.clearance)
    if None not in (joint.clearance, joint.radius) and joint.clearance >= joint.radius:
        raise InputError(
            f"clearance = {joint.clearance!r}: allowed is a number < radius = {joint.radius!r}"
        )
