"""What the paper leaves open, and how far it may lie from our assumption: one change at a time."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from exu_press.scene import Scene
from fe_models import CRANK_STEEL, LINKAGE_IRON

__all__ = ["AS_THEY_ARE", "FLEXIBLE", "QUICK", "SETTINGS", "Setting", "Times"]

AS_THEY_ARE = "as they are"
"""Stands for no change among the changes."""


@dataclass(frozen=True)
class Times:
    """A multiple of what the scene has."""

    factor: float


@dataclass(frozen=True)
class Setting:
    """One change.

    Attributes:
        factor: what is varied, in words; the assumption's number behind it.
        label: the value, in words.
        changes: scene keys and their values, or multiples.
        whole_run: observe the run from its start on, not its last revolution alone.
        model: of observation, instead of the one that all numbers are compared under.
    """

    factor: str
    label: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    whole_run: bool = False
    model: str | None = None

    @property
    def words(self) -> str:
        """What is changed, to what."""
        return f"{self.factor} = {self.label}"

    def applies(self, scene: Scene) -> bool:
        """Return whether a scene has what is changed, and otherwise than it is changed to."""
        return all(_place(scene, name)[1] for name in self.changes) and (
            not self.changes or self.on(scene) != scene
        )

    def on(self, scene: Scene) -> Scene:
        """Return the changed scene."""
        changes = {
            name: value.factor * _place(scene, name)[0] if isinstance(value, Times) else value
            for name, value in self.changes.items()
        }
        return scene.replace(changes) if changes else scene


def _place(scene: Scene, name: str) -> tuple[Any, bool]:
    """Return the value of a key, and whether the scene uses it."""
    table, _, inner = name.rpartition(".")
    if not table:
        return getattr(scene, inner), True
    if table.startswith("joints."):
        joint = scene.joints[scene.joints.members(table.removeprefix("joints."))[0]]
        return getattr(joint, inner), joint.kind != "ideal"
    if name.startswith("bodies."):
        body = scene.bodies.get(name.split(".")[1])
        return getattr(body, inner, None), body is not None
    if table.startswith("load."):
        load = scene.load.get(table.removeprefix("load."))
        return getattr(load, inner, None), load is not None
    place = getattr(scene, table)
    if place is None:
        return None, False
    value = getattr(place, inner)
    if name in ("contact.shape", "contact.modulus"):
        return value, scene.joints["crank_pin"].kind == "dry"
    return value, True


def _both(factor: str, key: str, values: Mapping[str, Any]) -> tuple[Setting, ...]:
    """Return a setting for each value, by label, of one key of crank shaft and linkage."""
    return tuple(
        Setting(factor, label, {f"bodies.{body}.{key}": value for body in ("crank", "linkage")})
        for label, value in values.items()
    )


def _moduli(factors: Mapping[str, float]) -> tuple[Setting, ...]:
    """Return a setting for each factor, by label, of both materials' moduli of elasticity."""
    materials = {"crank": CRANK_STEEL, "linkage": LINKAGE_IRON}
    return tuple(
        Setting(
            "modulus",
            label,
            {
                f"bodies.{body}.youngs_modulus": factor * material.youngs_modulus
                for body, material in materials.items()
            },
        )
        for label, factor in factors.items()
    )


def _series(factor: str, key: str, values: Mapping[str, Any]) -> tuple[Setting, ...]:
    """Return a setting for each value, by label, of one key."""
    return tuple(Setting(factor, label, {key: value}) for label, value in values.items())


LINK_MASSES = tuple(f"press.{name}_mass" for name in ("link_5", "link_6", "link_7", "plunger"))

SETTINGS: tuple[Setting, ...] = (
    *_series(
        "pivots from the middle, A-2", "press.pivot_distance", {"0.16 m": 0.16, "0.17 m": 0.17}
    ),
    *_series(
        "counter-eccentric, A-3", "press.counter_eccentricity", {"0.012 m": 0.012, "0.02 m": 0.02}
    ),
    *_series("mass of slide 4, A-4", "press.slide_mass", {"30 kg": 30.0, "120 kg": 120.0}),
    *_series(
        "mass of 8 with ball 9, A-5", "press.plunger_mass", {"135 kg": 135.0, "175 kg": 175.0}
    ),
    *_series("linkage's inertia, A-6", "press.linkage_mass_offset", {"centre 0.05 m up": -0.05}),
    *_series("linkage's inertia, A-6", "press.linkage_inertia", {"3.5 kg m²": 3.5}),
    Setting("masses of 5-8 are of both sides, A-7", "half", dict.fromkeys(LINK_MASSES, Times(0.5))),
    *_series("datum of the position, A-8", "press.bottom_dead_centre", {"0.466 m": 0.466}),
    Setting("guides, A-9", "elastic 1e9 N/m", {"guide": {}}),
    Setting("guides, A-9", "1e8 N/m", {"guide": {"lateral_stiffness": 1e8}}),
    Setting("contact pulls, A-10", "as printed", {"contact.tension": True}),
    *_series("viscosity, A-11", "film.viscosity", {"0.05 Pa s": 0.05, "1 Pa s": 1.0}),
    *_series("bearing length, A-12", "film.length", {"0.05 m": 0.05, "0.2 m": 0.2}),
    *_series(
        "film law", "film.law", {"short": "short", "finite": "finite", "exact long": "pi_film"}
    ),
    Setting("film's end, A-13", "mixed", {"film.at_contact": "mixed"}),
    Setting(
        "blanking pulse, A-14",
        "tau 0.1 ms",
        {"load.blanking.rise": 2e-4, "load.blanking.fall": 1e-4},
    ),
    Setting(
        "blanking pulse, A-14", "tau 5 ms", {"load.blanking.rise": 1e-2, "load.blanking.fall": 5e-3}
    ),
    *_series("blanking's end, A-14", "load.blanking.end_angle_deg", {"150°": 150.0, "200°": 200.0}),
    *_series(
        "contact damping c_max",
        "contact.damping_max",
        {"0.01 N s/m": 0.01, "2.55e5": 2.5545e5, "2.55e6": 2.5545e6, "2.5545e8": 2.5545e8},
    ),
    *_series("damping depth d_max", "contact.damping_depth", {"1 µm": 1e-6, "0.1 mm": 1e-4}),
    Setting("damping law", "Flores, 0.5", {"contact.damping": "flores"}),
    Setting(
        "damping law", "Flores, 0.9", {"contact.damping": "flores", "contact.restitution": 0.9}
    ),
    *_series(
        "contact stiffness K",
        "contact.stiffness",
        {"K / 4": Times(0.25), "4 K": Times(4.0), "31.6 K": Times(1e3**0.5)},
    ),
    Setting(
        "soft contact",
        "K 2e8, c_max 1e4",
        {"contact.stiffness": 2e8, "contact.damping_max": 1e4},
    ),
    Setting("pin's contact", "cylinder", {"contact.shape": "cylindrical"}),
    Setting("friction", "none", {"friction.law": "none"}),
    Setting("friction", "0.1", {"friction.mu_static": 0.1, "friction.mu_kinetic": 0.1}),
    Setting("friction", "bristles", {"friction.law": "lugre"}),
    *_series("Stribeck velocity v_s", "friction.stribeck_velocity", {"v_s / 10": Times(0.1)}),
    *_series(
        "clearance of the pin",
        "joints.crank_pin.clearance",
        {"half": Times(0.5), "twice": Times(2.0)},
    ),
    *_series(
        "clearance of the balls",
        "joints.balls.clearance",
        {"half": Times(0.5), "twice": Times(2.0)},
    ),
    *_series("gravity", "gravity", {"none": 0.0}),
    *_series("start angle", "start_angle_deg", {"90°": 90.0, "180°": 180.0}),
    Setting("observed span", "from the start", whole_run=True),
    Setting("observation model", "1 kHz", model="differentiated_1khz"),
    Setting("observation model", "resolved", model="resolved"),
    *_series("integration", "solver.step", {"1 ms steps": 1e-3, "0.1 ms steps": 1e-4}),
    *_series("integration", "solver.tolerance", {"tolerance 1e-3": 1e-3}),
)
"""On rigid bodies, where a run takes a second."""

FLEXIBLE: tuple[Setting, ...] = (
    *_both("modes", "modes", {"4": 4, "40": 40}),
    *_both("damping ratio", "damping_ratio", {"0.5 %": 0.005, "5 %": 0.05}),
    *_moduli({"half": 0.5, "twice": 2.0}),
    Setting("shapes", "second", {"bodies.crank": "crank_2", "bodies.linkage": "linkage_2"}),
    *_both("reduction", "method", {"free modes": "free"}),
    Setting("bodies", "rigid", {"bodies": {}}),
    *(
        setting
        for setting in SETTINGS
        if setting.factor
        in ("clearance of the balls", "viscosity, A-11", "start angle", "observed span")
    ),
)
"""On flexible bodies, for two numbers: what only they have, and what they share with rigid ones."""

QUICK = ("viscosity, A-11", "clearance of the balls", "observation model")
"""Factors of the reduced study."""
