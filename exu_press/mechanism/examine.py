"""Examination of a drawing before anything runs, and its faults."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.kinematics import MotionError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.mobility import Mobility, mobility_of
from exu_press.mechanism.stroke import Stroke, stroke_of
from exu_press.mechanism.transmission import transmission_angles
from exu_press.mechanism.turning import require_turning
from exu_press.numerics.arrays import Array

__all__ = ["Examination", "examine", "explain_motion_error"]

ANGLES = np.radians(np.arange(361.0))


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


def _degrees(count: int) -> str:
    return f"{count} degree{'s' if count != 1 else ''} of freedom"
