"""Random mechanisms in the words of a mechanism file."""

import math
from typing import Any

import numpy as np

__all__ = ["eccentric", "four_bar", "knuckle"]


def eccentric(random: np.random.Generator, size: float) -> dict[str, Any]:
    """Return a random eccentric press: crank, rod, and a slide beside the crank's centre.

    Args:
        random: generator.
        size: factor on lengths; masses go with its cube. A crank has 10 to 150 mm times this.
    """
    crank = size * float(random.uniform(0.01, 0.15))
    aside = crank * float(random.uniform(-0.3, 0.3))
    rod = crank * float(random.uniform(3.0, 6.0))
    low = -math.sqrt(rod**2 - aside**2) + crank
    mass = size**3 * float(10.0 ** random.uniform(-0.5, 2.0))
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


def four_bar(random: np.random.Generator, size: float) -> dict[str, Any]:
    """Return a random crank-rocker; arguments as those of `eccentric`."""
    crank = size * float(random.uniform(0.02, 0.15))
    coupler, rocker = crank * random.uniform([2.5, 2.0], [5.0, 4.0])
    # Grashof's rule, with room for the transmission angle
    frame = float(random.uniform(coupler - rocker, coupler + rocker)) * 0.5 + 1.5 * crank
    frame = min(max(frame, abs(coupler - rocker) + 1.5 * crank), coupler + rocker - 1.5 * crank)
    at = float(random.uniform(0.0, 2.0 * math.pi))
    pin = [crank * math.cos(at), crank * math.sin(at)]
    to_pivot = [frame - pin[0], -pin[1]]
    distance = math.hypot(*to_pivot)
    along = (distance**2 + coupler**2 - rocker**2) / (2.0 * distance)
    across = math.sqrt(coupler**2 - along**2)
    knuckle = [
        float(pin[0] + (along * to_pivot[0] - across * to_pivot[1]) / distance),
        float(pin[1] + (along * to_pivot[1] + across * to_pivot[0]) / distance),
    ]
    mass = size**3 * float(10.0 ** random.uniform(-0.5, 1.5))
    weights = random.uniform(0.3, 2.0, 2)
    return {
        "name": "crank_rocker",
        "crank": "crank",
        "output": {"body": "rocker", "direction": [1, 0]},
        "bodies": {
            "crank": _body([0.5 * pin[0], 0.5 * pin[1]], mass, mass * crank**2),
            "coupler": _body(_middle(pin, knuckle), mass * float(weights[0])),
            "rocker": _body(_middle([frame, 0.0], knuckle), mass * float(weights[1])),
        },
        "joints": {
            "shaft": _joint([0.0, 0.0], "crank", "frame"),
            "crank_pin": _joint(pin, "crank", "coupler"),
            "knuckle": _joint(knuckle, "rocker", "coupler"),
            "pivot": _joint([frame, 0.0], "rocker", "frame"),
        },
    }


def knuckle(random: np.random.Generator, size: float) -> dict[str, Any]:
    """Return a random knuckle press: crank, rod, two links and a ram; arguments likewise."""
    cubed = size**3
    size *= float(random.uniform(0.1, 0.6))
    links = size * random.uniform([0.35, 0.35], [0.65, 0.65])
    bent = np.radians(random.uniform(12.0, 25.0))  # of the upper link, as drawn
    pin = [-float(links[0] * math.sin(bent)), size - float(links[0] * math.cos(bent))]
    low = pin[1] - math.sqrt(links[1] ** 2 - pin[0] ** 2)
    crank = float(random.uniform(0.3, 0.6)) * abs(pin[0])
    shaft = [pin[0] - float(random.uniform(0.8, 1.4)) * size, pin[1]]
    mass = cubed * float(10.0 ** random.uniform(0.0, 1.5))
    ram = mass * float(random.uniform(2.0, 10.0))
    crank_pin, pivot, wrist = [shaft[0], shaft[1] + crank], [0.0, size], [0.0, low]
    return {
        "name": "knuckle",
        "crank": "crank",
        "output": {"body": "ram", "direction": [0, 1]},
        "bodies": {
            "crank": _body(shaft, mass, mass * crank**2),
            "rod": _body(_middle(crank_pin, pin), mass),
            "upper_link": _body(_middle(pivot, pin), mass),
            "lower_link": _body(_middle(pin, wrist), mass),
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


def _middle(one: list[float], other: list[float]) -> list[float]:
    return [0.5 * (a + b) for a, b in zip(one, other, strict=True)]


def _body(centre: list[float], mass: float, inertia: float | None = None) -> dict[str, Any]:
    given = {"centre_of_mass": centre, "mass": mass}
    return given if inertia is None else {**given, "inertia": inertia}


def _joint(at: list[float], journal: str, bearing: str) -> dict[str, Any]:
    return {"at": at, "journal": journal, "bearing": bearing}
