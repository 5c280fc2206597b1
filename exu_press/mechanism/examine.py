"""Examination of a drawing before anything runs, and its faults."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.mechanism.kinematics import MotionError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.mobility import Mobility, mobility_of
from exu_press.mechanism.stroke import Stroke, stroke_of
from exu_press.mechanism.transmission import transmission_angles
from exu_press.numerics.arrays import Array

__all__ = ["Examination", "complete_refusal", "examine"]

ANGLES = np.radians(np.arange(361.0))


@dataclass(frozen=True)
class Examination:
    """A mechanism with the properties that follow from its drawing.

    Attributes:
        mechanism: drawn.
        mobility: in the drawing.
        refusal: why the crank does not turn through a revolution; None where it does.
        stroke: of the output over whole degrees; None where the crank does not turn.
        transmission: name of a joint -> the transmission angle there, (361,), rad.
    """

    mechanism: Mechanism
    mobility: Mobility
    refusal: MotionError | None
    stroke: Stroke | None
    transmission: Mapping[str, Array]

    @property
    def wrong_bodies(self) -> tuple[str, ...]:
        """Names of the bodies that lock, branch or are not held."""
        if self.refusal is None:
            return ()
        return tuple(dict.fromkeys([*self.refusal.bodies, *self.mobility.loose]))

    @property
    def wrong_joints(self) -> tuple[str, ...]:
        """Names of joints of which one is too many, or else those between the wrong bodies."""
        if self.refusal is None:
            return ()
        found = [n.removeprefix("joints.") for n in self.mobility.too_many if n[:6] == "joints"]
        wrong = self.wrong_bodies
        return tuple(found) or tuple(
            j.name for j in self.mechanism.joints if j.journal in wrong and j.bearing in wrong
        )

    @property
    def wrong_guides(self) -> tuple[str, ...]:
        """Names of the bodies whose guide is one constraint too many."""
        return tuple(n.removeprefix("guides.") for n in self.mobility.too_many if n[:6] == "guides")

    @property
    def complaints(self) -> tuple[str, ...]:
        """Faults, a sentence each; none where the crank turns through a revolution."""
        if self.refusal is None:
            return ()
        return str(self.refusal), *self.misfits

    @property
    def misfits(self) -> tuple[str, ...]:
        """Degrees of freedom too many or too few, and which joints to look at, a sentence each."""
        mobility, found = self.mobility, []
        if mobility.loose:
            spare = mobility.degrees - mobility.turns
            near = {name: None for body in mobility.loose for name in self._holding(body)}
            found.append(
                f"{_degrees(spare)} too many: with the crank held, "
                f"{', '.join(mobility.loose)} can still move, held by {', '.join(near)} alone"
            )
        if not mobility.turns:
            cure = f"; it could without one of {', '.join(mobility.too_many)}"
            found.append(
                f"{_degrees(max(1, 1 - mobility.counted))} too few: the crank cannot turn in the "
                f"drawing{cure if mobility.too_many else ''}"
            )
        return tuple(found)

    def _holding(self, body: str) -> tuple[str, ...]:
        joints = [
            f"joints.{j.name}" for j in self.mechanism.joints if body in (j.journal, j.bearing)
        ]
        return (*joints, *(f"guides.{g.body}" for g in self.mechanism.guides if g.body == body))


def examine(mechanism: Mechanism) -> Examination:
    """Examine a drawing; one whose crank does not turn is examined as far as it goes."""
    mobility = mobility_of(mechanism)
    try:
        stroke = stroke_of(mechanism, ANGLES)
        transmission = transmission_angles(mechanism, ANGLES)
    except MotionError as refusal:
        return Examination(mechanism, mobility, refusal, None, {})
    return Examination(mechanism, mobility, None, stroke, transmission)


def complete_refusal(mechanism: Mechanism, refusal: MotionError) -> MotionError:
    """Return a refusal with the degrees of freedom too many or too few, and joints to look at."""
    text = ". ".join(examine(mechanism).complaints)
    return MotionError(text, refusal.bodies, refusal.angle, refusal.poses)


def _degrees(count: int) -> str:
    return f"{count} degree{'s' if count != 1 else ''} of freedom"
