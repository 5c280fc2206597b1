"""What the paper leaves open, as keys of a search: what each may be, what it does to a scene."""

from collections.abc import Mapping, Sequence
from typing import Any

from exu_press.scene import Scene
from exu_press.studies.base import Key, Range, Values
from paper.readings import MODELS
from paper.settings import LINK_MASSES, times, values_in

__all__ = ["BESIDE", "FOUND", "OPEN", "OURS", "alternatives", "as_read", "in_words"]

OURS: Mapping[str, Any] = {
    "observation": "mean_1ms",
    "damping": 2.5545e8,
    "damping depth": 1e-5,
    "contact pulls (A-10)": False,
    "friction": 0.01,
    "start": "centred",
    "start angle": 0.0,
    "pin's clearance": 1.0,
    "balls' clearance": 1.0,
    "film's law": "pinkus",
    "viscosity (A-11)": 0.4,
    "bearing's length (A-12)": 0.1,
    "pivots (A-2)": 0.1655,
    "counter-eccentric (A-3)": 0.016,
    "slide's mass (A-4)": 60.0,
    "8 with ball 9 (A-5)": 155.3,
    "linkage's centre (A-6)": 0.0,
    "masses of 5 to 8 (A-7)": 1.0,
    "guides (A-9)": "ideal",
    "pulse's rise (A-14)": 1e-3,
    "pulse's end (A-14)": 180.0,
}
"""What scenes have. A-1, the topology, and A-8, the datum, are not open; A-13, what a film does
where surfaces touch, is met by no run of section 5."""

FOUND: Mapping[str, Any] = {
    **OURS,
    "observation": "resolved",
    "damping": 10.0,
    "start": "loaded",
    "start angle": 180.0,
    "pin's clearance": 0.5,
    "film's law": "finite",
    "viscosity (A-11)": 0.14,
    "bearing's length (A-12)": 0.0653,
    "pivots (A-2)": 0.161,
    "slide's mass (A-4)": 88.9,
    "pulse's rise (A-14)": 1.2e-3,
    "pulse's end (A-14)": 172.0,
}
"""The nearest one of an earlier search over 48 readings; a search begins with it and with ours."""

BESIDE: Sequence[Mapping[str, Any]] = (
    {"damping": 0.01},
    {"film's law": "short"},
    {"balls' clearance": 2.0},
    {"damping": 2.5545e8},
)
"""Keys elsewhere by which that search lost little, and Table 2's damping: flexible bodies are run
with each of them too, beside the best reading of rigid ones."""

OPEN: Mapping[str, Key] = {
    "observation": Values(MODELS),
    "damping": Values((2.5545e8, 8.08e6, 2.5545e5, 10.0, 0.01)),
    "damping depth": Range(low=1e-6, high=1e-4, log=True),
    "contact pulls (A-10)": Values((False, True)),
    "friction": Range(low=1e-3, high=0.1, log=True),
    "start": Values(("centred", "loaded")),
    "start angle": Values((0.0, 90.0, 180.0)),
    "pin's clearance": Values((1.0, 0.5, 2.0)),
    "balls' clearance": Values((1.0, 0.5, 2.0)),
    "film's law": Values(("pinkus", "pi_film", "short", "finite")),
    "viscosity (A-11)": Range(low=0.05, high=1.0, log=True),
    "bearing's length (A-12)": Range(low=0.05, high=0.2),
    "pivots (A-2)": Range(low=0.16, high=0.17),
    "counter-eccentric (A-3)": Range(low=0.012, high=0.02),
    "slide's mass (A-4)": Range(low=30.0, high=120.0, log=True),
    "8 with ball 9 (A-5)": Range(low=155.3, high=175.0),
    "linkage's centre (A-6)": Range(low=-0.05, high=0.05),
    "masses of 5 to 8 (A-7)": Values((1.0, 0.5)),
    "guides (A-9)": Values(("ideal", 1e9, 3e8, 1e8)),
    "pulse's rise (A-14)": Range(low=2e-4, high=1e-2, log=True),
    "pulse's end (A-14)": Range(low=150.0, high=200.0),
}
"""Damping, N s/m: Table 2's value; 1 % of K in N/mm^1.5 as N s/mm; a thousandth of the first; 0.01
in ADAMS' N s/mm; 0.01 as it stands. A clearance of half is a diametral one read as radial; two is
the reverse. Guides: lateral stiffness, N/m."""


def as_read(scene: Scene, reading: Mapping[str, Any]) -> Scene:
    """Return one of the paper's scenes under a reading; what it has not is left out.

    Raises:
        InputError: the reading is not allowed.
    """
    rise, guides = reading["pulse's rise (A-14)"], reading["guides (A-9)"]
    changes: dict[str, Any] = {
        "start": reading["start"],
        "start_angle_deg": reading["start angle"],
        **dict.fromkeys(LINK_MASSES, times(reading["masses of 5 to 8 (A-7)"])),
        "press.pivot_distance": reading["pivots (A-2)"],
        "press.counter_eccentricity": reading["counter-eccentric (A-3)"],
        "press.slide_mass": reading["slide's mass (A-4)"],
        "press.plunger_mass": reading["8 with ball 9 (A-5)"] * reading["masses of 5 to 8 (A-7)"],
        "press.linkage_mass_offset": reading["linkage's centre (A-6)"],
        "contact.damping_max": reading["damping"],
        "contact.damping_depth": reading["damping depth"],
        "contact.tension": reading["contact pulls (A-10)"],
        "friction.mu_static": reading["friction"],
        "friction.mu_kinetic": reading["friction"],
        "film.law": reading["film's law"],
        "film.viscosity": reading["viscosity (A-11)"],
        "film.length": reading["bearing's length (A-12)"],
        "load.blanking.rise": rise,
        "load.blanking.fall": rise / 2.0,
        "load.blanking.end_angle_deg": reading["pulse's end (A-14)"],
    }
    if guides != "ideal":
        changes["guide"] = {"lateral_stiffness": guides}
    for table, key in (("crank_pin", "pin's clearance"), ("balls", "balls' clearance")):
        if reading[key] != 1.0:
            changes[f"joints.{table}.clearance"] = times(reading[key])
    return scene.replace(values_in(scene, changes))


def alternatives(name: str, value: Any) -> list[Any]:
    """Return what else a key may be: all other values, or the ends of its range."""
    key = OPEN[name]
    if isinstance(key, Values):
        return [other for other in key.values if other != value]
    assert isinstance(key, Range)
    return [key.low, key.high]


def in_words(value: Any) -> str:
    """Return a value as a table has it."""
    if isinstance(value, bool) or not isinstance(value, float):
        return {True: "yes", False: "no"}.get(value, str(value))
    return f"{value:.3g}"
