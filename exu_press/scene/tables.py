"""The tables of a scene file, one dataclass each.

Defaults are engineering values with their sources; a mechanism may have its own, as the paper's
press has Table 2. What decides a result and has no such value is None until it is given.

Every key says its meaning, unit and range once, here; messages and documentation are made from it.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from exu_press.errors import InputError
from exu_press.laws.catalogue import FILM_LAWS
from exu_press.laws.contact_damping import DAMPING_LAWS
from exu_press.schema.checks import Table, Uses, demand_keys, inner, key

if TYPE_CHECKING:
    from exu_press.scene.oil import Oil

__all__ = [
    "DEFAULT_TOLERANCE",
    "OF_FRICTION",
    "RPM",
    "USUAL_STIFFNESS",
    "Contact",
    "ElasticGuide",
    "Film",
    "Friction",
    "Solver",
    "asperity_onset",
]

CURVE = ("mu_static", "mu_kinetic", "stribeck_velocity", "stribeck_exponent")
FRICTION_LAWS = ("none", "coulomb", "stribeck", "lugre_steady", "lugre")
DEFAULT_TOLERANCE = 1e-3
RPM = math.pi / 30.0  # rad/s
AT_CONTACT = ("stop", "mixed")

HERTZ = 1.5

OF_FRICTION = ("mu_static", "mu_kinetic", "stribeck_velocity", "regularisation_velocity")
"""Keys of friction that guides have of their own; other keys of their law are in [friction]."""

OF_TILTING = ("tilting_stiffness", "tilting_damping")
OF_SPRINGS = (*OF_TILTING, "damping_ratio", "lateral_damping")
"""Keys of elastic guides."""

USUAL_STIFFNESS = 1e9  # N/m

OF_PADS = ("face_width", "contact_gap")
"""Keys of guides with clearance and oil."""

OILED = "hard steel on hard steel with turbine oil: 0.108, Marks' Handbook, Table 3.2.1"


@dataclass(frozen=True)
class Contact(Table):
    """Normal contact of every joint that has one: stiffness and damping law, Eqs. 23-26."""

    table: ClassVar[str] = "contact"
    uses: ClassVar[Uses] = {
        "shape": {
            "point": ("stiffness", "exponent", "modulus"),
            "cylindrical": ("modulus", "length"),
        },
        "damping": dict.fromkeys(DAMPING_LAWS, ("restitution", "slowest_impact"))
        | {"step": ("damping_max", "damping_depth")},
    }

    shape: str = key(
        "cylindrical",
        "conformal pins, or Hertz's point contact, as every ball has it",
        choices=("point", "cylindrical"),
    )
    stiffness: float | None = key(
        None,
        "K of F = K delta^n; from radius, clearance and modulus unless given",
        "N/m^n",
        above=0,
    )
    exponent: float = key(HERTZ, "n of F = K delta^n", at_least=1, at_most=3)
    modulus: float = key(
        1.1538e11,
        "equivalent modulus of both surfaces",
        "Pa",
        above=0,
        source="steel on steel, 210 GPa, EN 1993-1-1, 3.2.6",
    )
    length: float | None = key(
        None, "length of the bearing; a film's unless given", "m", above=0, example=0.05
    )
    damping: str = key(
        "hu_guo", "damping law", choices=tuple(DAMPING_LAWS), source="Hu and Guo 2015"
    )
    damping_max: float | None = key(None, "c_max", "N s/m", at_least=0, example=1e5)
    damping_depth: float | None = key(None, "d_max", "m", above=0, example=1e-6)
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
    tension: bool = key(False, "let the damping pull, as the printed law does (A-10)")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.stiffness is None and self.exponent != HERTZ:
            raise InputError(
                f"contact.exponent = {self.exponent!r}: without contact.stiffness, which follows "
                f"from Hertz, allowed is {HERTZ}"
            )

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used; a stiffness that is given needs no modulus."""
        found = super().unused(**instead)
        if self.stiffness is not None and "stiffness" not in found:
            found["modulus"] = "contact.stiffness is given"
        return found


@dataclass(frozen=True)
class Friction(Table):
    """Friction of every joint whose surfaces may touch, Eqs. 27-33."""

    table: ClassVar[str] = "friction"
    uses: ClassVar[Uses] = {
        "law": {
            "none": (),
            "coulomb": ("mu_kinetic", "regularisation_velocity"),
            "stribeck": (*CURVE, "sigma_2", "regularisation_velocity"),
            "lugre_steady": (*CURVE, "sigma_2", "regularisation_velocity"),
            "lugre": (*CURVE, "sigma_0", "sigma_1", "sigma_2"),
        }
    }

    law: str = key("coulomb", "friction law", choices=FRICTION_LAWS)
    mu_static: float = key(
        0.1, "static coefficient; law = 'none' for zero", above=0, source="taken as the kinetic one"
    )
    mu_kinetic: float = key(
        0.1, "kinetic coefficient; law = 'none' for zero", above=0, source=OILED
    )
    sigma_0: float = key(1e5, "bristle stiffness per normal force", "1/m", above=0)
    sigma_1: float = key(316.0, "bristle damping per normal force", "s/m", at_least=0)
    sigma_2: float = key(0.0, "viscous coefficient per normal force", "s/m", at_least=0)
    stribeck_velocity: float = key(0.01, "v_s", "m/s", above=0)
    stribeck_exponent: float = key(2.0, "gamma", above=0)
    regularisation_velocity: float = key(
        1e-4, "sgn(v) of laws without bristle is tanh(v / this)", "m/s", above=0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if "mu_static" not in self.unused():
            _demand_static_friction(self.table, self.mu_static, self.mu_kinetic)


@dataclass(frozen=True)
class Film(Table):
    """Film of every lubricated joint, Eqs. 34-35 corrected."""

    table: ClassVar[str] = "film"
    uses: ClassVar[Uses] = {"at_contact": {"stop": (), "mixed": ("roughness", "asperity_onset")}}
    instead: ClassVar[Mapping[str, str]] = {"oil": "viscosity", "viscosity": "oil"}

    law: str = key("finite", "film law of a journal", choices=tuple(FILM_LAWS))
    viscosity: float = key(None, "dynamic viscosity (A-11)", "Pa s", above=0, example=0.09)
    length: float | None = key(
        None, "bearing length (A-12); a ball has none", "m", above=0, example=0.05
    )
    socket_angle_deg: float = key(
        90.0,
        "ball: from the middle of each of its socket's two caps to the edge",
        "deg",
        at_least=45,
        at_most=90,
        source="two hemispheres",
    )
    at_contact: str = key(
        "stop", "at eccentricity ratio 1: stop, or film and contact (A-13)", choices=AT_CONTACT
    )
    roughness: float = key(2e-7, "combined rms roughness", "m", above=0)
    asperity_onset: float = key(
        3.0, "gap at which asperities touch, in roughnesses", above=0, at_most=10
    )
    oil: "Oil | None" = inner("exu_press.scene.oil:Oil")

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used; of a joint's film those of other joints' shapes.

        Args:
            instead: `joint` is its shape; a film without a joint may be of any.
        """
        joint = instead.pop("joint", None)
        others = {"revolute": ("socket_angle_deg",), "spherical": ("law", "length")}
        why = f"the joint is {joint}"
        return super().unused(**instead) | dict.fromkeys(others.get(joint or "", ()), why)

    @property
    def cold_viscosity(self) -> float:
        """Viscosity with which a run begins, Pa s: of oil as it is supplied."""
        return self.viscosity if self.oil is None else self.oil.viscosity(self.oil.supply_celsius)


@dataclass(frozen=True)
class ElasticGuide(Table):
    """Guides with friction, elastic ones or ones with clearance, instead of ideal ones (A-9).

    With a lateral stiffness one spring acts across the guide and one against tilting, in the body's
    centre of mass. The tilting stiffness is that of an even bedding along the guide's length, k L^2
    / 12, and each damping a part of the critical one of the guided mass or inertia alone, 2 D
    sqrt(k m), unless they are given.

    With a clearance a body's two ends, `length` apart, touch the guideways instead, each with half
    the lateral stiffness and the damping of [contact]. With a viscosity as well, oil fills the gaps
    between its faces and the guideways: its film bears and drags, and the ends touch in parallel
    where the gap is below `contact_gap`.

    With neither the guide is ideal, and rubs with its side force times the coefficient.
    """

    table: ClassVar[str] = "guide"
    lateral_stiffness: float | None = key(
        None,
        "of every guide, which is ideal without it; 1e9 with a clearance unless given",
        "N/m",
        above=0,
        source="assumed",
    )
    length: float = key(0.5, "of every guide with stiffness", "m", above=0, at_most=100)
    tilting_stiffness: float | None = key(
        None, "of every guide; from its length unless given", "N m/rad", above=0
    )
    clearance: float | None = key(
        None,
        "on each side of a guided body, whose two ends make contact with the guideways",
        "m",
        above=0,
    )
    width: float = key(0.0, "clearance: of every guided body", "m", at_least=0)
    viscosity: float | None = key(
        None, "clearance: dynamic, of the oil in it; dry without it", "Pa s", above=0, example=0.1
    )
    face_width: float | None = key(
        None, "viscosity: of a body's faces, normal to the plane", "m", above=0, example=0.1
    )
    contact_gap: float | None = key(
        None,
        "viscosity: gap at which surfaces begin to touch, three times their rms roughness",
        "m",
        above=0,
        example=2e-6,
    )
    friction: str = key(
        "none", "law of friction, whose further keys are those of [friction]", choices=FRICTION_LAWS
    )
    mu_static: float = key(
        0.1, "static coefficient of guides", above=0, source="taken as the kinetic one"
    )
    mu_kinetic: float = key(0.1, "kinetic coefficient of guides", above=0, source=OILED)
    stribeck_velocity: float = key(0.01, "v_s of guides", "m/s", above=0)
    regularisation_velocity: float = key(
        1e-3, "sgn(v) of laws without bristle is tanh(v / this)", "m/s", above=0
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
        if self.clearance is not None and self.lateral_stiffness is None:
            object.__setattr__(self, "lateral_stiffness", USUAL_STIFFNESS)
        if not (self.soft or self.rubs):
            raise InputError(
                "[guide] has neither lateral_stiffness nor clearance nor friction: allowed is at "
                "least one of them, as in guide.friction = 'coulomb'; without [guide] the guides "
                "are ideal"
            )
        if "mu_static" not in self.unused():
            _demand_static_friction(self.table, self.mu_static, self.mu_kinetic)
        if self.clearance is not None and self.viscosity is not None:
            self._check_pads(self.clearance)

    def _check_pads(self, clearance: float) -> None:
        """Demand a film's keys, and that its pads lie in their law's range."""
        demand_keys("guide.viscosity", self, OF_PADS, "guide", "[guide]")
        assert self.face_width is not None and self.contact_gap is not None
        if not self.contact_gap < clearance:
            raise InputError(
                f"guide.contact_gap = {self.contact_gap!r}: allowed is a number < "
                f"guide.clearance = {clearance!r}"
            )
        from exu_press.laws.film.plane_pad import WIDTHS

        narrowest, widest = WIDTHS
        if not narrowest * self.length <= self.face_width <= widest * self.length:
            raise InputError(
                f"guide.face_width = {self.face_width!r}: allowed are {narrowest:g} to {widest:g} "
                f"times guide.length = {self.length!r}, the range of the pads' law"
            )

    @property
    def soft(self) -> bool:
        """Return whether guided bodies can move across their guides."""
        return self.lateral_stiffness is not None

    @property
    def rubs(self) -> bool:
        """Return whether there is friction."""
        return self.friction != "none"

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used: those of other guides, and of other laws."""
        found: dict[str, str] = {}
        if self.viscosity is None:
            found |= dict.fromkeys(OF_PADS, "guide.viscosity is not given: the guides are dry")
        if self.clearance is None:
            found |= dict.fromkeys(("width", "viscosity", *OF_PADS), "guide.clearance is not given")
        else:
            why = "guide.clearance is given: the two ends of the body carry its tilting moment"
            found |= dict.fromkeys(OF_TILTING, why)
            why = "guide.clearance is given: [contact] has the damping of its ends"
            found |= dict.fromkeys(("damping_ratio", "lateral_damping"), why)
        if not self.soft:
            why = "guide.lateral_stiffness is not given: the guides are ideal"
            found |= dict.fromkeys(("length", *OF_SPRINGS), why)
        of_law = Friction.uses["law"][self.friction]
        why = f"guide.friction is {self.friction!r}"
        return found | {name: why for name in OF_FRICTION if name not in of_law}

    def laws(self, contact: Contact) -> dict[str, tuple[str, ...]]:
        """Return the keys of [contact] and of [friction] that the guides use."""
        damping = ("damping", *Contact.uses["damping"][contact.damping], "tension")
        of_law = Friction.uses["law"][self.friction]
        return {
            "contact": () if self.clearance is None else damping,
            "friction": tuple(name for name in of_law if name not in OF_FRICTION),
        }


@dataclass(frozen=True)
class Solver(Table):
    """Exudyn's generalized-alpha, with steps that follow a tolerance or with fixed ones."""

    table: ClassVar[str] = "solver"
    instead: ClassVar[Mapping[str, str]] = {"step": "tolerance", "tolerance": "step"}
    tolerance: float | None = key(
        None, "local error, relative to the mechanism's scales", at_least=1e-8, at_most=0.1
    )
    step: float | None = key(None, "fixed step size, instead of a tolerance", "s", above=0)
    min_step: float = key(1e-8, "a run that would need a smaller step stops", "s", above=0)
    max_step_deg: float = key(
        1.5, "tolerance: largest step, in degrees of the crank", "deg", above=0, at_most=15
    )
    spectral_radius: float = key(
        0.8, "spectral radius at infinity of generalized-alpha", at_least=0.5, at_most=0.95
    )
    max_steps: int = key(  # a million of the press: two to four minutes
        1_000_000, "a run that would need more steps, repeated ones too, stops", at_least=1
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.tolerance is None and self.step is None:
            object.__setattr__(self, "tolerance", DEFAULT_TOLERANCE)

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used: the largest step, where steps are fixed."""
        return {} if self.step is None else {"max_step_deg": "solver.step is given"}


def asperity_onset(table: Film) -> float | None:
    """Return the gap at which the surfaces' asperities touch, m; None without mixed film."""
    return table.roughness * table.asperity_onset if table.at_contact == "mixed" else None


def _demand_static_friction(table: str, mu_static: float, mu_kinetic: float) -> None:
    if mu_static < mu_kinetic:
        raise InputError(
            f"{table}.mu_static = {mu_static!r}: allowed is a number >= "
            f"{table}.mu_kinetic = {mu_kinetic!r}"
        )
