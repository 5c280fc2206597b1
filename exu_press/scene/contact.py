"""[contact]: the normal contact of joints and guides whose surfaces touch, Eqs. 23-26."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.contact.damping import (
    NormalContact,
    flores,
    gonthier,
    hu_guo,
    hunt_crossley,
    lankarani_nikravesh,
    step_damping,
)
from exu_press.laws.contact.stiffness import Stiffness, cylindrical, hertz, hertz_stiffness
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.registry import Registry, alternatives, choice
from exu_press.schema.table import Table

__all__ = [
    "DAMPING",
    "BallContact",
    "Contact",
    "ContactDamping",
    "CylindricalContact",
    "GuideContact",
    "JournalContact",
    "PointContact",
    "StepDamping",
]

HERTZ = 1.5

HU_GUO = "Hu and Guo 2015"

STEEL = "steel on steel, 210 GPa, EN 1993-1-1, 3.2.6"

DAMPING = Registry(
    {
        "step": "scene.contact:StepDamping",
        "hunt_crossley": "scene.contact:HuntCrossley",
        "lankarani_nikravesh": "scene.contact:LankaraniNikravesh",
        "flores": "scene.contact:Flores",
        "gonthier": "scene.contact:Gonthier",
        "hu_guo": "scene.contact:HuGuo",
    },
    base="scene.contact:ContactDamping",
)

SHAPES = Registry(
    {"point": "scene.contact:PointContact", "cylindrical": "scene.contact:CylindricalContact"}
)

ELASTICITY = {"stiffness": "scene.contact:GivenStiffness", "": "scene.contact:Hertzian"}


@dataclass(frozen=True)
class ContactDamping(CustomKind, Table, ABC):
    """Base of the damping laws of contacts, also of your own.

    The derived dataclass declares its keys, which stand in [contact], by
    `exu_press.schema.checks.key`.
    """

    table: ClassVar[str] = "contact"

    @abstractmethod
    def normal_contact(
        self, stiffness: Stiffness, *, tension: bool, usual_slowest: float
    ) -> NormalContact:
        """Return the normal contact of an elastic part.

        Args:
            stiffness: elastic part.
            tension: whether the damping may pull.
            usual_slowest: speed of a journal that follows a load around its bearing, m/s.
        """

    def assumed_slowest_impact(self, usual: float) -> float | None:
        """Return the speed, m/s, as which slower contacts are damped, where no key gives it."""
        return None


@dataclass(frozen=True)
class StepDamping(ContactDamping):
    """Damping of ADAMS' IMPACT, which grows with the penetration."""

    registered_name: ClassVar[str] = "step"
    needed: ClassVar[tuple[str, ...]] = ("damping_max", "damping_depth")
    damping_max: float = key(None, "c_max", "N s/m", at_least=0, example=1e5)
    damping_depth: float = key(None, "d_max", "m", above=0, example=1e-6)

    def normal_contact(
        self, stiffness: Stiffness, *, tension: bool, usual_slowest: float
    ) -> NormalContact:
        """Return the normal contact; it does not depend on the speed of impact."""
        return step_damping(stiffness, self.damping_max, self.damping_depth, tension)


@dataclass(frozen=True)
class Restitution(ContactDamping):
    """Hysteretic damping, from a wanted restitution."""

    law: ClassVar[Callable[..., NormalContact]]
    restitution: float = key(
        0.9, "wanted restitution", above=0, at_most=1, source="steel pins, Flores et al. 2008"
    )
    slowest_impact: float | None = key(
        None,
        "contacts that begin slower are damped as one at this speed; that of the crank, rad/s, "
        "times the clearance unless given",
        "m/s",
        above=0,
        example=1e-3,
    )

    def normal_contact(
        self, stiffness: Stiffness, *, tension: bool, usual_slowest: float
    ) -> NormalContact:
        """Return the normal contact."""
        slowest = self.slowest_impact or usual_slowest
        law = type(self).law
        return law(stiffness, self.restitution, tension=tension, slowest_impact=slowest)

    def assumed_slowest_impact(self, usual: float) -> float | None:
        """Return that of a journal which follows a load around its bearing."""
        return usual if self.slowest_impact is None else None


class HuntCrossley(Restitution):
    """Hunt and Crossley's."""

    registered_name: ClassVar[str] = "hunt_crossley"
    law = hunt_crossley


class LankaraniNikravesh(Restitution):
    """Lankarani and Nikravesh's."""

    registered_name: ClassVar[str] = "lankarani_nikravesh"
    law = lankarani_nikravesh


class Flores(Restitution):
    """Flores, Machado, Silva and Martins'."""

    registered_name: ClassVar[str] = "flores"
    law = flores


class Gonthier(Restitution):
    """Gonthier, McPhee, Lange and Piedboeuf's."""

    registered_name: ClassVar[str] = "gonthier"
    law = gonthier


class HuGuo(Restitution):
    """Hu and Guo's."""

    registered_name: ClassVar[str] = "hu_guo"
    law = hu_guo


@dataclass(frozen=True)
class GivenStiffness(Table):
    """A stiffness that is measured or computed elsewhere."""

    table: ClassVar[str] = "contact"
    stiffness: float = key(
        None,
        "K of F = K delta^n; from radius, clearance and modulus unless given",
        "N/m^n",
        above=0,
    )
    exponent: float = key(HERTZ, "n of F = K delta^n", at_least=1, at_most=3)

    def elastic_force(self, radius: float, clearance: float) -> Stiffness:
        """Return the elastic part."""
        return hertz(self.stiffness, self.exponent)


@dataclass(frozen=True)
class Hertzian(Table):
    """The stiffness of a ball in a socket of nearly its size."""

    table: ClassVar[str] = "contact"
    exponent: float = key(HERTZ, "n of F = K delta^n", at_least=1, at_most=3)
    modulus: float = key(
        1.1538e11, "equivalent modulus of both surfaces", "Pa", above=0, source=STEEL
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.exponent != HERTZ:
            raise InputError(
                f"contact.exponent = {self.exponent!r}: without contact.stiffness, which follows "
                f"from Hertz, allowed is {HERTZ}"
            )

    def elastic_force(self, radius: float, clearance: float) -> Stiffness:
        """Return the elastic part; 1 / R = 1 / radius - 1 / (radius + clearance)."""
        curvature_radius = radius * (radius + clearance) / clearance
        return hertz(hertz_stiffness(curvature_radius, self.modulus), self.exponent)


@dataclass(frozen=True)
class PointContact(CustomKind, Table):
    """Hertz's point contact."""

    registered_name: ClassVar[str] = "point"
    table: ClassVar[str] = "contact"
    length: ClassVar[None] = None
    elasticity: GivenStiffness | Hertzian = alternatives(ELASTICITY)

    def elastic_force(self, radius: float, clearance: float, length: float | None) -> Stiffness:
        """Return the elastic part; arguments as those of `CylindricalContact`."""
        return self.elasticity.elastic_force(radius, clearance)


@dataclass(frozen=True)
class CylindricalContact(CustomKind, Table):
    """Conformal contact along a bearing."""

    registered_name: ClassVar[str] = "cylindrical"
    table: ClassVar[str] = "contact"
    modulus: float = key(
        1.1538e11, "equivalent modulus of both surfaces", "Pa", above=0, source=STEEL
    )
    length: float | None = key(
        None, "bearing length; that of the joint's film unless given", "m", above=0, example=0.05
    )

    def elastic_force(self, radius: float, clearance: float, length: float | None) -> Stiffness:
        """Return the elastic part.

        Args:
            radius: of the journal, m.
            clearance: radial, m.
            length: of the joint's film, m, for a contact that has none.
        """
        length = length if self.length is None else self.length
        assert length is not None
        return cylindrical(self.modulus, length, clearance)


class Contact(Table):
    """Normal contact of surfaces: an elastic part and a damping law."""

    table: ClassVar[str] = "contact"
    damping: ContactDamping
    tension: bool

    def normal_contact(
        self, stiffness: Stiffness, clearance: float, crank_speed: float
    ) -> NormalContact:
        """Return the normal contact with an elastic part.

        Args:
            stiffness: elastic part.
            clearance: of the surfaces, m.
            crank_speed: rad/s; times the clearance the speed of a journal that follows a load
                around its bearing: above that of the penetration of a lasting contact, and below
                that of impacts.
        """
        return self.damping.normal_contact(
            stiffness, tension=self.tension, usual_slowest=crank_speed * clearance
        )


def _tension() -> Any:
    return key(False, "let the damping pull, as the printed law does (A-10)")


SHAPE = "conformal pins, or Hertz's point contact, as every ball has it"


@dataclass(frozen=True)
class JournalContact(Contact):
    """Contact of a journal in its bearing."""

    shape: PointContact | CylindricalContact = choice("cylindrical", SHAPE, SHAPES)
    damping: ContactDamping = choice("hu_guo", "damping law", DAMPING, source=HU_GUO)
    tension: bool = _tension()

    @property
    def is_hertzian(self) -> bool:
        """Whether its stiffness is that of Hertz for a point."""
        return isinstance(self.shape, PointContact) and isinstance(self.shape.elasticity, Hertzian)

    def elastic_force(self, radius: float, clearance: float, length: float | None) -> Stiffness:
        """Return the elastic part; arguments as those of `CylindricalContact`."""
        return self.shape.elastic_force(radius, clearance, length)


@dataclass(frozen=True)
class BallContact(Contact):
    """Contact of a ball in its socket."""

    shape: str = key("cylindrical", SHAPE, choices=tuple(SHAPES))
    elasticity: GivenStiffness | Hertzian = alternatives(ELASTICITY)
    damping: ContactDamping = choice("hu_guo", "damping law", DAMPING, source=HU_GUO)
    tension: bool = _tension()

    @property
    def is_hertzian(self) -> bool:
        """Whether its stiffness is that of Hertz for a point."""
        return isinstance(self.elasticity, Hertzian)

    def elastic_force(self, radius: float, clearance: float, length: float | None) -> Stiffness:
        """Return the elastic part; arguments as those of `CylindricalContact`."""
        return self.elasticity.elastic_force(radius, clearance)


@dataclass(frozen=True)
class GuideContact(Contact):
    """Contact of the ends of a guided body with its guideways."""

    damping: ContactDamping = choice("hu_guo", "damping law", DAMPING, source=HU_GUO)
    tension: bool = _tension()
