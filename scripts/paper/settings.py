"""What the paper leaves open, and how far it may lie from our assumption: one change at a time."""

from collections.abc import Callable, Mapping
from typing import Any

from exu_press.scene import Scene
from fe_models import CRANK_STEEL, LINKAGE_IRON

__all__ = ["FLEXIBLE", "LINK_MASSES", "QUICK", "SETTINGS", "changed", "times", "values_in"]

Changes = Mapping[str, Any]

LINK_MASSES = tuple(f"press.{name}_mass" for name in ("link_5", "link_6", "link_7", "plunger"))


def times(factor: float) -> Callable[[float], float]:
    """Stand for a multiple of what the scene has."""
    return lambda value: factor * value


SETTINGS: Mapping[str, Changes] = {
    "pivots from the middle 0.16 m (A-2)": {"press.pivot_distance": 0.16},
    "pivots from the middle 0.17 m (A-2)": {"press.pivot_distance": 0.17},
    "counter-eccentric 0.02 m (A-3)": {"press.counter_eccentricity": 0.02},
    "slide 4 of 120 kg (A-4)": {"press.slide_mass": 120.0},
    "8 with ball 9 of 175 kg (A-5)": {"press.plunger_mass": 175.0},
    "linkage's centre 0.05 m up (A-6)": {"press.linkage_mass_offset": -0.05},
    "linkage's inertia 3.5 kg m² (A-6)": {"press.linkage_inertia": 3.5},
    "half the masses of 5 to 8 (A-7)": dict.fromkeys(LINK_MASSES, times(0.5)),
    "elastic guides, 1e9 N/m (A-9)": {"guide": {"lateral_stiffness": 1e9}},
    "elastic guides, 1e8 N/m (A-9)": {"guide": {"lateral_stiffness": 1e8}},
    "contact pulls, as printed (A-10)": {"contact.tension": True},
    "viscosity 0.05 Pa s (A-11)": {"film.viscosity": 0.05},
    "viscosity 1 Pa s (A-11)": {"film.viscosity": 1.0},
    "bearing 0.05 m long (A-12)": {"film.length": 0.05},
    "bearing 0.2 m long (A-12)": {"film.length": 0.2},
    "film law: short": {"film.law": "short"},
    "film law: finite": {"film.law": "finite"},
    "film law: exact long": {"film.law": "pi_film"},
    "film and contact mixed (A-13)": {"film.at_contact": "mixed"},
    "blanking pulse, tau 0.1 ms (A-14)": {"load.blanking.rise": 2e-4, "load.blanking.fall": 1e-4},
    "blanking pulse, tau 5 ms (A-14)": {"load.blanking.rise": 1e-2, "load.blanking.fall": 5e-3},
    "blanking ends at 150° (A-14)": {"load.blanking.end_angle_deg": 150.0},
    "blanking ends at 200° (A-14)": {"load.blanking.end_angle_deg": 200.0},
    "c_max 0.01 N s/m": {"contact.damping_max": 0.01},
    "c_max 2.5545e5 N s/m": {"contact.damping_max": 2.5545e5},
    "c_max 2.5545e6 N s/m": {"contact.damping_max": 2.5545e6},
    "d_max 1 µm": {"contact.damping_depth": 1e-6},
    "d_max 0.1 mm": {"contact.damping_depth": 1e-4},
    "damping of Flores, 0.5": {"contact.damping": "flores"},
    "damping of Flores, 0.9": {"contact.damping": "flores", "contact.restitution": 0.9},
    "K / 4": {"contact.stiffness": times(0.25)},
    "4 K": {"contact.stiffness": times(4.0)},
    "soft contact, K 2e8, c_max 1e4": {"contact.stiffness": 2e8, "contact.damping_max": 1e4},
    "pin's contact a cylinder's": {"contact.shape": "cylindrical"},
    "no friction": {"friction.law": "none"},
    "friction 0.1": {"friction.mu_static": 0.1, "friction.mu_kinetic": 0.1},
    "friction with bristles": {"friction.law": "lugre"},
    "v_s / 10": {"friction.stribeck_velocity": times(0.1)},
    "half the clearance of the pin": {"joints.crank_pin.clearance": times(0.5)},
    "twice the clearance of the pin": {"joints.crank_pin.clearance": times(2.0)},
    "half the clearance of the balls": {"joints.balls.clearance": times(0.5)},
    "twice the clearance of the balls": {"joints.balls.clearance": times(2.0)},
    "no gravity": {"gravity": 0.0},
    "start at 90°": {"start_angle_deg": 90.0},
    "start at 180°": {"start_angle_deg": 180.0},
    "steps of 0.1 ms": {"solver.step": 1e-4},
}
"""On rigid bodies; by what is changed, in words."""

QUICK = ("viscosity 0.05 Pa s (A-11)", "twice the clearance of the balls")
"""Those of the reduced study."""


def _both(key: str, value: Any) -> Changes:
    return {f"bodies.{body}.{key}": value for body in ("crank", "linkage")}


def _moduli(factor: float) -> Changes:
    return {
        "bodies.crank.youngs_modulus": factor * CRANK_STEEL.youngs_modulus,
        "bodies.linkage.youngs_modulus": factor * LINKAGE_IRON.youngs_modulus,
    }


FLEXIBLE: Mapping[str, Changes] = {
    "4 modes": _both("modes", 4),
    "40 modes": _both("modes", 40),
    "damping ratio 0.5 %": _both("damping_ratio", 0.005),
    "damping ratio 5 %": _both("damping_ratio", 0.05),
    "half the moduli": _moduli(0.5),
    "twice the moduli": _moduli(2.0),
    "second shapes": {"bodies.crank": "crank_2", "bodies.linkage": "linkage_2"},
    "free modes": _both("method", "free"),
}
"""What only flexible bodies have."""


def changed(scene: Scene, changes: Changes) -> Scene | None:
    """Return the changed scene; None where the scene has not what is changed, or has it so."""
    values = values_in(scene, changes)
    film_alone = "contact.shape" in changes and scene.joints["crank_pin"].kind != "dry"
    if len(values) < len(changes) or film_alone:
        return None
    other = scene.replace(values)
    return None if other == scene else other


def values_in(scene: Scene, changes: Changes) -> dict[str, Any]:
    """Return the values of the changes whose table the scene has."""
    values = {}
    for name, value in changes.items():
        table, _, inner = name.rpartition(".")
        if (place := _place(scene, table)) is not None:
            if callable(value):
                value = value(place[inner] if isinstance(place, Mapping) else getattr(place, inner))
            values[name] = value
    return values


def _place(scene: Scene, table: str) -> Any:
    """Return what a table of keys stands for in a scene; None where the scene does not have it."""
    if table.startswith("joints."):
        return scene.joints[scene.joints.members(table.removeprefix("joints."))[0]]
    if table.startswith("bodies."):
        return scene.bodies.get(table.removeprefix("bodies."))
    if table.startswith("load."):
        return scene.load.get(table.removeprefix("load."))
    return getattr(scene, table) if table and table != "bodies" else scene
