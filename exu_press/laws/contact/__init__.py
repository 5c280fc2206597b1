"""Normal contact, all of it under one name.

>>> contact = hunt_crossley(hertz(2.5545e10), restitution=0.9)
>>> force, by_penetration, by_rate = contact.force(penetration=1e-6, rate=0.05, impact_speed=0.1)
>>> round(force, 3)
27.461

Stiffness in `stiffness`, damping in `damping`, what a law delivers in `restitution`.
"""

from exu_press.laws.contact.damping import (
    DAMPING_LAWS,
    Approach,
    NormalContact,
    flores,
    gonthier,
    hu_guo,
    hunt_crossley,
    hysteretic,
    lankarani_nikravesh,
    step,
    step_damping,
)
from exu_press.laws.contact.restitution import delivered_restitution, restitution_of
from exu_press.laws.contact.stiffness import Stiffness, cylindrical, hertz, hertz_stiffness

__all__ = [
    "DAMPING_LAWS",
    "Approach",
    "NormalContact",
    "Stiffness",
    "cylindrical",
    "delivered_restitution",
    "flores",
    "gonthier",
    "hertz",
    "hertz_stiffness",
    "hu_guo",
    "hunt_crossley",
    "hysteretic",
    "lankarani_nikravesh",
    "restitution_of",
    "step",
    "step_damping",
]
