"""The three scenes, their true keys, and what is measured of each."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from exu_press.scene import Scene

__all__ = ["CASES", "Case"]


@dataclass(frozen=True)
class Case:
    """A scene and what is fitted in it.

    Attributes:
        scene: with the true keys.
        keys: name -> range.
        numbers: quantity -> standard deviation of its measurement over its value.
        measurements: how many synthetic ones.
    """

    scene: Scene
    keys: Mapping[str, Any]
    numbers: Mapping[str, float]
    measurements: int

    @property
    def truth(self) -> dict[str, float]:
        """The true keys."""
        found = self.scene.to_dict()
        values = {}
        for name in self.keys:
            place: Any = found
            for part in name.split("."):
                place = place[part]
            values[name] = float(place)
        return values


def ranged(low: float, high: float) -> dict[str, Any]:
    return {"low": low, "high": high, "log": True}


def scene(**keys: Any) -> Scene:
    return Scene.from_dict(keys)


CASES: Mapping[str, Case] = {
    "lubricated press": Case(
        scene(
            joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4}, "balls": "ideal"},
            film={"law": "finite", "viscosity": 0.1},
            revolutions=0.5,
            solver={"tolerance": 1e-3},
        ),
        {
            "film.viscosity": ranged(0.03, 0.5),
            "joints.crank_pin.clearance": ranged(4e-5, 2e-4),
        },
        {
            "joints.crank_pin.dissipated": 0.05,
            "joints.crank_pin.min_film": 0.05,
            "joints.crank_pin.max_eccentricity_ratio": 0.03,
            "peak_acceleration.mean_1ms": 0.01,
        },
        14,
    ),
    "dry slider-crank": Case(
        scene(
            mechanism="slider_crank",
            joints={"crank_pin": {"kind": "dry", "clearance": 1e-4}},
            contact={"length": 0.1, "restitution": 0.6},
            friction={"mu_kinetic": 0.1},
            revolutions=0.25,
            start="centred",
        ),
        {
            "joints.crank_pin.clearance": ranged(4e-5, 2.5e-4),
            "friction.mu_kinetic": ranged(0.03, 0.28),
            "contact.restitution": {"low": 0.2, "high": 0.95},
        },
        {
            "joints.crank_pin.dissipated": 0.03,
            "peak_acceleration.resolved": 0.03,
            "peak_acceleration.mean_1ms": 0.03,
            "joints.crank_pin.peak_penetration": 0.03,
        },
        13,
    ),
    "motor with flywheel": Case(
        scene(
            mechanism="slider_crank",
            joints={"crank_pin": "ideal"},
            revolutions=1.5,
            settle=0.5,
            drive={"rated_torque": 400.0, "slip": 0.05, "inertia": 20.0},
            guide={
                "clearance": 1e-4,
                "width": 0.4,
                "friction": "coulomb",
                "mu_kinetic": 0.1,
            },
        ),
        {"drive.slip": ranged(0.02, 0.15), "guide.mu_kinetic": ranged(0.03, 0.35)},
        {
            "drive.fluctuation": 0.02,
            "drive.peak_torque": 0.03,
            "guides.slider.dissipated": 0.05,
        },
        13,
    ),
}
