"""The constraints that hold a mechanism's bodies: as many as are independent, no more.

Guides and joints of a planar mechanism often hold the same thing twice: two balls of a guided
slider in guided plungers hold it upright and sideways once more. A multibody system with redundant
constraints is singular, and how they share the load is undetermined; so what is redundant is found
by the rank of their Jacobian and left out. First come the pivots of the frame, then what guides
hold across their direction, then the joints, then the guides' hold of the angle, and last what
joints of two bodies in parallel guides hold across these: so a slider is held upright by two balls
that share its load, and nothing but guides bears side forces.

Some mechanisms need at one crank angle what is redundant at all others: of two coupling rods a
quarter turn apart, one turns the follower while the other is in its dead centre. There everything
is held, and the solver bears with redundant constraints.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Guide, Joint, Point
from exu_press.mechanism.planar_constraints import INDEPENDENT
from exu_press.numerics.arrays import Array

__all__ = ["Holding", "SingleAxis", "by_constraints", "holding_of"]

SOMEWHERE = (1.0, 2.3)
"""Crank angles that are none of those in which mechanisms are drawn, rad."""

ALL_ROUND = tuple(SOMEWHERE[0] + 2.0 * math.pi * n / 24 for n in range(24))
"""The same all around, at distances shorter than that of two dead centres."""


@dataclass(frozen=True)
class SingleAxis:
    """A joint that holds its two bodies together in one direction alone.

    Attributes:
        body: in whose frame the direction is fixed.
        angle: of the direction in that frame, rad.
    """

    body: str
    angle: float


@dataclass(frozen=True)
class Holding:
    """The bodies and the constraints that hold them.

    Attributes:
        pivoted: bodies on an ideal pivot of the frame -> that joint.
        sliding: names of bodies whose ideal guide, along x or y, leaves them nothing but a
            displacement along it.
        joints: names of the other ideal joints that hold both directions.
        single_axis: names of those that hold one.
        guides: bodies that are not sliding -> whether their guide holds them across, and the angle.
        redundant: names of joints and guides of which something is left out.
        twice: whether nothing is left out although some of it is redundant at most crank angles.
    """

    pivoted: Mapping[str, Joint]
    sliding: frozenset[str]
    joints: tuple[str, ...]
    single_axis: Mapping[str, SingleAxis]
    guides: Mapping[str, tuple[bool, bool]]
    redundant: tuple[str, ...]
    twice: bool = False


@lru_cache(maxsize=64)
def holding_of(mechanism: Mechanism, ideal: frozenset[str]) -> Holding:
    """Return the constraints on a mechanism's bodies, apart from clearance joints and springs.

    Args:
        mechanism: its guides are ideal or elastic.
        ideal: names of the joints without clearance.

    Raises:
        InputError: half of a joint is redundant, in a direction that neither of its bodies keeps.
    """
    first, second = (_Selection(mechanism, ideal, angle) for angle in SOMEWHERE)
    pivoted = _pivoted(mechanism, ideal)
    pivots = {joint.name for joint in pivoted.values()}
    others = [j for j in mechanism.joints if j.name in ideal and j.name not in pivots]
    guides = {
        guide.body: (first.held[guide.body, "across"], first.held[guide.body, "angle"])
        for guide in mechanism.guides
    }
    sliding = frozenset(
        guide.body
        for guide in mechanism.guides
        if all(guides[guide.body]) and 0.0 in guide.direction
    )
    found = Holding(
        pivoted=pivoted,
        sliding=sliding,
        joints=tuple(joint.name for joint in others if len(first.directions[joint.name]) == 2),
        single_axis={
            joint.name: _single_axis(joint, first, second)
            for joint in others
            if len(first.directions[joint.name]) == 1
        },
        guides={body: held for body, held in guides.items() if body not in sliding},
        redundant=first.redundant,
    )
    if not first.lost or _hold_everywhere(mechanism, ideal, found, guides):
        return found
    return replace(
        found,
        joints=(*found.joints, *first.lost),
        single_axis={n: half for n, half in found.single_axis.items() if n not in first.lost},
        twice=True,
    )


def by_constraints(holding: Holding, bodies: frozenset[str]) -> Holding:
    """Return the same where some bodies have all their coordinates, held by constraints."""
    pivoted = {body: joint for body, joint in holding.pivoted.items() if body not in bodies}
    pivots = [joint.name for body, joint in holding.pivoted.items() if body in bodies]
    guided = dict.fromkeys(holding.sliding & bodies, (True, True))
    return replace(
        holding,
        pivoted=pivoted,
        sliding=holding.sliding - bodies,
        joints=(*holding.joints, *pivots),
        guides={**holding.guides, **guided},
    )


class _Selection:
    """The independent constraints at one crank angle.

    Attributes:
        angles: of the bodies there, rad.
        directions: name of an ideal joint -> unit vectors that it holds, none to two.
        held: (body, "across" or "angle") -> whether its guide holds it.
        redundant: names of joints that hold less than they could.
        lost: names of joints that do so although no parallel guides hold their bodies.
    """

    def __init__(self, mechanism: Mechanism, ideal: frozenset[str], crank_angle: float) -> None:
        """Go through the constraints, those to be kept first."""
        motion = mechanism.motion(np.array([crank_angle]), 1.0)
        self._mechanism, constraints = mechanism, mechanism.constraints
        self.angles = {n: float(one.position[0, 2]) for n, one in motion.items()} | {GROUND: 0.0}
        jacobian = constraints.jacobian(constraints.coordinates(motion)[0])
        self._rows = {name: jacobian[rows] for name, rows in constraints.rows.items()}
        self._rows["drive"] = constraints.angle(mechanism.crank)[None]
        self._basis = np.zeros((0, jacobian.shape[1]))
        self.directions: dict[str, list[Array]] = {}
        self.held: dict[tuple[str, str], bool] = {}
        redundant: dict[str, None] = {}
        guides = {guide.body: guide for guide in mechanism.guides if guide.holds_across}
        joints = [joint for joint in mechanism.joints if joint.name in ideal]
        pivots = list(_pivoted(mechanism, ideal).values())
        parallel = {joint.name: _parallel(joint, guides) for joint in joints}
        self._take(self._rows["drive"])
        for joint in pivots:
            self.directions[joint.name] = self._take_joint(joint, np.eye(2))
        for guide in mechanism.guides:
            across = self._rows[f"guides.{guide.body}"][:1]
            self.held[guide.body, "across"] = guide.holds_across and bool(self._take(across))
        for joint in joints:
            if joint not in pivots:
                along = parallel[joint.name]
                wanted = np.eye(2) if along is None else np.array([along])
                self.directions[joint.name] = self._take_joint(joint, wanted)
        self.lost = tuple(
            joint.name
            for joint in joints
            if parallel[joint.name] is None and len(self.directions[joint.name]) < 2
        )
        for guide in mechanism.guides:
            angle = self._rows[f"guides.{guide.body}"][1:]
            self.held[guide.body, "angle"] = guide.holds_angle and bool(self._take(angle))
            both = self.held[guide.body, "across"] and self.held[guide.body, "angle"]
            if guide.holds_angle and not both:
                redundant[guide.body] = None
        for joint in joints:
            along = parallel[joint.name]
            if along is not None:
                across = np.array([[along[1], -along[0]]])
                self.directions[joint.name] += self._take_joint(joint, across)
            if len(self.directions[joint.name]) < 2:
                redundant[joint.name] = None
        self.redundant = tuple(redundant)

    def _take(self, rows: Array) -> list[Array]:
        """Add the independent part of rows (m, n) to the basis; return its combinations (m,)."""
        rows = rows / np.linalg.norm(rows, axis=1).max()  # keeps the angle between two directions
        rest = rows - (rows @ self._basis.T) @ self._basis
        rest = rest - (rest @ self._basis.T) @ self._basis  # once more, for rounding
        combinations, sizes, new = np.linalg.svd(rest, full_matrices=False)
        count = int((sizes > INDEPENDENT).sum())
        self._basis = np.vstack([self._basis, new[:count]])
        return [combinations[:, index] for index in range(count)]

    def _take_joint(self, joint: Joint, wanted: Array) -> list[Array]:
        """Let a joint hold some of the wanted directions (m, 2); return which."""
        rows = self._rows[f"joints.{joint.name}"]
        return [np.asarray(mix @ wanted) for mix in self._take(wanted @ rows)]

    def sign(self, holding: Holding, guides: Mapping[str, tuple[bool, bool]]) -> float:
        """Return the sign of the determinant of drive and constraints that a holding keeps."""
        rows = [*self._rows["drive"]]
        for joint in self._mechanism.joints:
            both = self._rows[f"joints.{joint.name}"]
            half = holding.single_axis.get(joint.name)
            if half is not None:
                angle = half.angle + self.angles[half.body]
                rows.append(np.array([math.cos(angle), math.sin(angle)]) @ both)
            elif joint.name in holding.joints or joint in holding.pivoted.values():
                rows += [*both]
        for guide in self._mechanism.guides:
            held = np.array(guides[guide.body])
            rows += [*self._rows[f"guides.{guide.body}"][held]]
        matrix = np.array(rows)
        return float(np.linalg.slogdet(matrix)[0]) if len(rows) == matrix.shape[1] else 0.0


def _hold_everywhere(
    mechanism: Mechanism,
    ideal: frozenset[str],
    holding: Holding,
    guides: Mapping[str, tuple[bool, bool]],
) -> bool:
    """Return whether constraints that hold all at one crank angle do so at every other.

    Their determinant has one sign then, and changes it where they do not.
    """
    signs = {_Selection(mechanism, ideal, angle).sign(holding, guides) for angle in ALL_ROUND}
    return len(signs) == 1


def _pivoted(mechanism: Mechanism, ideal: frozenset[str]) -> dict[str, Joint]:
    """Return the bodies on an ideal pivot of the frame, each with it."""
    found: dict[str, Joint] = {}
    for joint in mechanism.joints:
        if joint.name in ideal and joint.on_frame:
            body = joint.bearing if joint.journal == GROUND else joint.journal
            found.setdefault(body, joint)
    return found


def _parallel(joint: Joint, guides: Mapping[str, Guide]) -> Point | None:
    """Return the direction of two parallel guides whose bodies a joint joins, if it does."""
    if joint.journal not in guides or joint.bearing not in guides:
        return None
    one, other = guides[joint.journal].direction, guides[joint.bearing].direction
    across = one[0] * other[1] - one[1] * other[0]
    return one if abs(across) < INDEPENDENT else None


def _single_axis(joint: Joint, first: _Selection, second: _Selection) -> SingleAxis:
    """Return the direction that a joint holds, in the frame of a body that keeps it."""
    best: tuple[float, SingleAxis] | None = None
    for body in (joint.bearing, joint.journal):
        angles = []
        for found in (first, second):
            direction = found.directions[joint.name]
            if len(direction) != 1:
                break
            x, y = direction[0]
            angles.append(math.atan2(y, x) - found.angles[body])
        else:
            apart = abs(math.remainder(angles[1] - angles[0], math.pi))  # either sense
            if best is None or apart < best[0]:
                best = apart, SingleAxis(body, angles[0])
    if best is None or best[0] > INDEPENDENT:
        raise InputError(
            f"joints.{joint.name}: one of its constraints is redundant, in a direction that turns "
            f"with neither {joint.journal} nor {joint.bearing}; give it clearance"
        )
    return best[1]
