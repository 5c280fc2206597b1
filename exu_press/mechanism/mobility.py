"""Degrees of freedom of a drawing: counted, and by the rank of its constraints' Jacobian.

The count of Chebyshev, Gruebler and Kutzbach takes every joint and guide for independent. The rank
of the Jacobian counts constraints of parallel links and doubled guides once [1]_.

References
----------
.. [1] E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, Allyn & Bacon 1989,
   chapter 3.
"""

from collections.abc import Collection, Mapping
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
        constraints: "joints", "guides" and the like -> their number, and how many degrees of
            freedom each of them holds.
        degrees_of_freedom: at first order.
        crank_turns: whether the crank can turn, at first order.
        loose_bodies: names of bodies that move although the crank is fixed.
        overconstraining: names of joints and guides, but the shaft, without any single one of which
            the crank could turn; none where it can turn.
    """

    bodies: int
    constraints: Mapping[str, tuple[int, int]]
    degrees_of_freedom: int
    crank_turns: bool
    loose_bodies: tuple[str, ...]
    overconstraining: tuple[str, ...]

    @property
    def gruebler_count(self) -> int:
        """Degrees of freedom if all constraints were independent."""
        return 3 * self.bodies - sum(n * held for n, held in self.constraints.values())

    @property
    def redundant(self) -> int:
        """Number of redundant constraints."""
        return self.degrees_of_freedom - self.gruebler_count

    @property
    def is_driven(self) -> bool:
        """Whether the crank turns and all other bodies follow it."""
        return self.crank_turns and not self.loose_bodies


def mobility_of(mechanism: Mechanism) -> Mobility:
    """Return a mechanism's mobility with ideal joints, guides and gears, as it is drawn."""
    constraints = mechanism.constraints
    jacobian = constraints.jacobian(np.array(constraints.drawn))
    fixed_crank = constraints.angle_row(mechanism.crank)[None]

    def free_motions(omitted: str, *further: Array) -> Array:
        rows = [rows for name, rows in constraints.rows.items() if name != omitted]
        return null_space(np.vstack([jacobian[np.concatenate(rows)], *further]))

    def turns_without(omitted: str) -> bool:
        return len(free_motions(omitted)) > len(free_motions(omitted, fixed_crank))

    crank_turns = turns_without("")
    suspects: Collection[str] = (
        () if crank_turns else constraints.rows.keys() - {f"joints.{mechanism.shaft.name}"}
    )
    return Mobility(
        bodies=len(mechanism.bodies),
        constraints=_counts({name: len(rows) for name, rows in constraints.rows.items()}),
        degrees_of_freedom=len(free_motions("")),
        crank_turns=crank_turns,
        loose_bodies=constraints.moving_bodies(free_motions("", fixed_crank)),
        overconstraining=tuple(n for n in constraints.rows if n in suspects and turns_without(n)),
    )


def _counts(held: Mapping[str, int]) -> dict[str, tuple[int, int]]:
    """Return numbers by kind from name -> degrees of freedom held, as of "joints.NAME"."""
    by_kind: dict[str, list[int]] = {}
    for name, count in held.items():
        by_kind.setdefault(name.partition(".")[0], []).append(count)
    return {kind: (len(counts), counts[0]) for kind, counts in by_kind.items()}
