"""The smallest sets of bodies that are held together, each by the bodies before it: Assur groups.

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
"""Bodies; where no set so small is held, all that are left are one group."""


@dataclass(frozen=True)
class Group:
    """Bodies that are held together.

    Attributes:
        bodies: names.
        before: names of the bodies that are held without them.
        rows: of the constraints' Jacobian, that hold them.
        columns: of their coordinates.
    """

    bodies: tuple[str, ...]
    before: frozenset[str]
    rows: tuple[int, ...]
    columns: tuple[int, ...]

    def block(self, jacobian: Array) -> Array:
        """Return their part of the constraints' Jacobian."""
        return np.asarray(jacobian[np.ix_(self.rows, self.columns)])

    def is_held(self, jacobian: Array) -> bool:
        """Return whether they are held where the Jacobian is."""
        return len(self.rows) >= len(self.columns) and not len(null_space(self.block(jacobian)))


def groups_of(constraints: PlanarConstraints, crank: str) -> Iterator[Group]:
    """Yield a mechanism's groups, front to back."""
    names = (*constraints.bodies, GROUND)
    ends = {name: {names[c.body], names[c.base]} for name, c in constraints.constraints}
    jacobian = constraints.jacobian(np.array(constraints.drawn))

    def group_of(bodies: tuple[str, ...]) -> Group:
        known = {*bodies, *before}
        held_by = [name for name, of in ends.items() if of & {*bodies} and of <= known]
        rows = [int(row) for name in held_by for row in constraints.rows[name]]
        columns = [3 * constraints.bodies.index(body) + k for body in bodies for k in range(3)]
        return Group(bodies, frozenset(before), tuple(rows), tuple(columns))

    before, left = {GROUND, crank}, [body for body in constraints.bodies if body != crank]
    while left:
        sizes = range(1, min(LARGEST, len(left)) + 1)
        sets = (group_of(bodies) for size in sizes for bodies in combinations(left, size))
        group = next((g for g in sets if g.is_held(jacobian)), group_of(tuple(left)))
        yield group
        before |= {*group.bodies}
        left = [body for body in left if body not in group.bodies]
