"""Assur groups: the smallest sets of bodies that the bodies of earlier groups determine.

They name the bodies that lock, and the dyads that have a transmission angle.

References
----------
.. [1] L. V. Assur, Investigation of plane mechanisms with lower pairs, St. Petersburg 1914.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from exu_press.mechanism.parts import GROUND
from exu_press.mechanism.planar_constraints import PlanarConstraints, null_space
from exu_press.numerics.arrays import Array

__all__ = ["Group", "groups_of"]

LARGEST = 4
"""Bodies of a group; where no set so small is determined, all remaining bodies are one group."""


@dataclass(frozen=True)
class Group:
    """Bodies whose positions follow together from those of earlier groups.

    Attributes:
        bodies: names.
        predecessors: names of the bodies of earlier groups, the crank and the frame.
        rows: of the constraints' Jacobian, that hold them.
        columns: of their coordinates.
    """

    bodies: tuple[str, ...]
    predecessors: frozenset[str]
    rows: tuple[int, ...]
    columns: tuple[int, ...]

    def block(self, jacobian: Array) -> Array:
        """Return the group's block of the constraints' Jacobian."""
        return np.asarray(jacobian[np.ix_(self.rows, self.columns)])

    def is_determined(self, jacobian: Array) -> bool:
        """Return whether the constraints with this Jacobian determine the group."""
        return len(self.rows) >= len(self.columns) and not len(null_space(self.block(jacobian)))


def groups_of(constraints: PlanarConstraints, crank: str) -> Iterator[Group]:
    """Yield a mechanism's groups, each after those that it depends on."""
    names = (*constraints.bodies, GROUND)
    ends = {name: {names[c.body], names[c.base]} for name, c in constraints.constraints}
    jacobian = constraints.jacobian(np.array(constraints.drawn))

    def group_of(bodies: tuple[str, ...]) -> Group:
        known = {*bodies, *determined}
        holding = [n for n, joined in ends.items() if joined & {*bodies} and joined <= known]
        rows = [int(row) for name in holding for row in constraints.rows[name]]
        columns = [3 * constraints.bodies.index(body) + k for body in bodies for k in range(3)]
        return Group(bodies, frozenset(determined), tuple(rows), tuple(columns))

    determined = {GROUND, crank}
    remaining = [body for body in constraints.bodies if body != crank]
    while remaining:
        sizes = range(1, min(LARGEST, len(remaining)) + 1)
        sets = (group_of(bodies) for size in sizes for bodies in combinations(remaining, size))
        group = next((g for g in sets if g.is_determined(jacobian)), group_of(tuple(remaining)))
        yield group
        determined |= {*group.bodies}
        remaining = [body for body in remaining if body not in group.bodies]
