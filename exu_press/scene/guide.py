"""[guide]: guides with friction, elastic ones or ones with clearance, instead of ideal ones."""

import dataclasses
import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError, error_prefix
from exu_press.laws.film.plane_pad import WIDTHS
from exu_press.scene.contact import GuideContact
from exu_press.scene.friction import (
    FRICTION,
    OF_GUIDES,
    Friction,
    FrictionLaw,
    demand_static_friction,
)
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind, kind_module, kind_name
from exu_press.schema.registry import Registry, alternatives, choice
from exu_press.schema.table import (
    Table,
    key_values,
    plain,
    resolve,
    tables_by_name,
)

__all__ = ["ElasticGuide", "ElasticSupport", "GuideOil", "GuidewaySupport"]


@dataclass(frozen=True)
class GuideFriction(CustomKind, Table):
    """Those keys of a law of friction that guides have of their own."""

    table: ClassVar[str] = "guide"
    law_type: ClassVar[type[FrictionLaw]]
    law_keys: ClassVar[tuple[str, ...]] = ()
    """The other keys of the law, which are in [friction]; unknown where it is not resolved."""

    def __post_init__(self) -> None:
        super().__post_init__()
        keys = plain(self)
        if "mu_static" in keys and "mu_kinetic" in keys:
            demand_static_friction(self.table, keys["mu_static"], keys["mu_kinetic"])

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how another process builds this one, whose class no module has."""
        keys = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return guide_friction, (self.law_type, keys)

    @property
    def kind(self) -> str:
        """Name of the law."""
        return kind_name(self.law_type)

    @property
    def module(self) -> str:
        """Module of the law; "" of ours."""
        return kind_module(self.law_type)


def guide_friction(law: type[FrictionLaw], keys: Mapping[str, Any]) -> GuideFriction:
    """Return the friction of guides for a law with these keys."""
    return _of_guides(law)(**keys)


def _keys_of_guides(law: type[FrictionLaw]) -> type[GuideFriction]:
    """Return the keys of guides for a law of friction."""
    own, law_keys = [], []
    for field in dataclasses.fields(law):
        if field.name not in OF_GUIDES:
            law_keys.append(field.name)
            continue
        default, metadata = field.default, dict(field.metadata)
        if field.name == "regularisation_velocity":
            default = 1e-3
        metadata["meaning"] = metadata["meaning"].partition(";")[0]
        copied: Any = dataclasses.field(default=default, metadata=metadata)
        own.append((field.name, field.type, copied))
    namespace = {
        "law_type": law,
        "law_keys": tuple(law_keys),
        "resolved": law.resolved,
    }
    kind: type[GuideFriction] = dataclasses.make_dataclass(
        f"GuideFriction{law.__name__}",
        own,
        bases=(GuideFriction,),
        namespace=namespace,
        frozen=True,
    )
    return kind


_of_guides: Callable[[Any], type[GuideFriction]] = functools.cache(_keys_of_guides)


@dataclass(frozen=True)
class BeddingLength(Table):
    """An even bedding along the guide's length, whose tilting stiffness is k L^2 / 12."""

    table: ClassVar[str] = "guide"
    length: float = key(0.5, "of every guide with stiffness", "m", above=0, at_most=100)


@dataclass(frozen=True)
class TiltingStiffness(Table):
    """A tilting stiffness of its own."""

    table: ClassVar[str] = "guide"
    tilting_stiffness: float = key(
        None, "of every guide; from its length unless given", "N m/rad", above=0
    )


@dataclass(frozen=True)
class ElasticSupport(Table):
    """Springs across the guide and against tilting, in the body's centre of mass.

    Each damping is a part of the critical one of the guided mass or inertia alone, 2 D sqrt(k m),
    unless it is given; of two that are given there is no damping ratio, which is None then.
    """

    table: ClassVar[str] = "guide"
    lateral_stiffness: float = key(
        None,
        "of every guide, which is ideal without it; 1e9 with a clearance unless given",
        "N/m",
        above=0,
    )
    tilting: BeddingLength | TiltingStiffness = alternatives(
        {"tilting_stiffness": "scene.guide:TiltingStiffness", "": "scene.guide:BeddingLength"}
    )
    damping_ratio: float = key(0.05, "of the guided body alone on its guide", at_least=0)
    lateral_damping: float | None = key(
        None, "of every guide, instead of the damping ratio's", "N s/m", at_least=0
    )
    tilting_damping: float | None = key(
        None, "of every guide, instead of the damping ratio's", "N m s/rad", at_least=0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if None in (self.lateral_damping, self.tilting_damping):
            return
        if "damping_ratio" in self.given_values:
            reason = "guide.lateral_damping and guide.tilting_damping are given"
            self.refuse_unused(("damping_ratio",), reason)
        object.__setattr__(self, "damping_ratio", None)

    @property
    def stiffness_against_tilting(self) -> float:
        """N m/rad."""
        if isinstance(self.tilting, TiltingStiffness):
            return self.tilting.tilting_stiffness
        return self.lateral_stiffness * self.tilting.length**2 / 12


@dataclass(frozen=True)
class GuideOil(Table):
    """Oil that fills the gaps between the faces of a body and its guideways.

    Its film bears and drags, and the ends touch in parallel where the gap is below `contact_gap`.
    """

    table: ClassVar[str] = "guide"
    needed: ClassVar[tuple[str, ...]] = ("face_width", "contact_gap")
    error: ClassVar[float] = 0.02
    """Relative, of its film's forces."""
    viscosity: float = key(
        None, "clearance: dynamic, of the oil in it; dry without it", "Pa s", above=0, example=0.1
    )
    face_width: float = key(
        None, "viscosity: of a body's faces, normal to the plane", "m", above=0, example=0.1
    )
    contact_gap: float = key(
        None,
        "viscosity: gap at which surfaces begin to touch, three times their rms roughness",
        "m",
        above=0,
        example=2e-6,
    )

    def check_pads(self, length: float, clearance: float) -> None:
        """Raise InputError unless its pads are of the range of their law; sizes in m."""
        if not self.contact_gap < clearance:
            raise InputError(
                f"guide.contact_gap = {self.contact_gap!r}: allowed is a number < "
                f"guide.clearance = {clearance!r}"
            )
        narrowest, widest = WIDTHS
        if not narrowest * length <= self.face_width <= widest * length:
            raise InputError(
                f"guide.face_width = {self.face_width!r}: allowed are {narrowest:g} to {widest:g} "
                f"times guide.length = {length!r}, the range of the pads' law"
            )


@dataclass(frozen=True)
class GuidewaySupport(Table):
    """Guideways with clearance, which a body's two ends touch, `length` apart.

    Each end has half the lateral stiffness and the damping of [contact].
    """

    table: ClassVar[str] = "guide"
    because: ClassVar[str] = (
        "the two ends of the body carry its tilting moment, and [contact] has their damping"
    )
    lateral_stiffness: float = key(
        1e9, "of both ends of a body together", "N/m", above=0, source="estimated: 1 um per kN"
    )
    length: float = key(0.5, "of every guide with stiffness", "m", above=0, at_most=100)
    clearance: float = key(
        None,
        "on each side of a guided body, whose two ends make contact with the guideways",
        "m",
        above=0,
    )
    width: float = key(0.0, "clearance: of every guided body", "m", at_least=0)
    oil: GuideOil | None = alternatives({"viscosity": "scene.guide:GuideOil"})

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.oil is not None and None not in (self.oil.face_width, self.oil.contact_gap):
            self.oil.check_pads(self.length, self.clearance)


@dataclass(frozen=True)
class ElasticGuide(Table):
    """Guides with friction, elastic ones or ones with clearance, instead of ideal ones (A-9).

    With a lateral stiffness springs hold a body, with a clearance its two ends touch guideways.
    With neither the guide is ideal, and rubs with its side force times the coefficient.

    Attributes:
        by_name: guide -> the keys of its own table, [guide.NAME], see `scene.guides`.
        contact: with the guideways, from [contact], or None.
        rubbing: law of friction; keys that [guide] lacks are those of [friction]; or None.
    """

    table: ClassVar[str] = "guide"
    contact: ClassVar[GuideContact | None] = None
    rubbing: ClassVar[Friction | None] = None
    support: ElasticSupport | GuidewaySupport | None = alternatives(
        {
            "clearance": "scene.guide:GuidewaySupport",
            "lateral_stiffness": "scene.guide:ElasticSupport",
        }
    )
    friction: GuideFriction = choice(
        "none",
        "law of friction, whose further keys are those of [friction]",
        Registry(FRICTION.homes, FRICTION.base, _of_guides),
    )
    by_name: Mapping[str, Mapping[str, Any]] = tables_by_name()

    @property
    def kind(self) -> str:
        """Its name: ideal, elastic, dry or lubricated."""
        if self.guideways is not None:
            return "dry" if self.oil is None else "lubricated"
        return "elastic" if self.soft else "ideal"

    @property
    def soft(self) -> bool:
        """Whether guided bodies can move across their guides."""
        return self.support is not None

    @property
    def rubs(self) -> bool:
        """Whether there is friction."""
        return self.friction.kind != "none"

    @property
    def guideways(self) -> GuidewaySupport | None:
        """Guideways with clearance, or None."""
        return self.support if isinstance(self.support, GuidewaySupport) else None

    @property
    def clearance(self) -> float | None:
        """Clearance on each side, m, or None."""
        return None if self.guideways is None else self.guideways.clearance

    @property
    def oil(self) -> GuideOil | None:
        """Oil in the clearance, or None."""
        return None if self.guideways is None else self.guideways.oil

    def take_laws(self, keys_of: Callable[[str], Mapping[str, Any]]) -> None:
        """Make contact and friction from the scene's keys of "contact" and "friction"."""
        if self.guideways is not None:
            contact = resolve(GuideContact, "contact", keys_of("contact"))
            object.__setattr__(self, "contact", contact)
        if self.rubs:
            shared, names = keys_of("friction"), self.friction.law_keys
            if not self.friction.resolved:
                names = tuple(name for name in shared if name != "law")
            own = {"law": self.friction.kind, **plain(self.friction)}
            keys = {name: shared[name] for name in names if name in shared} | own
            object.__setattr__(self, "rubbing", resolve(Friction, "friction", keys))

    def check_laws(self) -> None:
        """Make every law once, so that values outside its range are refused before a run."""
        ways, contact = self.guideways, self.contact
        if ways is not None and contact is not None and contact.damping.resolved:
            from exu_press.laws.contact import hertz

            with error_prefix("contact."):
                contact.normal_contact(hertz(ways.lateral_stiffness, 1.0), ways.clearance, 1.0)
        if self.rubbing is not None and self.friction.resolved:
            with error_prefix("friction."):
                self.rubbing.friction()

    def law_keys(self, law: str) -> dict[str, dataclasses.Field[Any]]:
        """Return the keys of [contact] or [friction] that the guides use, with declarations."""
        table = self.contact if law == "contact" else self.rubbing
        own = ("law", *OF_GUIDES) if law == "friction" else ()
        keys = () if table is None else key_values(table)
        return {name: field for name, _, field in keys if name not in own}
