"""The field's standard test: crank on top, slider hanging below, clearance in the crank pin."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

from exu_press.mechanism.construction import midpoint, point_on_vertical
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Body, Guide, Joint, Output, steel_cube
from exu_press.schema.checks import key
from exu_press.schema.table import Table

__all__ = ["SliderCrank", "slider_crank"]


JOINTS: dict[str, Any] = {
    "clearance": 1e-4,
    "radius": 0.07,
    "joints": {"crank_pin": "lubricated"},
    "contact": {"length": 0.1},
    "film": {"viscosity": 0.4, "length": 0.1},
}
"""Journals of 140 mm by 100 mm; the oil is of the grade ISO VG 460 at 40 degrees."""


@dataclass(frozen=True)
class SliderCrank(Table):
    """A slider-crank of the press's crank, linkage and slider."""

    table: ClassVar[str] = "slider_crank"
    crank_radius: float = key(0.03, "shaft to crank pin", "m", above=0)
    crank_mass: float = key(217.6, "crank, its centre of mass in the shaft", "kg", above=0)
    crank_inertia: float = key(217.6 * 0.03**2 / 12, "crank, about the shaft", "kg m^2", above=0)
    rod_length: float = key(0.383, "crank pin to slider pin", "m", above=0)
    rod_mass: float = key(184.5, "rod", "kg", above=0)
    rod_inertia: float = key(
        184.5 * 0.383**2 / 12, "rod, about its centre of mass in the middle", "kg m^2", above=0
    )
    slider_mass: float = key(1347.0, "slider", "kg", above=0)
    slider_inertia: float | None = key(
        None,
        "slider, which tilts in an elastic guide; a steel cube's unless given",
        "kg m^2",
        above=0,
    )


@lru_cache(maxsize=64)
def slider_crank(size: SliderCrank) -> Mechanism:
    """Return the slider-crank at top dead centre; the rod carries the bearing of the crank pin.

    Raises:
        InputError: its links do not meet.
    """
    pin = (0.0, size.crank_radius)
    wrist = point_on_vertical("slider_crank.rod_length", pin, size.rod_length, 0.0, -1)
    inertia = size.slider_inertia or steel_cube(size.slider_mass)
    return Mechanism(
        name="slider_crank",
        bodies=(
            Body("crank", size.crank_mass, size.crank_inertia),
            Body("rod", size.rod_mass, size.rod_inertia, midpoint(pin, wrist), -math.pi / 2),
            Body("slider", size.slider_mass, inertia, wrist),
        ),
        joints=(
            Joint("shaft", (0.0, 0.0), "crank", GROUND),
            Joint("crank_pin", pin, "crank", "rod"),
            Joint("wrist_pin", wrist, "slider", "rod"),
        ),
        guides=(Guide("slider"),),
        crank="crank",
        output=Output("slider"),
        groups={"pins": ("crank_pin", "wrist_pin")},
        defaults=JOINTS,
    )
