"""The kind of one joint, ideal, dry, lubricated or a user's own, with its laws."""

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, cast

from exu_press.errors import InputError, Need, error_prefix
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.registry import Registry
from exu_press.schema.table import Table, key_values, missing_keys, plain

if TYPE_CHECKING:
    from exu_press.joints.interface import InterfaceLaw
    from exu_press.laws.contact.damping import NormalContact
    from exu_press.laws.film.contract import FilmLaw
    from exu_press.scene.contact import BallContact, JournalContact
    from exu_press.scene.film import BallFilm, JournalFilm
    from exu_press.scene.friction import Friction
    from exu_press.scene.oil import Oil
    from exu_press.scene.worn import WornDepths

__all__ = [
    "JOINT_KINDS",
    "SIZES",
    "CustomJoint",
    "DryJoint",
    "IdealJoint",
    "Joint",
    "LubricatedJoint",
    "TouchingJoint",
    "oil_of",
    "unworn",
]

SIZES = ("clearance", "radius")
"""Keys that a joint with clearance needs; a mechanism may have them for all joints."""

JOINT_KINDS = Registry(
    {
        "ideal": "scene.joint:IdealJoint",
        "dry": "scene.joint:DryJoint",
        "lubricated": "scene.joint:LubricatedJoint",
    },
    base="scene.joint:CustomJoint",
)


class Joint(CustomKind, Table):
    """A joint of a scene; what not every kind has is None."""

    clearance: float = 0.0
    contact: "JournalContact | BallContact | None" = None
    friction: "Friction | None" = None
    film: "JournalFilm | BallFilm | None" = None
    worn: "WornDepths | None" = None
    onset: float | None = None
    """Gap at which the surfaces begin to touch, m; None where they never do."""

    def kinds(self) -> dict[str, CustomKind]:
        """Return the joint and its laws, by the keys that name their kinds."""
        kinds: dict[str, CustomKind] = {"kind": self}
        if self.contact is not None:
            kinds["contact.damping"] = self.contact.damping
        if self.friction is not None:
            kinds["friction.law"] = self.friction.law
        if self.film is not None and self.film.length is not None:
            kinds["film.law"] = self.film.law
        return kinds

    @property
    def is_resolved(self) -> bool:
        """Whether the code of its kind and its laws is loaded."""
        return all(kind.resolved for kind in self.kinds().values())

    def missing_keys(self, path: str) -> list[Need]:
        """Return which of the keys that decide its behaviour are missing, by its dotted name."""
        return []

    def check_laws(self) -> None:
        """Make every law once, so that values outside its range are refused before a run."""

    def to_dict(self, laws: Mapping[str, Mapping[str, Any] | None]) -> dict[str, Any]:
        """Return the joint as a nested mapping, without keys of laws that a scene has itself."""
        keys: dict[str, Any] = {"kind": self.kind}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if isinstance(value, Table):
                own = _own_keys(value, laws.get(field.name) or {})
                keys |= {field.name: own} if own else {}
            elif value is not None:
                keys[field.name] = value
        return keys


def _own_keys(table: Table, shared: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a table that differ from shared ones, also of tables within it."""
    whole, own = plain(table), {}
    for name, value, _ in key_values(table):
        usual = shared.get(name)
        if name not in whole or value == usual:
            continue
        if isinstance(value, Table) and isinstance(usual, Table):
            own[name] = _own_keys(value, {key: inner for key, inner, _ in key_values(usual)})
        else:
            own[name] = whole[name]
    return own


@dataclass(frozen=True)
class IdealJoint(Joint):
    """A joint without clearance."""

    registered_name: ClassVar[str] = "ideal"


@dataclass(frozen=True)
class TouchingJoint(Joint):
    """A journal or ball, loose in its bearing or socket.

    Keys that are not given are None until the scene fills them in.
    """

    clearance: float = key(None, "radial clearance", "m", above=0, example=5e-5)
    radius: float = key(None, "of the journal or ball", "m", above=0, example=0.03)
    contact: "JournalContact | BallContact | None" = None
    friction: "Friction | None" = None
    worn: "WornDepths | None" = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.worn is not None and self.clearance is not None:
            self.worn.refuse_sharp(self.clearance)
        if None not in (self.clearance, self.radius) and self.clearance >= self.radius:
            raise InputError(
                f"clearance = {self.clearance!r}: allowed is a number < radius = {self.radius!r}"
            )

    def missing_keys(self, path: str) -> list[Need]:
        """Return which of the keys that decide its behaviour are missing."""
        needs = missing_keys(path, self, SIZES, "", "[{path}]")
        if self.contact is not None:
            lengths = () if self.film is not None else ("length",)
            where = "[contact] or [{path}.contact]"
            needs += missing_keys(path, self.contact, lengths, "contact", where)
        return needs

    def check_laws(self) -> None:
        """Make every law once, so that values outside its range are refused before a run."""
        with error_prefix("contact."):
            self.normal_contact(1.0)
        if self.friction is not None:
            with error_prefix("friction."):
                self.friction.friction()

    def normal_contact(self, crank_speed: float) -> "NormalContact | None":
        """Return the normal contact at a speed of the crank, rad/s; None without a known one."""
        if self.contact is None or not self.contact.damping.resolved:
            return None
        length = None if self.film is None else self.film.length
        elastic = self.contact.elastic_force(self.radius, self.clearance, length)
        return self.contact.normal_contact(elastic, self.clearance, crank_speed)


@dataclass(frozen=True)
class DryJoint(TouchingJoint):
    """A joint without oil."""

    registered_name: ClassVar[str] = "dry"
    onset: ClassVar[float] = 0.0  # type: ignore[misc]


@dataclass(frozen=True)
class LubricatedJoint(TouchingJoint):
    """A joint full of oil, whose surfaces touch with a mixed film alone.

    Contact and friction stay None where the film alone carries.
    """

    registered_name: ClassVar[str] = "lubricated"
    film: "JournalFilm | BallFilm" = dataclasses.field(default=cast(Any, None))

    @property
    def onset(self) -> float | None:  # type: ignore[override]
        """Gap at which the surfaces' asperities begin to touch, m; None: the film ends the run."""
        return self.film.contact_gap

    def missing_keys(self, path: str) -> list[Need]:
        """Return which of the keys that decide its behaviour are missing."""
        oil = self.film.oil
        viscosity = () if oil is not None else ("viscosity",)
        needs = super().missing_keys(path)
        needs += missing_keys(path, self.film, viscosity, "film", "[film] or [{path}.film]")
        if oil is not None:
            where = "[film.oil] or [{path}.film.oil]"
            needs += missing_keys(path, oil, (), "film.oil", where)
        return needs

    def check_laws(self) -> None:
        """Make every law once, so that values outside its range are refused before a run."""
        super().check_laws()
        with error_prefix("film."):
            self.film_law()
        self.film.check_cooling()

    def film_law(self) -> "FilmLaw":
        """Return the law of its film, in its plane."""
        return self.film.film_law(self.radius, self.clearance)

    @property
    def film_scale(self) -> float:
        """Scale P of its film's force, N s."""
        return self.film.scale(self.radius, self.clearance)


@dataclass(frozen=True)
class CustomJoint(Joint, ABC):
    """Base of a joint kind of your own; `kind = "my_module:MyClass"` names it in a scene.

    The derived dataclass declares its keys by `exu_press.schema.checks.key`. A key whose default is
    None has to be given.
    """

    clearance: float = key(None, "eccentricity that others are compared with", "m", above=0)

    @abstractmethod
    def interfaces(self) -> Sequence["InterfaceLaw"]:
        """Return the interface laws that act in parallel; the first has the joint's clearance."""

    def missing_keys(self, path: str) -> list[Need]:
        """Return which of its keys without default are missing."""
        keys = [field.name for field in dataclasses.fields(self) if self.resolved]
        return missing_keys(path, self, keys, "", "[{path}]")

    def check_laws(self) -> None:
        """Raise InputError unless it has interface laws."""
        laws = self.interfaces()
        if not isinstance(laws, list | tuple) or not laws:
            raise InputError(
                f"{self.kind}.interfaces() returns {laws!r:.80}: allowed is a list of one "
                "interface law or more"
            )


Round = TypeVar("Round", bound=Joint)


def unworn(joint: Round) -> Round:
    """Return a joint of the same mean clearance whose surfaces are round."""
    if joint.worn is None:
        return joint
    clearance = joint.clearance + joint.worn.even
    return cast(Round, dataclasses.replace(cast(Any, joint), clearance=clearance, worn=None))


def has_even_gap(joint: Joint) -> bool:
    """Return whether a joint's least gap is the clearance less the eccentricity.

    That of worn surfaces and of an inclined journal is another.
    """
    return joint.worn is None and (joint.film is None or not joint.film.law.inclination)


def is_fed(joint: Joint) -> bool:
    """Return whether a pump feeds its film, however little."""
    return joint.film is not None and joint.film.law.supply_pressure > 0.0


def oil_of(joint: Joint) -> "Oil | None":
    """Return the oil of a joint whose film warms, or None."""
    return None if joint.film is None else joint.film.oil
