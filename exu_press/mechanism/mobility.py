"""Degrees of freedom of a drawing: counted, and as its joints and guides leave them.

The count of Chebyshev, Gruebler and Kutzbach takes every joint and guide for independent. The rank
of the constraints' Jacobian tells how many are, so that parallel links and doubled guides are
counted once [1]_.

References
----------
.. [1] E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn & Bacon 1989,
   chapter 3.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.constraint_rows import ConstraintRows
from exu_press.mechanism.mechanism import Mechanism
from exu_press.numerics.arrays import Array

__all__ = ["Mobility", "mobility_of"]

INDEPENDENT = 1e-9
"""Smallest singular value, relative to the largest, of constraints that count as independent."""


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
    jacobian = ConstraintRows(mechanism, {body.name: body.angle for body in mechanism.bodies})
    rows = {f"joints.{joint.name}": jacobian.of_joint(joint) for joint in mechanism.joints}
    for guide in mechanism.guides:
        both = jacobian.across(guide), jacobian.angle(guide.body)
        rows[f"guides.{guide.body}"] = np.array(both)
    held = jacobian.angle(mechanism.crank)[None, :]

    def degrees(chosen: Sequence[Array]) -> int:
        return jacobian.size - _rank(np.vstack(chosen))

    def turns(chosen: Sequence[Array]) -> bool:
        return degrees(chosen) > degrees([*chosen, held])

    every = list(rows.values())
    moving = turns(every)
    suspects = [] if moving else [name for name in rows if name != f"joints.{mechanism.shaft.name}"]
    too_many = tuple(
        name for name in suspects if turns([row for other, row in rows.items() if other != name])
    )
    return Mobility(
        bodies=len(mechanism.bodies),
        joints=len(mechanism.joints),
        guides=len(mechanism.guides),
        degrees=degrees(every),
        turns=moving,
        loose=tuple(mechanism.bodies[index].name for index in _moving(np.vstack([*every, held]))),
        too_many=too_many,
    )


def _rank(matrix: Array) -> int:
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > INDEPENDENT * values[0]).sum())


def _moving(matrix: Array) -> list[int]:
    """Return the indices of bodies that move in the null space of constraints (m, 3 n)."""
    _, values, directions = np.linalg.svd(matrix)
    null = directions[int((values > INDEPENDENT * values[0]).sum()) :]
    moved = np.abs(null).max(axis=0, initial=0.0).reshape(-1, 3).max(axis=1)
    return [int(index) for index in np.flatnonzero(moved > INDEPENDENT)]
