"""Every normal contact, and states to try it in."""

import random

from exu_press.laws.contact import DAMPING_LAWS, NormalContact, cylindrical, hertz, step_damping

# Delivered restitution for a wanted 0.1, 0.5, 0.9: the roots of
# ln[(1 + chi) / (1 - chi e)] = chi (1 + e) for each paper's chi.
WANTED = (0.1, 0.5, 0.9)
DELIVERED = {
    "hunt_crossley": (0.5158, 0.6630, 0.9090),
    "lankarani_nikravesh": (0.6653, 0.7252, 0.9132),
    "flores": (0.0694, 0.4704, 0.8939),
    "gonthier": (0.1010, 0.4877, 0.8764),
    "hu_guo": (0.0741, 0.4877, 0.8999),
}
CASES = [
    (law, wanted, delivered)
    for law, row in DELIVERED.items()
    for wanted, delivered in zip(WANTED, row, strict=True)
]
STIFFNESSES = {
    "hertz": hertz(1e8),
    "linear": hertz(1e6, exponent=1.0),
    "cylindrical": cylindrical(modulus=113.7e9, length=0.1, clearance=50e-6),
}


def contacts(tension: bool = False) -> dict[str, NormalContact]:
    """Every damping law on Hertz's stiffness, moderately damped."""
    made = {name: DAMPING_LAWS[name](STIFFNESSES["hertz"], 0.6, tension) for name in DELIVERED}
    made["step"] = step_damping(STIFFNESSES["hertz"], 1e3, 1e-4, tension)
    return made


def random_states(count: int) -> list[tuple[float, float, float]]:
    """Return (penetration, rate, impact speed), penetrations on both sides of d_max = 1e-4."""
    rng = random.Random(3)
    return [
        (10 ** rng.uniform(-8, -3), rng.uniform(-1, 1), 10 ** rng.uniform(-4, 0))
        for _ in range(count)
    ]


def chi_of(contact: NormalContact) -> float:
    """Damping force at elastic force 1, rate 1 and impact speed 1."""
    return contact.damping(1.0, 1.0, 1.0, 1.0, 1.0)[0]
