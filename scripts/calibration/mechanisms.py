"""Random mechanisms in the words of a mechanism file."""

import math
from typing import Any

import numpy as np

__all__ = ["eccentric", "knuckle"]


def eccentric(random: np.random.Generator) -> dict[str, Any]:
    """Return a random eccentric press: crank, rod, and a slide beside the crank's centre."""
    crank = float(random.uniform(0.01, 0.15))
    aside = crank * float(random.uniform(-0.3, 0.3))
    rod = crank * float(random.uniform(3.0, 6.0))
    low = -math.sqrt(rod**2 - aside**2) + crank
    mass = float(10.0 ** random.uniform(-0.5, 2.0))
    slide = mass * float(random.uniform(0.5, 5.0))
    return {
        "name": "eccentric",
        "crank": "wheel",
        "output": {"body": "slide", "direction": [0, 1]},
        "bodies": {
            "wheel": _body([0.0, crank * float(random.uniform(0.0, 0.5))], mass, mass * crank**2),
            "rod": _body([0.5 * aside, 0.5 * (low + crank)], 0.5 * mass),
            "slide": _body([aside, low], slide, 0.1 * slide * crank**2),
        },
        "joints": {
            "main": _joint([0.0, 0.0], "wheel", "frame"),
            "big_end": _joint([0.0, crank], "wheel", "rod"),
            "small_end": _joint([aside, low], "slide", "rod"),
        },
        "guides": {"slide": {"direction": [0, 1]}},
    }


def knuckle(random: np.random.Generator) -> dict[str, Any]:
    """Return a random knuckle press: crank, rod, two links and a ram."""
    size = float(random.uniform(0.1, 0.6))
    links = size * random.uniform([0.35, 0.35], [0.65, 0.65])
    bent = np.radians(random.uniform(12.0, 25.0))  # of the upper link, as drawn
    pin = [-float(links[0] * math.sin(bent)), size - float(links[0] * math.cos(bent))]
    low = pin[1] - math.sqrt(links[1] ** 2 - pin[0] ** 2)
    crank = float(random.uniform(0.3, 0.6)) * abs(pin[0])
    shaft = [pin[0] - float(random.uniform(0.8, 1.4)) * size, pin[1]]
    mass = float(10.0 ** random.uniform(0.0, 1.5))
    ram = mass * float(random.uniform(2.0, 10.0))

    def middle(one: list[float], other: list[float]) -> list[float]:
        return [0.5 * (a + b) for a, b in zip(one, other, strict=True)]

    crank_pin, pivot, wrist = [shaft[0], shaft[1] + crank], [0.0, size], [0.0, low]
    return {
        "name": "knuckle",
        "crank": "crank",
        "output": {"body": "ram", "direction": [0, 1]},
        "bodies": {
            "crank": _body(shaft, mass, mass * crank**2),
            "rod": _body(middle(crank_pin, pin), mass),
            "upper_link": _body(middle(pivot, pin), mass),
            "lower_link": _body(middle(pin, wrist), mass),
            "ram": _body(wrist, ram, 0.05 * ram * size**2),
        },
        "joints": {
            "shaft": _joint(shaft, "crank", "frame"),
            "crank_pin": _joint(crank_pin, "crank", "rod"),
            "knuckle_rod": _joint(pin, "upper_link", "rod"),
            "knuckle": _joint(pin, "upper_link", "lower_link"),
            "pivot": _joint(pivot, "upper_link", "frame"),
            "wrist_pin": _joint(wrist, "lower_link", "ram"),
        },
        "guides": {"ram": {"direction": [0, 1]}},
    }


def _body(centre: list[float], mass: float, inertia: float | None = None) -> dict[str, Any]:
    given = {"centre_of_mass": centre, "mass": mass}
    return given if inertia is None else {**given, "inertia": inertia}


def _joint(at: list[float], journal: str, bearing: str) -> dict[str, Any]:
    return {"at": at, "journal": journal, "bearing": bearing}
