"""The tables of a scene, and which of them and of their keys a scene does not use."""

from collections.abc import Mapping
from typing import Any

from exu_press.mechanism import Press, SliderCrank
from exu_press.scene.joint_changes import peek
from exu_press.scene.tables import Contact, ElasticGuide, Film, Friction, Motor, Solver

__all__ = ["TABLES", "unused_keys"]

OF_THE_COUNTERWEIGHT = (
    "counter_eccentricity",
    "counter_linkage_length",
    "counter_linkage_mass",
    "counterweight_mass",
    "counterweight_inertia",
)

OF_THE_WAYS = (
    "width",
    "friction",
    "mu_static",
    "mu_kinetic",
    "stribeck_velocity",
    "regularisation_velocity",
    "damping_depth",
)
"""Keys of guides with clearance."""

OF_FRICTION = ("mu_static", "mu_kinetic", "stribeck_velocity", "regularisation_velocity")
"""Keys of guides that rub."""

OF_KLOSS = ("rated_torque", "slip", "breakdown_torque", "no_load_speed_rpm")
"""Keys of a motor without a table of its torque."""

TABLES = {
    "contact": Contact,
    "friction": Friction,
    "film": Film,
    "drive": Motor,
    "guide": ElasticGuide,
    "solver": Solver,
    "press": Press,
    "slider_crank": SliderCrank,
}


def unused_keys(scene: Mapping[str, Any]) -> dict[str, str]:
    """Return the tables and keys that a scene does not use, each with its reason.

    Args:
        scene: its keys, before or after they have been checked.
    """
    mechanism = scene["mechanism"]
    shown = repr(mechanism) if isinstance(mechanism, str) else "the scene's own"
    found = {
        name: f"mechanism is {shown}" for name in ("press", "slider_crank") if name != mechanism
    }
    bare = peek(scene.get("press"), "counterweight") is False
    why = found.get("press") or ("press.counterweight is false" if bare else "")
    found |= {f"press.{name}": why for name in OF_THE_COUNTERWEIGHT if why}
    if peek(scene.get("guide"), "clearance") is None:
        found |= {f"guide.{name}": "guide.clearance is not given" for name in OF_THE_WAYS}
    else:
        if peek(scene["guide"], "friction", "none") == "none":
            why = 'guide.friction is "none"'
            found |= {f"guide.{name}": why for name in OF_FRICTION}
        why = "guide.clearance is given: the two ends of the body carry its tilting moment"
        found |= dict.fromkeys(("guide.tilting_stiffness", "guide.tilting_damping"), why)
    if peek(scene.get("drive"), "table_torque") is not None:
        why = "drive.table_torque is given"
        found |= {f"drive.{name}": why for name in OF_KLOSS}
    return found
