"""The bearing rig of Sander et al. 2016: its sizes, oil and asperities, as its authors state them.

The relative clearance is an assumption of those who digitised the torque. Asperities are those of
Greenwood and Tripp, Proc. IMechE 185 (1970) 625-634: a pressure K E F(H), H = (h - delta) / sigma,
with F(H) = 4.4086e-5 (4 - H)^6.804. The package's contact is a power of the penetration, at most
the third: K of F = K d^3 is that which bears the same force at the thinnest film that is reported.
"""

import math
from pathlib import Path

import numpy as np

from exu_press import Scene

RIG = Path(__file__).parent / "sander_rig.toml"
VISCOSITY = 6.8e-3  # Pa s, at 100 C
SIGMA, DELTA, STIFFNESS = math.hypot(0.13e-6, 0.28e-6), 0.21e-6 + 0.39e-6, 1e-3 * 53.3e9
ROUGHNESS = math.hypot(0.20e-6, 0.34e-6)  # m
FRICTION = 0.02
RELATIVE_CLEARANCE = 1e-3
THINNEST = 0.7e-6  # m, at 150 rpm and 10 MPa
BEARINGS = {"test": (23.9e-3, 17.2e-3), "supports": (27e-3, 25e-3)}  # radius, length, m
LOADS = {10.0: 8e3, 5.0: 4e3}  # MPa -> N


def asperity_stiffness(radius, length):
    """Return K of F = K d^3, N/m^3, d below three roughnesses."""
    angle = np.linspace(-1.2, 1.2, 4001)
    gap = THINNEST + RELATIVE_CLEARANCE * radius * (1.0 - np.cos(angle))
    pressure = STIFFNESS * 4.4086e-5 * np.clip(4.0 - (gap - DELTA) / SIGMA, 0.0, None) ** 6.804
    force = radius * length * np.trapezoid(pressure * np.cos(angle), angle)
    return float(force) / (3.0 * ROUGHNESS - THINNEST) ** 3


def tables(clearance=1.0):
    """Return the rig's scene but for load and speed; the clearance over that of the authors."""
    joints, film = {}, {"viscosity": VISCOSITY, "at_contact": "mixed", "roughness": ROUGHNESS}
    for name, (radius, length) in BEARINGS.items():
        stiffness = asperity_stiffness(radius, length)
        joints[name] = {
            "kind": "lubricated",
            "radius": radius,
            "clearance": clearance * RELATIVE_CLEARANCE * radius,
            "film": {"length": length},
            "contact": {"shape": "point", "stiffness": stiffness, "exponent": 3.0},
        }
    return {
        "mechanism": str(RIG),
        "gravity": 0.0,
        "revolutions": 2.0,
        "settle": 1.0,
        "joints": joints,
        "film": film,
        "friction": {"law": "coulomb", "mu_kinetic": FRICTION},
        "load": {
            "test": load("test_slide"),
            "support_1": load("support_slide_1"),
            "support_2": load("support_slide_2"),
        },
    }


def load(body):
    return {
        "kind": "table",
        "body": body,
        "direction": [0.0, 1.0],
        "time": [0.0, 1.0],
        "force": [1.0, 1.0],
    }


def under(pressure, speed_rpm):
    """Return the keys that a load (MPa) and a speed change."""
    force = LOADS[pressure]
    return {
        "speed_rpm": speed_rpm,
        "load.test.factor": -force,
        "load.support_1.factor": 0.5 * force,
        "load.support_2.factor": 0.5 * force,
    }


def scene(pressure, speed_rpm, clearance=1.0):
    return Scene.from_dict(tables(clearance)).replace(under(pressure, speed_rpm))
