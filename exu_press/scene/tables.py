"""The tables of a scene file, one dataclass each.

Defaults are engineering values with their sources; a mechanism may have its own, as the paper's
press has Table 2. What decides a result and has no such value is None until it is given.

Every key says its meaning, unit and range once, here; messages and documentation are made from it.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from exu_press.checks import Table, Uses, key
from exu_press.errors import InputError
from exu_press.laws.contact import DAMPING_LAWS
from exu_press.laws.film import FILM_LAWS
from exu_press.laws.motor import MotorLaw, kloss, torque_table

__all__ = [
    "RPM",
    "Contact",
    "ElasticGuide",
    "Film",
    "Friction",
    "Motor",
    "Solver",
    "asperity_onset",
]

CURVE = ("mu_static", "mu_kinetic", "stribeck_velocity", "stribeck_exponent")
FRICTION_LAWS = ("none", "coulomb", "stribeck", "lugre_steady", "lugre")
DEFAULT_TOLERANCE = 1e-3
USUAL_BREAKDOWN = 2.5  # of the rated torque
RPM = math.pi / 30.0  # rad/s
AT_CONTACT = ("stop", "mixed")

HERTZ = 1.5

OF_FRICTION = ("mu_static", "mu_kinetic", "stribeck_velocity", "regularisation_velocity")
"""Keys of guides that rub."""

OF_THE_WAYS = ("width", "friction", *OF_FRICTION, "damping_depth")
"""Keys of guides with clearance."""

OF_KLOSS = ("rated_torque", "slip", "breakdown_torque", "no_load_speed_rpm")
"""Keys of a motor without a table of its torque."""

GREASED = "greased steel on steel, Marks' Handbook, 3.2"


@dataclass(frozen=True)
class Contact(Table):
    """Normal contact of every joint that has one: stiffness and damping law, Eqs. 23-26."""

    table: ClassVar[str] = "contact"
    uses: ClassVar[Uses] = {
        "shape": {
            "point": ("stiffness", "exponent", "modulus"),
            "cylindrical": ("modulus", "length"),
        },
        "damping": dict.fromkeys(DAMPING_LAWS, ("restitution",))
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
        None,
        "length of the bearing; a film's unless given",
        "m",
        above=0,
        example=0.05,
    )
    damping: str = key(
        "hu_guo", "damping law", choices=tuple(DAMPING_LAWS), source="Hu and Guo 2015"
    )
    damping_max: float | None = key(None, "c_max", "N s/m", at_least=0, example=1e5)
    damping_depth: float | None = key(None, "d_max", "m", above=0, example=1e-6)
    restitution: float = key(
        0.9,
        "wanted restitution",
        above=0,
        at_most=1,
        source="steel pins, Flores et al. 2008",
    )
    tension: bool = key(False, "let the damping pull, as the printed law does (A-10)")

    def __post_init__(self) -> None:
        """Check the keys, and that a stiffness is given where it cannot be Hertz's."""
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
        0.1, "static coefficient; law = 'none' for zero", above=0, source=GREASED
    )
    mu_kinetic: float = key(
        0.1, "kinetic coefficient; law = 'none' for zero", above=0, source=GREASED
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
        """Check the keys, and that friction does not grow as sliding begins."""
        super().__post_init__()
        if "mu_static" not in self.unused():
            _demand_static_friction(self.table, self.mu_static, self.mu_kinetic)


@dataclass(frozen=True)
class Film(Table):
    """Film of every lubricated joint, Eqs. 34-35 corrected."""

    table: ClassVar[str] = "film"
    uses: ClassVar[Uses] = {"at_contact": {"stop": (), "mixed": ("roughness", "asperity_onset")}}

    law: str = key("finite", "film law", choices=tuple(FILM_LAWS))
    viscosity: float = key(None, "dynamic viscosity (A-11)", "Pa s", above=0, example=0.09)
    length: float = key(None, "bearing length (A-12)", "m", above=0, example=0.05)
    at_contact: str = key(
        "stop", "at eccentricity ratio 1: stop, or film and contact (A-13)", choices=AT_CONTACT
    )
    roughness: float = key(2e-7, "combined rms roughness", "m", above=0)
    asperity_onset: float = key(
        3.0, "gap at which asperities touch, in roughnesses", above=0, at_most=10
    )


@dataclass(frozen=True)
class Motor(Table):
    """A motor with its flywheel instead of a crank at constant speed; all reduced to the crank.

    An induction motor by Kloss' formula, through the rated point up to the breakdown torque; or any
    motor by a table of its torque. The run starts at `speed_rpm`.
    """

    table: ClassVar[str] = "drive"
    rated_torque: float = key(400.0, "at rated speed", "N m", above=0)
    slip: float = key(
        0.05, "(speed without load - rated speed) / speed without load", above=0, at_most=1
    )
    breakdown_torque: float | None = key(
        None,
        "largest one; 2.5 rated_torque unless given (IEC 60034-1 asks for 1.6, catalogues have 2 "
        "to 3.5)",
        "N m",
        above=0,
    )
    no_load_speed_rpm: float | None = key(
        None, "without torque; speed_rpm unless given", "rpm", above=0
    )
    table_speed_rpm: tuple[float, ...] | None = key(
        None, "of a table of torques instead, which goes on at both ends", "rpm", numbers=0
    )
    table_torque: tuple[float, ...] | None = key(None, "at these speeds", "N m", numbers=0)
    inertia: float = key(50.0, "of flywheel, gear and motor", "kg m^2", above=0)

    def __post_init__(self) -> None:
        """Check the keys, the breakdown torque and the table."""
        super().__post_init__()
        given = self.breakdown_torque
        if given is not None and given < self.rated_torque:
            raise InputError(
                f"drive.breakdown_torque = {given!r}: allowed is a number >= drive.rated_torque = "
                f"{self.rated_torque!r}"
            )
        speeds, torques = self.table_speed_rpm or (), self.table_torque or ()
        if self.table_speed_rpm is None and self.table_torque is None:
            return
        if len(speeds) != len(torques) or len(speeds) < 2:
            raise InputError(
                f"drive.table_speed_rpm, drive.table_torque: {len(speeds)} and {len(torques)} "
                "values; allowed are at least two, as many of both"
            )
        for before, after in pairwise(speeds):
            if not after > before:
                raise InputError(
                    f"drive.table_speed_rpm = {after!r} after {before!r}: allowed is increasing"
                )
        if speeds[-1] <= 0.0:
            raise InputError(
                f"drive.table_speed_rpm = {speeds[-1]!r} at the end: allowed is a number > 0"
            )

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used: those of Kloss where a table is given."""
        return (
            {}
            if self.table_torque is None
            else dict.fromkeys(OF_KLOSS, "drive.table_torque is given")
        )

    def law(self, speed_rpm: float) -> MotorLaw:
        """Return the torque over the speed of the crank, which starts at speed_rpm."""
        if self.table_speed_rpm is not None and self.table_torque is not None:
            return torque_table([speed * RPM for speed in self.table_speed_rpm], self.table_torque)
        largest = self.breakdown_torque or USUAL_BREAKDOWN * self.rated_torque
        return kloss(self.rated_torque, self.slip, largest, self.fastest(speed_rpm))

    def fastest(self, speed_rpm: float) -> float:
        """Return the speed without torque, or the table's last one, rad/s."""
        if self.table_speed_rpm is not None:
            return self.table_speed_rpm[-1] * RPM
        return (self.no_load_speed_rpm or speed_rpm) * RPM


@dataclass(frozen=True)
class ElasticGuide(Table):
    """Elastic instead of ideal guides (A-9): one spring across the guide and one against tilting.

    With a clearance a body's two ends, `length` apart, touch the ways instead, each with half the
    lateral stiffness and damping, and rub on them.

    The springs act in the body's centre of mass. A guide's tilting stiffness is that of an even
    bedding along its length, k L^2 / 12, and each damping a part of the critical one of the guided
    mass or inertia alone, 2 D sqrt(k m), unless they are given.
    """

    table: ClassVar[str] = "guide"
    lateral_stiffness: float = key(1e9, "of every guide", "N/m", above=0)
    length: float = key(0.5, "of every guide, for its tilting stiffness", "m", above=0, at_most=100)
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
    friction: str = key("none", "clearance: friction law of the ways", choices=FRICTION_LAWS)
    mu_static: float = key(0.1, "clearance: static coefficient", above=0)
    mu_kinetic: float = key(0.1, "clearance: kinetic coefficient", above=0)
    stribeck_velocity: float = key(0.01, "clearance: v_s", "m/s", above=0)
    regularisation_velocity: float = key(
        1e-3, "clearance: sgn(v) of laws without bristle is tanh(v / this)", "m/s", above=0
    )
    damping_depth: float = key(
        1e-6, "clearance: penetration at which the ways damp in full", "m", above=0
    )
    damping_ratio: float = key(0.05, "of the guided body alone on its guide", at_least=0)
    lateral_damping: float | None = key(
        None, "of every guide, instead of the damping ratio's", "N s/m", at_least=0
    )
    tilting_damping: float | None = key(
        None, "of every guide, instead of the damping ratio's", "N m s/rad", at_least=0
    )

    def __post_init__(self) -> None:
        """Check the keys, and that friction does not grow as sliding begins."""
        super().__post_init__()
        _demand_static_friction(self.table, self.mu_static, self.mu_kinetic)

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used: those of the ways, or of ideal tilting."""
        if self.clearance is None:
            return dict.fromkeys(OF_THE_WAYS, "guide.clearance is not given")
        why = "guide.clearance is given: the two ends of the body carry its tilting moment"
        found = dict.fromkeys(("tilting_stiffness", "tilting_damping"), why)
        if self.friction == "none":
            found |= dict.fromkeys(OF_FRICTION, "guide.friction is 'none'")
        return found


@dataclass(frozen=True)
class Solver(Table):
    """Exudyn's generalized-alpha, with steps that follow a tolerance or with fixed ones."""

    table: ClassVar[str] = "solver"
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
    max_steps: int = key(  # a million of the press: two to four minutes, 2 GB of record
        1_000_000, "a run that would need more steps, repeated ones too, stops", at_least=1
    )

    def __post_init__(self) -> None:
        """Check the keys; exactly one of tolerance and step decides."""
        super().__post_init__()
        if self.tolerance is not None and self.step is not None:
            raise InputError(
                f"solver.tolerance = {self.tolerance!r}, solver.step = {self.step!r}: "
                "allowed is one of the two"
            )
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
