"""Contacts of Exudyn's."""

import math

import exudyn.utilities as items

from exudyn_examples.example import GRAVITY
from systems_by_chance.chance import SPATIAL

__all__ = ["falling"]

RADIUS = 0.1  # m


def falling(by):
    """Balls that fall onto each other and onto a large one, some with friction."""
    mass = by.between(0.1, 5.0)
    stiffness, rebound = mass * by.between(1e4, 1e7), by.choice([0.3, 0.6, 0.9])
    law = by.choice(
        [
            {"contactDamping": 0.05 * math.sqrt(stiffness * mass)},
            {"restitutionCoefficient": rebound, "impactModel": 1, "minimumImpactVelocity": 1e-3},
            {"restitutionCoefficient": rebound, "impactModel": 2, "minimumImpactVelocity": 1e-3},
        ]
    )
    below = by.mbs.CreateGround(referencePosition=[0.0, 0.0, -1.0])
    friction, radius = by.choice([0.0, 0.2]), 1.0
    high = RADIUS
    for _ in range(by.randint(1, 3)):
        high += by.uniform(0.02, 0.3)
        body = by.mbs.CreateRigidBody(
            inertia=items.InertiaSphere(mass, RADIUS),
            referencePosition=[by.uniform(-0.02, 0.02), 0.0, high],
            initialVelocity=[by.uniform(-0.2, 0.2), 0.0, 0.0],
            gravity=[0.0, 0.0, -GRAVITY],
            nodeType=by.choice(SPATIAL),
        )
        by.mbs.CreateSphereSphereContact(
            itemNumbers=[below, body],
            spheresRadii=[radius, RADIUS],
            contactStiffness=stiffness,
            dynamicFriction=friction,
            frictionProportionalZone=0.01,
            **law,
        )
        below, radius = body, RADIUS
        high += 2.0 * RADIUS
