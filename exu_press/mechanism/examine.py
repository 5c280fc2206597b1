"""Examination of a drawing before anything runs: its degrees of freedom, and its faults.

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

from exu_press.mechanism.kinematics import MotionError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.planar_constraints import null_space
from exu_press.mechanism.stroke import Stroke, stroke_of
from exu_press.mechanism.transmission import transmission_angles
from exu_press.mechanism.turning import require_turning
from exu_press.numerics.arrays import Array

__all__ = ["Examination", "Mobility", "examine", "explain_motion_error", "mobility_of"]

ANGLES = np.radians(np.arange(361.0))


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


@dataclass(frozen=True)
class Examination:
    """A mechanism with the properties that follow from its drawing.

    Attributes:
        mechanism: drawn.
        mobility: in the drawing.
        error: why the crank does not turn through a revolution; None where it does.
        stroke: of the output over whole degrees; None where the crank does not turn.
        transmission: name of a joint -> the transmission angle there, (361,), rad.
    """

    mechanism: Mechanism
    mobility: Mobility
    error: MotionError | None
    stroke: Stroke | None
    transmission: Mapping[str, Array]

    @property
    def wrong_bodies(self) -> tuple[str, ...]:
        """Names of the bodies that lock, branch or are not held."""
        if self.error is None:
            return ()
        return tuple(dict.fromkeys([*self.error.bodies, *self.mobility.loose_bodies]))

    @property
    def wrong_joints(self) -> tuple[str, ...]:
        """Names of joints of which one is too many, or else those between the wrong bodies."""
        if self.error is None:
            return ()
        wrong = self.wrong_bodies
        return self._overconstraining("joints") or tuple(
            j.name for j in self.mechanism.joints if j.journal in wrong and j.bearing in wrong
        )

    @property
    def wrong_guides(self) -> tuple[str, ...]:
        """Names of the guides that are one constraint too many."""
        return self._overconstraining("guides")

    @property
    def faults(self) -> tuple[str, ...]:
        """Faults, a sentence each; none where the crank turns through a revolution."""
        if self.error is None:
            return ()
        mobility, faults = self.mobility, [str(self.error)]
        if mobility.loose_bodies:
            excess = mobility.degrees_of_freedom - mobility.crank_turns
            holding = {name: None for body in mobility.loose_bodies for name in self._holding(body)}
            faults.append(
                f"{_degrees(excess)} too many: with the crank held, "
                f"{', '.join(mobility.loose_bodies)} can still move, held by "
                f"{', '.join(holding)} alone"
            )
        if not mobility.crank_turns:
            cure = f"; it could without one of {', '.join(mobility.overconstraining)}"
            faults.append(
                f"{_degrees(max(1, 1 - mobility.gruebler_count))} too few: the crank cannot turn "
                f"in the drawing{cure if mobility.overconstraining else ''}"
            )
        return tuple(faults)

    def _overconstraining(self, kind: str) -> tuple[str, ...]:
        """Return names of "joints" or "guides" without one of which the crank could turn."""
        names = (name.split(".") for name in self.mobility.overconstraining)
        return tuple(name for of_kind, name in names if of_kind == kind)

    def _holding(self, body: str) -> list[str]:
        """Return the names of the joints, guides and gears of a body."""
        joints = [f"joints.{joint.name}" for joint in self.mechanism.joints_of(body)]
        joints += [g.key for g in self.mechanism.guides if body in g.bodies]
        gears = self.mechanism.gears
        return joints + [f"gears.{g.name}" for g in gears if body in (g.body, g.to)]


def examine(mechanism: Mechanism) -> Examination:
    """Examine a drawing; one whose crank does not turn is examined as far as possible."""
    mobility = mobility_of(mechanism)
    try:
        require_turning(mechanism)
        stroke = stroke_of(mechanism, ANGLES)
        transmission = transmission_angles(mechanism, ANGLES)
    except MotionError as error:
        return Examination(mechanism, mobility, error, None, {})
    return Examination(mechanism, mobility, None, stroke, transmission)


def explain_motion_error(mechanism: Mechanism, error: MotionError) -> MotionError:
    """Return an error with the degrees of freedom too many or too few, and joints to look at."""
    text = ". ".join(examine(mechanism).faults)
    return MotionError(text, error.bodies, error.angle, error.poses)


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


def _degrees(count: int) -> str:
    return f"{count} degree{'s' if count != 1 else ''} of freedom"
