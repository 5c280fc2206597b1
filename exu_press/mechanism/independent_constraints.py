"""Independent constraints of a mechanism's bodies: a selection of all, by the rank of the Jacobian.

Guides and joints of a planar mechanism are often redundant: two balls of a guided slider in guided
plungers constrain its angle and its lateral displacement once more. A multibody system with
redundant constraints is singular, and their forces are undetermined; so redundant ones are omitted.
They are selected in this order: pivots of the frame, guides along their normal, joints, gears,
angles of guides, and last joints of two bodies in parallel guides along the normal of these. So two
balls hold a slider upright and share its load, and guides alone bear side forces.

Where geared cranks carry a slide in an ideal guide, play and stiffness of gear and guide decide
what each crank bears, and no selection has a meaning. Such forces are named as undetermined: a left
null vector of the Jacobian is a set of constraint forces that balance each other.

Some mechanisms need at one crank angle a constraint that is redundant at all others: of two
coupling rods a quarter turn apart, one turns the follower while the other is in its dead centre.
There all constraints are kept, and the solver ignores the singular Jacobian.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Guide, Joint, Point
from exu_press.mechanism.planar_constraints import INDEPENDENT, null_space
from exu_press.numerics.arrays import Array

__all__ = [
    "IndependentConstraints",
    "SingleAxis",
    "independent_constraints",
    "with_all_coordinates",
]

SOMEWHERE = (1.0, 2.3)
"""Crank angles in which no mechanism is drawn, rad."""

ALL_ROUND = tuple(SOMEWHERE[0] + 2.0 * math.pi * n / 24 for n in range(24))
"""Crank angles of a revolution, rad, closer than two dead centres."""


@dataclass(frozen=True)
class SingleAxis:
    """The constraint of a joint in a single direction.

    Attributes:
        body: in whose frame the direction is fixed.
        angle: of the direction in that frame, rad.
    """

    body: str
    angle: float


@dataclass(frozen=True)
class IndependentConstraints:
    """Independent constraints of ideal joints and guides on the bodies of a mechanism.

    Attributes:
        pivots: name of a body on an ideal pivot of the frame -> that joint.
        sliding_bodies: names of bodies whose only coordinate is the displacement along their ideal
            guide, along x or y.
        joints: names of the other ideal joints that hold both directions.
        single_axis: name of an ideal joint that holds one direction -> that constraint.
        guides: name of a guide, but those of sliding bodies -> whether it holds its body along the
            normal, and its angle.
        redundant: names of joints and guides of which a constraint is omitted.
        gears: names of the gears that hold.
        undetermined: names, as "joints.NAME", of constraints that gears stress against each other.
        keeps_redundant: whether all constraints are kept, though some are redundant at most crank
            angles.
    """

    pivots: Mapping[str, Joint]
    sliding_bodies: frozenset[str]
    joints: tuple[str, ...]
    single_axis: Mapping[str, SingleAxis]
    guides: Mapping[str, tuple[bool, bool]]
    redundant: tuple[str, ...]
    gears: tuple[str, ...] = ()
    undetermined: frozenset[str] = frozenset()
    keeps_redundant: bool = False


@lru_cache(maxsize=64)
def independent_constraints(mechanism: Mechanism, ideal: frozenset[str]) -> IndependentConstraints:
    """Return the independent constraints of a mechanism's ideal joints and guides.

    Args:
        mechanism: its guides are ideal or elastic.
        ideal: names of the joints without clearance.

    Raises:
        InputError: one direction of a joint is redundant, and fixed in neither of its bodies.
    """
    first, second = (_Selection(mechanism, ideal, angle) for angle in SOMEWHERE)
    pivots = _pivots(mechanism, ideal)
    joints = [j for j in mechanism.joints if j.name in ideal and j not in pivots.values()]
    guides = {
        guide.name: (first.guided[guide.name, "normal"], first.guided[guide.name, "angle"])
        for guide in mechanism.guides
    }
    sliding = {
        guide.name: guide.body
        for guide in mechanism.guides
        if guide.is_rail and all(guides[guide.name]) and 0.0 in guide.direction
    }
    selected = IndependentConstraints(
        pivots=pivots,
        sliding_bodies=frozenset(sliding.values()),
        joints=tuple(joint.name for joint in joints if len(first.directions[joint.name]) == 2),
        single_axis={
            joint.name: _single_axis(joint, first, second)
            for joint in joints
            if len(first.directions[joint.name]) == 1
        },
        guides={name: held for name, held in guides.items() if name not in sliding},
        redundant=first.redundant,
        gears=first.gears,
        undetermined=first.stressed_by_gears() & second.stressed_by_gears(),
    )
    needed = first.redundant_unguided
    if not needed or _are_regular(mechanism, ideal, selected, guides):
        return selected
    return replace(
        selected,
        joints=(*selected.joints, *needed),
        single_axis={n: axis for n, axis in selected.single_axis.items() if n not in needed},
        keeps_redundant=True,
    )


def with_all_coordinates(
    constraints: IndependentConstraints, mechanism: Mechanism, bodies: frozenset[str]
) -> IndependentConstraints:
    """Return constraints where pivots and guides of some bodies are constraints of coordinates."""
    pivots = {body: joint for body, joint in constraints.pivots.items() if body not in bodies}
    joints = [joint.name for body, joint in constraints.pivots.items() if body in bodies]
    guides = {
        guide.name: (True, True)
        for guide in mechanism.guides
        if guide.body in constraints.sliding_bodies & bodies
        and guide.name not in constraints.guides
    }
    return replace(
        constraints,
        pivots=pivots,
        sliding_bodies=constraints.sliding_bodies - bodies,
        joints=(*constraints.joints, *joints),
        guides={**constraints.guides, **guides},
    )


class _Selection:
    """The independent constraints at one crank angle.

    Attributes:
        angles: of the bodies there, rad.
        directions: name of an ideal joint -> unit vectors that it constrains, none to two.
        guided: (name of a guide, "normal" or "angle") -> whether it constrains that.
        gears: names of gears that are not redundant.
        redundant: names of joints, guides and gears with a redundant constraint.
        redundant_unguided: names of such joints whose bodies no parallel guides hold.
    """

    def __init__(self, mechanism: Mechanism, ideal: frozenset[str], crank_angle: float) -> None:
        """Add the constraints one after the other, as far as they are independent."""
        motion = mechanism.motion(np.array([crank_angle]), 1.0)
        self._mechanism, constraints = mechanism, mechanism.constraints
        self.angles = {n: float(m.position[0, 2]) for n, m in motion.items()} | {GROUND: 0.0}
        jacobian = constraints.jacobian(constraints.coordinates(motion)[0])
        self._rows = {name: jacobian[rows] for name, rows in constraints.rows.items()}
        self._rows["drive"] = constraints.angle_row(mechanism.crank)[None]
        self._basis = np.zeros((0, jacobian.shape[1]))
        self.directions: dict[str, list[Array]] = {}
        self.guided: dict[tuple[str, str], bool] = {}
        redundant: dict[str, None] = {}
        guides = {g.body: g for g in mechanism.guides if g.is_rail and g.holds_across}
        joints = [joint for joint in mechanism.joints if joint.name in ideal]
        pivots = list(_pivots(mechanism, ideal).values())
        parallel = {joint.name: _common_direction(joint, guides) for joint in joints}
        self._add_independent(self._rows["drive"])
        for joint in pivots:
            self.directions[joint.name] = self._add_joint(joint, np.eye(2))
        for guide in mechanism.guides:
            normal = self._rows[guide.key][:1]
            is_held = guide.holds_across and bool(self._add_independent(normal))
            self.guided[guide.name, "normal"] = is_held
        for joint in joints:
            if joint not in pivots:
                along = parallel[joint.name]
                directions = np.eye(2) if along is None else np.array([along])
                self.directions[joint.name] = self._add_joint(joint, directions)
        self.redundant_unguided = tuple(
            joint.name
            for joint in joints
            if parallel[joint.name] is None and len(self.directions[joint.name]) < 2
        )
        self.gears = tuple(
            gear.name
            for gear in mechanism.gears
            if self._add_independent(self._rows[f"gears.{gear.name}"])
        )
        redundant |= dict.fromkeys(g.name for g in mechanism.gears if g.name not in self.gears)
        for guide in mechanism.guides:
            angle = self._rows[guide.key][1:]
            is_held = guide.holds_angle and bool(self._add_independent(angle))
            self.guided[guide.name, "angle"] = is_held
            is_across = self.guided[guide.name, "normal"]
            if (guide.holds_angle and not is_held) or (guide.holds_across and not is_across):
                redundant[guide.name] = None
        for joint in joints:
            along = parallel[joint.name]
            if along is not None:
                normal = np.array([[along[1], -along[0]]])
                self.directions[joint.name] += self._add_joint(joint, normal)
            if len(self.directions[joint.name]) < 2:
                redundant[joint.name] = None
        self.redundant = tuple(redundant)
        self._rigid = {f"joints.{joint.name}": [0, 1] for joint in joints}
        for guide in mechanism.guides:
            is_rigid = guide.holds_across, guide.holds_angle
            self._rigid[guide.key] = [*np.flatnonzero(is_rigid)]
        self._rigid |= {f"gears.{gear.name}": [0] for gear in mechanism.gears}

    def stressed_by_gears(self) -> frozenset[str]:
        """Return the names of rigid constraints that gears can stress without any load."""
        if not self._mechanism.gears:
            return frozenset()
        names = [name for name, rows in self._rigid.items() for _ in rows]
        rigid = np.vstack(
            [self._rows["drive"], *(self._rows[n][r] for n, r in self._rigid.items())]
        )
        stresses = null_space(rigid.T)[:, 1:]  # the drive's torque is that of the loads
        of_gears = [name.startswith("gears.") for name in names]
        _, sizes, mixes = np.linalg.svd(stresses[:, of_gears].T, full_matrices=False)
        stressed = np.abs(mixes[sizes > INDEPENDENT] @ stresses).max(axis=0, initial=0.0)
        return frozenset(n for n, size in zip(names, stressed, strict=True) if size > INDEPENDENT)

    def _add_independent(self, rows: Array) -> list[Array]:
        """Add the independent part of rows (m, n) to the basis; return its combinations (m,)."""
        rows = rows / np.linalg.norm(rows, axis=1).max()  # keeps the angle between two directions
        residual = rows - (rows @ self._basis.T) @ self._basis
        residual = residual - (residual @ self._basis.T) @ self._basis  # once more, for rounding
        combinations, sizes, new = np.linalg.svd(residual, full_matrices=False)
        count = int((sizes > INDEPENDENT).sum())
        self._basis = np.vstack([self._basis, new[:count]])
        return [combinations[:, index] for index in range(count)]

    def _add_joint(self, joint: Joint, directions: Array) -> list[Array]:
        """Add a joint's constraints in directions (m, 2); return the independent directions."""
        rows = directions @ self._rows[f"joints.{joint.name}"]
        return [np.asarray(mix @ directions) for mix in self._add_independent(rows)]

    def determinant_sign(
        self, constraints: IndependentConstraints, guides: Mapping[str, tuple[bool, bool]]
    ) -> float:
        """Return the sign of the determinant of the drive's and the constraints' Jacobian."""
        rows = [*self._rows["drive"]]
        for joint in self._mechanism.joints:
            both = self._rows[f"joints.{joint.name}"]
            axis = constraints.single_axis.get(joint.name)
            if axis is not None:
                angle = axis.angle + self.angles[axis.body]
                rows.append(np.array([math.cos(angle), math.sin(angle)]) @ both)
            elif joint.name in constraints.joints or joint in constraints.pivots.values():
                rows += [*both]
        for guide in self._mechanism.guides:
            is_held = np.flatnonzero(guides[guide.name])
            rows += [*self._rows[guide.key][is_held]]
        rows += [row for gear in constraints.gears for row in self._rows[f"gears.{gear}"]]
        matrix = np.array(rows)
        return float(np.linalg.slogdet(matrix)[0]) if len(rows) == matrix.shape[1] else 0.0


def _are_regular(
    mechanism: Mechanism,
    ideal: frozenset[str],
    constraints: IndependentConstraints,
    guides: Mapping[str, tuple[bool, bool]],
) -> bool:
    """Return whether the constraints are regular at every crank angle.

    The sign of their determinant changes at a singular position.
    """
    selections = (_Selection(mechanism, ideal, angle) for angle in ALL_ROUND)
    return len({s.determinant_sign(constraints, guides) for s in selections}) == 1


def _pivots(mechanism: Mechanism, ideal: frozenset[str]) -> dict[str, Joint]:
    """Return name of a body -> its ideal pivot of the frame, where it has one."""
    pivots: dict[str, Joint] = {}
    for joint in mechanism.joints:
        if joint.name in ideal and joint.on_frame:
            body = joint.bearing if joint.journal == GROUND else joint.journal
            pivots.setdefault(body, joint)
    return pivots


def _common_direction(joint: Joint, guides: Mapping[str, Guide]) -> Point | None:
    """Return the direction of two parallel guides that hold both bodies of a joint, or None."""
    if joint.journal not in guides or joint.bearing not in guides:
        return None
    a, b = guides[joint.journal].direction, guides[joint.bearing].direction
    return a if abs(a[0] * b[1] - a[1] * b[0]) < INDEPENDENT else None


def _single_axis(joint: Joint, first: _Selection, second: _Selection) -> SingleAxis:
    """Return a joint's single direction, in the frame of the body in which it is fixed."""
    best: tuple[float, SingleAxis] | None = None
    for body in (joint.bearing, joint.journal):
        angles = []
        for selection in (first, second):
            directions = selection.directions[joint.name]
            if len(directions) != 1:
                break
            x, y = directions[0]
            angles.append(math.atan2(y, x) - selection.angles[body])
        else:
            turn = abs(math.remainder(angles[1] - angles[0], math.pi))  # either sense
            if best is None or turn < best[0]:
                best = turn, SingleAxis(body, angles[0])
    if best is None or best[0] > INDEPENDENT:
        raise InputError(
            f"joints.{joint.name}: one of its constraints is redundant, in a direction that turns "
            f"with neither {joint.journal} nor {joint.bearing}; give it clearance"
        )
    return best[1]
