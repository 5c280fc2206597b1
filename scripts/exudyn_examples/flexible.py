"""Flexible bodies of Exudyn's own."""

import exudyn.utilities as items
from exudyn.beams import GenerateStraightLineANCFCable2D

from exudyn_examples.example import GRAVITY

__all__ = ["ancf_pendulum"]


def ancf_pendulum(mbs, elements=4):
    """A soft cable of ANCF elements that hangs on a hinge and falls."""
    width, modulus = 0.05, 2.1e8
    cable = items.ObjectANCFCable2D(
        massPerLength=10.0,
        bendingStiffness=modulus * width**4 / 12.0,
        axialStiffness=modulus * width**2,
    )
    GenerateStraightLineANCFCable2D(
        mbs=mbs,
        positionOfNode0=[0, 0, 0],
        positionOfNode1=[1.0, 0, 0],
        numberOfElements=elements,
        cableTemplate=cable,
        massProportionalLoad=[0, -GRAVITY, 0],
        fixedConstraintsNode0=[1, 1, 0, 0],
    )
