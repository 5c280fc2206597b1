"""Cables and beams."""

import math

import exudyn.utilities as items
from exudyn.beams import GenerateStraightBeam, GenerateStraightLineANCFCable

from exudyn_examples.example import GRAVITY
from exudyn_examples.flexible import cables, hold, weight

__all__ = ["beam", "cable", "rope"]


def cable(by):
    """A cable of beams, clamped or hung, that falls."""
    damping = by.choice([0.0, 0.001, 0.01]), by.choice([0.0, 0.001])
    nodes, bodies = cables(by.mbs, by.between(1e5, 1e9), *damping, by.choice([2, 4, 8]))
    hold(by.mbs, nodes[0], by.choice([(0, 1), (0, 1, 3)]))
    for body in bodies:
        weight(by.mbs, body)


def beam(by):
    """A geometrically exact beam in the plane, clamped or hinged."""
    side, modulus = by.between(0.005, 0.05), by.between(1e6, 1e10)
    area, bending = side**2, modulus * side**4 / 12.0
    GenerateStraightBeam(
        by.mbs,
        [0.0] * 3,
        [1.0, 0.0, 0.0],
        by.choice([2, 4, 8]),
        items.Beam2D(
            nodeNumbers=[-1, -1],
            massPerLength=1000.0 * area,
            crossSectionInertia=1000.0 * side**4 / 12.0,
            bendingStiffness=bending,
            axialStiffness=modulus * area,
            shearStiffness=modulus * area / 3.0,
            bendingDamping=by.choice([0.0, 0.01]) * bending,
            axialDamping=by.choice([0.0, 0.001]) * modulus * area,
        ),
        gravity=[0.0, -GRAVITY, 0.0],
        fixedConstraintsNode0=by.choice([[1, 1, 1], [1, 1, 0]]),
        fixedConstraintsNode1=None,
    )


def rope(by):
    """A cable in space, clamped or hung, free or guided at its other end."""
    thick, modulus = by.between(0.003, 0.03), by.between(1e6, 1e10)
    area, bending = math.pi * thick**2 / 4.0, modulus * math.pi * thick**4 / 64.0
    GenerateStraightLineANCFCable(
        mbs=by.mbs,
        positionOfNode0=[0.0] * 3,
        positionOfNode1=[1.0, by.uniform(-0.1, 0.1), 0.0],
        numberOfElements=by.choice([2, 4, 8]),
        cableTemplate=items.ObjectANCFCable(
            massPerLength=1000.0 * area,
            bendingStiffness=bending,
            axialStiffness=modulus * area,
            bendingDamping=by.choice([0.0, 0.02]) * bending,
            axialDamping=by.choice([0.0, 0.001]) * modulus * area,
        ),
        massProportionalLoad=[0.0, -GRAVITY, by.choice([0.0, 2.0])],
        fixedConstraintsNode0=by.choice([[1, 1, 1, 0, 1, 1], [1, 1, 1, 0, 0, 0]]),
        fixedConstraintsNode1=by.choice([None, [0, 1, 1, 0, 0, 0]]),
    )
