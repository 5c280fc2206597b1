"""The tables of a scene file, one dataclass each; defaults are the assumptions A-1 .. A-14.

Every key says its meaning, unit and range once, here; messages and documentation are made from it.
"""

from dataclasses import dataclass
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.laws.contact import DAMPING_LAWS
from exu_press.laws.film import FILM_LAWS
from exu_press.scene.checks import Table, key

__all__ = [
    "Blanking",
    "Contact",
    "ElasticGuide",
    "Film",
    "Flexible",
    "Friction",
    "Press",
    "SliderCrank",
    "Solver",
]

FRICTION_LAWS = ("none", "coulomb", "stribeck", "lugre_steady", "lugre")
DEFAULT_TOLERANCE = 1e-3
AT_CONTACT = ("stop", "mixed")


@dataclass(frozen=True)
class Contact(Table):
    """Normal contact of every joint that has one: stiffness and damping law, Eqs. 23-26."""

    table: ClassVar[str] = "contact"
    shape: str = key(
        "point", "Hertz's point contact, or conformal pins", choices=("point", "cylindrical")
    )
    stiffness: float = key(2.5545e10, "point: K of F = K delta^n", "N/m^n", above=0)
    exponent: float = key(1.5, "point: n of F = K delta^n", at_least=1, at_most=3)
    modulus: float = key(1.1538e11, "cylindrical: equivalent modulus (steel)", "Pa", above=0)
    length: float = key(0.1, "cylindrical: length of the bearing", "m", above=0)
    damping: str = key("step", "damping law", choices=tuple(DAMPING_LAWS))
    damping_max: float = key(2.5545e8, "step: c_max", "N s/m", at_least=0)
    damping_depth: float = key(1e-5, "step: d_max", "m", above=0)
    restitution: float = key(0.5, "other damping laws: wanted restitution", above=0, at_most=1)
    tension: bool = key(False, "let the damping pull, as the printed law does (A-10)")


@dataclass(frozen=True)
class Friction(Table):
    """Friction of every joint whose surfaces may touch, Eqs. 27-33."""

    table: ClassVar[str] = "friction"
    law: str = key("lugre_steady", "friction law", choices=FRICTION_LAWS)
    mu_static: float = key(0.01, "static coefficient; law = 'none' for zero", above=0)
    mu_kinetic: float = key(0.01, "kinetic coefficient; law = 'none' for zero", above=0)
    sigma_0: float = key(1e5, "bristle stiffness per normal force", "1/m", above=0)
    sigma_1: float = key(400.0, "bristle damping per normal force", "s/m", at_least=0)
    sigma_2: float = key(0.0, "viscous coefficient per normal force", "s/m", at_least=0)
    stribeck_velocity: float = key(0.0176, "v_s: 1 % of 0.07 m times 240 rpm", "m/s", above=0)
    stribeck_exponent: float = key(2.0, "gamma", above=0)
    regularisation_velocity: float = key(
        1e-4, "sgn(v) of laws without bristle is tanh(v / this)", "m/s", above=0
    )

    def __post_init__(self) -> None:
        """Check the keys, and that friction does not grow as sliding begins."""
        super().__post_init__()
        if self.mu_static < self.mu_kinetic:
            raise InputError(
                f"friction.mu_static = {self.mu_static!r}: allowed is a number >= "
                f"friction.mu_kinetic = {self.mu_kinetic!r}"
            )


@dataclass(frozen=True)
class Film(Table):
    """Film of every lubricated joint, Eqs. 34-35 corrected."""

    table: ClassVar[str] = "film"
    law: str = key("pinkus", "film law", choices=tuple(FILM_LAWS))
    viscosity: float = key(0.4, "dynamic viscosity (A-11)", "Pa s", above=0)
    length: float = key(0.1, "bearing length (A-12)", "m", above=0)
    at_contact: str = key(
        "stop", "at eccentricity ratio 1: stop, or film and contact (A-13)", choices=AT_CONTACT
    )
    roughness: float = key(2e-7, "mixed: combined rms roughness", "m", above=0)
    asperity_onset: float = key(
        3.0, "mixed: gap at which asperities touch, in roughnesses", above=0, at_most=10
    )


@dataclass(frozen=True)
class Blanking(Table):
    """Triangular blanking pulse, upwards on the slider, once a revolution (Eq. 36, A-14)."""

    table: ClassVar[str] = "blanking"
    force: float = key(0.0, "peak force", "N", at_least=0)
    rise: float = key(1e-3, "time from zero to the peak (2 tau)", "s", above=0)
    fall: float = key(5e-4, "time from the peak to zero (tau)", "s", above=0)
    end_angle_deg: float = key(
        180.0, "crank angle from top dead centre at the pulse's end", "deg", above=0, at_most=360
    )
    eccentricity: float = key(0.0, "of the force from the slider's centre line, to the right", "m")


@dataclass(frozen=True)
class ElasticGuide(Table):
    """Elastic instead of ideal guides (A-9): springs that hold a body's x and angle, each alone.

    The springs act in the body's centre of mass. A guide's tilting stiffness is that of an even
    bedding along its length, k L^2 / 12, and each damping a share of the critical one of the guided
    mass or inertia alone, 2 D sqrt(k m), unless they are given. With ideal guides no body turns;
    inertias that the paper does not give are needed then: about the centre of mass, steel cubes'.
    """

    table: ClassVar[str] = "guide"
    lateral_stiffness: float = key(1e9, "of every guide", "N/m", above=0)
    length: float = key(0.5, "of every guide, for its tilting stiffness", "m", above=0)
    tilting_stiffness: float | None = key(
        None, "of every guide, instead of what its length makes", "N m/rad", above=0
    )
    damping_ratio: float = key(0.05, "of the guided body alone on its guide", at_least=0)
    lateral_damping: float | None = key(
        None, "of every guide, instead of the damping ratio's", "N s/m", at_least=0
    )
    tilting_damping: float | None = key(
        None, "of every guide, instead of the damping ratio's", "N m s/rad", at_least=0
    )
    slider_inertia: float | None = key(
        None, "slider (10); a steel cube's unless given", "kg m^2", above=0
    )
    slide_inertia: float | None = key(
        None, "slide (4); a steel cube's unless given", "kg m^2", above=0
    )
    counterweight_inertia: float | None = key(
        None, "counterweight (12); a steel cube's unless given", "kg m^2", above=0
    )


@dataclass(frozen=True)
class Flexible(Table):
    """Crank shaft and linkage as flexible bodies (section 4, Table 1)."""

    table: ClassVar[str] = "flexible"
    crank: str = key("crank", "shape of the crank shaft", choices=("crank", "crank_2"))
    linkage: str = key("linkage", "shape of the linkage", choices=("linkage", "linkage_2"))
    modes: int = key(20, "modal coordinates of each part", at_least=0, at_most=500)
    method: str = key("craig_bampton", "reduction", choices=("craig_bampton", "free"))
    damping_ratio: float = key(0.02, "of every mode", at_least=0, at_most=0.9)
    mesh_size: float = key(0.03, "of the tetrahedra", "m", at_least=0.01, at_most=0.1)
    modulus_factor: float = key(1.0, "times the paper's moduli of elasticity", above=0)


@dataclass(frozen=True)
class Solver(Table):
    """Exudyn's generalized-alpha, with steps that follow a tolerance or with fixed ones."""

    table: ClassVar[str] = "solver"
    tolerance: float | None = key(
        None, "local error, relative to the mechanism's scales", at_least=1e-8, at_most=0.1
    )
    step: float | None = key(None, "fixed step size, instead of a tolerance", "s", above=0)
    min_step: float = key(
        1e-8, "tolerance: a run that would need a smaller step stops", "s", above=0
    )
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


@dataclass(frozen=True)
class Press(Table):
    """Lengths and masses of the press (Table 2); links 5-8 per side (A-7)."""

    table: ClassVar[str] = "press"
    crank_radius: float = key(0.03, "eccentricity of the crank pin (2)", "m", above=0)
    linkage_length: float = key(0.383, "linkage (3)", "m", above=0)
    link_5_length: float = key(0.23, "slide (4) to knuckle", "m", above=0)
    link_6_length: float = key(0.24, "frame pivot to knuckle", "m", above=0)
    link_7_length: float = key(0.164, "knuckle to plunger", "m", above=0)
    plunger_length: float = key(0.55, "plunger (8), upper pin to ball centre", "m", above=0)
    pivot_distance: float = key(0.1655, "frame pivots and plungers from x = 0 (A-2)", "m", above=0)
    counterweight: bool = key(True, "whether there are linkage (11) and counterweight (12)")
    counter_eccentricity: float = key(0.016, "eccentric opposite the pin (A-3)", "m", above=0)
    counter_linkage_length: float = key(0.275, "linkage (11)", "m", above=0)
    bottom_dead_centre: float = key(0.47, "slider position at ideal bottom dead centre (A-8)", "m")
    crank_mass: float = key(217.6, "crank shaft (2)", "kg", above=0)
    crank_mass_offset: float = key(0.015, "centre of mass, from shaft to pin (A-6)", "m")
    linkage_mass: float = key(184.5, "linkage (3)", "kg", above=0)
    linkage_mass_offset: float = key(
        0.0, "centre of mass, from the linkage's middle to the slide (A-6)", "m"
    )
    linkage_inertia: float | None = key(
        None, "about its centre of mass; a uniform rod's unless given (A-6)", "kg m^2", above=0
    )
    slide_mass: float = key(60.0, "slide (4) (A-4)", "kg", above=0)
    link_5_mass: float = key(22.72, "link (5)", "kg", above=0)
    link_6_mass: float = key(24.13, "link (6)", "kg", above=0)
    link_7_mass: float = key(15.5, "link (7)", "kg", above=0)
    plunger_mass: float = key(155.3, "plunger (8) with ball (9) (A-5)", "kg", above=0)
    slider_mass: float = key(1347.0, "main slider (10)", "kg", above=0)
    counter_linkage_mass: float = key(22.58, "linkage (11)", "kg", above=0)
    counterweight_mass: float = key(1847.2, "counterweight (12)", "kg", above=0)


@dataclass(frozen=True)
class SliderCrank(Table):
    """A slider-crank of the press's crank, linkage and slider."""

    table: ClassVar[str] = "slider_crank"
    crank_radius: float = key(0.03, "shaft to crank pin", "m", above=0)
    rod_length: float = key(0.383, "crank pin to slider pin", "m", above=0)
    rod_mass: float = key(184.5, "rod", "kg", above=0)
    rod_inertia: float = key(
        184.5 * 0.383**2 / 12, "rod, about its centre of mass in the middle", "kg m^2", above=0
    )
    slider_mass: float = key(1347.0, "slider", "kg", above=0)
