"""The symmetric two-point knuckle press of the paper (section 2, Fig. 1, Table 2)."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.mechanism.construction import intersect_links, midpoint, point_on_vertical
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Body, Guide, Joint, Output, Point, steel_cube
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.registry import Registry, choice
from exu_press.schema.table import Table

__all__ = ["PAPER_LAWS", "TABLE_2", "Press", "press"]

PAPER_LAWS: dict[str, dict[str, Any]] = {
    "contact": {
        "shape": "point",
        "stiffness": 2.5545e10,
        "exponent": 1.5,
        "damping": "step",
        "damping_max": 2.5545e8,
        "damping_depth": 1e-5,
    },
    "friction": {
        "law": "lugre_steady",
        "mu_static": 0.01,
        "mu_kinetic": 0.01,
        "stribeck_velocity": 0.0176,  # 1 % of 0.07 m times 240 rpm
    },
}
"""The paper's dry joints: the laws that it chooses, with their keys."""

TABLE_2: dict[str, Any] = {
    "start": "centred",
    "clearance": 1e-4,
    "radius": 0.07,
    "joints": {"crank_pin": "lubricated", "balls": "dry"},
    "bodies": {"crank": "crank", "linkage": "linkage"},  # if they are flexible
    "contact": {**PAPER_LAWS["contact"], "modulus": 1.1538e11, "length": 0.1, "restitution": 0.5},
    "friction": {**PAPER_LAWS["friction"], "sigma_0": 1e5, "sigma_1": 400.0},
    "film": {"viscosity": 0.4, "length": 0.1},
    "settle": 0.0,  # the paper reads all of a run
}
"""The paper's joints: Table 2, A-11, A-12, and what other laws take; this press's alone."""

SIDES = {"right": 1, "left": -1}


COUNTERWEIGHTS = Registry(
    {True: "mechanism.press:Counterweight", False: "mechanism.press:NoCounterweight"}
)


@dataclass(frozen=True)
class Counterweight(CustomKind, Table):
    """Linkage (11) and counterweight (12)."""

    registered_name: ClassVar[Any] = True
    table: ClassVar[str] = "press"
    counter_eccentricity: float = key(0.016, "eccentric opposite the pin (A-3)", "m", above=0)
    counter_linkage_length: float = key(0.275, "linkage (11)", "m", above=0)
    counter_linkage_mass: float = key(22.58, "linkage (11)", "kg", above=0)
    counterweight_mass: float = key(1847.2, "counterweight (12)", "kg", above=0)
    counterweight_inertia: float | None = key(
        None, "counterweight (12), as slide_inertia", "kg m^2", above=0
    )


@dataclass(frozen=True)
class NoCounterweight(CustomKind, Table):
    """None."""

    registered_name: ClassVar[Any] = False
    table: ClassVar[str] = "press"


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
    counterweight: Counterweight | NoCounterweight = choice(
        True, "whether there are linkage (11) and counterweight (12)", COUNTERWEIGHTS
    )
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
    slide_inertia: float | None = key(
        None,
        "slide (4), which tilts in an elastic guide; a steel cube's unless given",
        "kg m^2",
        above=0,
    )
    slider_inertia: float | None = key(None, "slider (10), likewise", "kg m^2", above=0)


@lru_cache(maxsize=64)
def press(size: Press) -> Mechanism:
    """Return the press at top dead centre, the shaft in the origin.

    The linkage carries the bearing of the crank pin, the slider the sockets of the balls.

    Raises:
        InputError: its links do not meet.
    """
    if size.link_5_length <= size.pivot_distance:
        raise InputError(
            f"press.link_5_length = {size.link_5_length:g}: needs > press.pivot_distance = "
            f"{size.pivot_distance:g} m at crank angle 180 deg"
        )
    bottom = -size.crank_radius - size.linkage_length
    drop = math.sqrt(size.link_5_length**2 - size.pivot_distance**2)
    pivot_y = bottom - drop + size.link_6_length  # knuckle stretched at bottom dead centre
    slider_bottom = bottom - drop - size.link_7_length - size.plunger_length

    shaft, pin = (0.0, 0.0), (0.0, size.crank_radius)
    slide = point_on_vertical("press.linkage_length", pin, size.linkage_length, 0.0, -1)
    middle_of_linkage = 0.5 * (pin[1] + slide[1]) - size.linkage_mass_offset
    crank_inertia = size.crank_mass * size.crank_radius**2 / 12
    rod_inertia = size.linkage_mass * size.linkage_length**2 / 12
    bodies = [
        Body("crank", size.crank_mass, crank_inertia, (0.0, size.crank_mass_offset)),
        Body(
            "linkage",
            size.linkage_mass,
            size.linkage_inertia or rod_inertia,
            (0.0, middle_of_linkage),
            -math.pi / 2,
        ),
        _block("slide", size.slide_mass, size.slide_inertia, slide),
    ]
    joints = [
        Joint("shaft", shaft, "crank", GROUND),
        Joint("crank_pin", pin, "crank", "linkage"),
        Joint("slide_pin", slide, "linkage", "slide"),
    ]
    ball_y = 0.0
    for side, sign in SIDES.items():
        x = sign * size.pivot_distance
        pivot = (x, pivot_y)
        knuckle = intersect_links(
            "press.link_5_length, link_6_length",
            slide,
            size.link_5_length,
            pivot,
            size.link_6_length,
            -sign,
        )
        foot = point_on_vertical("press.link_7_length", knuckle, size.link_7_length, x, -1)
        ball_y = foot[1] - size.plunger_length
        link_5, link_6, link_7 = f"link_5_{side}", f"link_6_{side}", f"link_7_{side}"
        plunger = f"plunger_{side}"
        plunger_inertia = size.plunger_mass * size.plunger_length**2 / 12
        plunger_centre = (x, foot[1] - 0.5 * size.plunger_length)
        bodies += [
            _rod(link_5, size.link_5_mass, slide, knuckle),
            _rod(link_6, size.link_6_mass, pivot, knuckle),
            _rod(link_7, size.link_7_mass, knuckle, foot),
            Body(plunger, size.plunger_mass, plunger_inertia, plunger_centre),
        ]
        joints += [
            Joint(f"slide_joint_{side}", slide, link_5, "slide"),
            Joint(f"pivot_{side}", pivot, link_6, GROUND),
            Joint(f"knuckle_6_{side}", knuckle, link_6, link_5),
            Joint(f"knuckle_7_{side}", knuckle, link_7, link_5),
            Joint(f"plunger_pin_{side}", foot, link_7, plunger),
            Joint(f"ball_{side}", (x, ball_y), plunger, "slider", "spherical"),
        ]
    bodies.append(_block("slider", size.slider_mass, size.slider_inertia, (0.0, ball_y)))
    guided = ["slide", "plunger_right", "plunger_left", "slider"]
    groups = {
        "balls": ("ball_left", "ball_right"),
        "knuckles": ("knuckle_6_left", "knuckle_6_right", "knuckle_7_left", "knuckle_7_right"),
        "slide_joints": ("slide_joint_left", "slide_joint_right"),
        "pivots": ("pivot_left", "pivot_right"),
        "plunger_pins": ("plunger_pin_left", "plunger_pin_right"),
    }
    weight = size.counterweight
    if isinstance(weight, Counterweight):
        name, length = "press.counter_linkage_length", weight.counter_linkage_length
        counter_pin = (0.0, -weight.counter_eccentricity)
        counterweight = point_on_vertical(name, counter_pin, length, 0.0, +1)
        bodies += [
            _rod("counter_linkage", weight.counter_linkage_mass, counter_pin, counterweight),
            _block(
                "counterweight",
                weight.counterweight_mass,
                weight.counterweight_inertia,
                counterweight,
            ),
        ]
        joints += [
            Joint("counter_pin", counter_pin, "crank", "counter_linkage"),
            Joint("counterweight_pin", counterweight, "counter_linkage", "counterweight"),
        ]
        guided.append("counterweight")
    return Mechanism(
        name="press",
        bodies=tuple(bodies),
        joints=tuple(joints),
        guides=tuple(Guide(body) for body in guided),
        crank="crank",
        output=Output("slider", origin=(0.0, slider_bottom - size.bottom_dead_centre)),
        groups=groups,
        counterweight=("counter_linkage", "counterweight")
        if isinstance(weight, Counterweight)
        else (),
        defaults=TABLE_2,
    )


def _rod(name: str, mass: float, start: Point, end: Point) -> Body:
    angle = math.atan2(end[1] - start[1], end[0] - start[0])
    inertia = mass * math.dist(start, end) ** 2 / 12
    return Body(name, mass, inertia, midpoint(start, end), angle)


def _block(name: str, mass: float, inertia: float | None, centre: Point) -> Body:
    """Return a body of unknown shape; its inertia matters where an elastic guide lets it tilt."""
    return Body(name, mass, inertia or steel_cube(mass), centre)
