"""Degrees of freedom of a drawing: counted, and as its joints and guides leave them.

The count of Chebyshev, Gruebler and Kutzbach takes every joint and guide for independent. The rank
of the constraints' Jacobian tells how many are, so that parallel links and doubled guides are
counted once [1]_.

References
----------
.. [1] E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn & Bacon 1989,
   chapter 3.
"""

from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.planar_constraints import null_space
from exu_press.numerics.arrays import Array

__all__ = ["Mobility", "mobility_of"]


@dataclass(frozen=True)
class Mobility:
    """Mobility of a drawing at one position.

    Attributes:
        bodies: number of moving bodies, three degrees of freedom each.
        joints: number of joints, which hold two each.
        guides: number of guides, which hold two each.
        degrees: degrees of freedom, at first order.
        turns: whether the crank can turn, at first order.
        loose: names of bodies that move although the crank is held.
        too_many: names of joints and guides without any one of which the crank could turn, less
            its shaft; none where it can.
    """

    bodies: int
    joints: int
    guides: int
    degrees: int
    turns: bool
    loose: tuple[str, ...]
    too_many: tuple[str, ...]

    @property
    def counted(self) -> int:
        """Degrees of freedom if all joints and guides were independent."""
        return 3 * self.bodies - 2 * self.joints - 2 * self.guides

    @property
    def redundant(self) -> int:
        """Number of constraints that others hold already."""
        return self.degrees - self.counted

    @property
    def right(self) -> bool:
        """Return whether the crank turns and all else follows it."""
        return self.turns and not self.loose


def mobility_of(mechanism: Mechanism) -> Mobility:
    """Return a mechanism's mobility with ideal joints and guides, as it is drawn."""
    constraints = mechanism.constraints
    jacobian = constraints.jacobian(np.array(constraints.drawn))
    held = constraints.angle(mechanism.crank)[None]

    def free(left_out: str, *further: Array) -> Array:
        rows = [rows for name, rows in constraints.rows.items() if name != left_out]
        return null_space(np.vstack([jacobian[np.concatenate(rows)], *further]))

    def turns(left_out: str) -> bool:
        return len(free(left_out)) > len(free(left_out, held))

    moving = turns("")
    suspects = [] if moving else list(constraints.rows)
    return Mobility(
        bodies=len(mechanism.bodies),
        joints=len(mechanism.joints),
        guides=len(mechanism.guides),
        degrees=len(free("")),
        turns=moving,
        loose=constraints.moving(free("", held)),
        too_many=tuple(
            name for name in suspects if name != f"joints.{mechanism.shaft.name}" and turns(name)
        ),
    )
