"""Whether a crank turns through a revolution, as constraints, ends of slots and springs allow."""

import math
from collections.abc import Iterator

import numpy as np

from exu_press.mechanism.guide_motion import motion_in_guide
from exu_press.mechanism.kinematics import MotionError
from exu_press.mechanism.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND
from exu_press.mechanism.spring_motion import spring_motion

__all__ = ["require_turning"]

REVOLUTION = np.radians(np.arange(360.0))
"""Crank angles from the drawing's, rad, at which pins are looked for at the ends of slots."""

REFINEMENTS = 4
"""Newton's iterations from half a degree to the crank angle of an extreme length."""

Refusal = tuple[str, tuple[str, ...], float]
"""Why the crank does not turn, names of bodies, and the crank angle from the drawing's, rad."""


def require_turning(mechanism: Mechanism) -> None:
    """Raise MotionError unless the crank turns through a whole revolution.

    Its pins reach no end of a slot, and springs have a length, and gas a volume, at every angle.
    """
    mechanism.motion(np.zeros(1), 1.0)
    for text, bodies, angle in (*_slot_ends(mechanism), *_impossible_springs(mechanism)):
        poses = {n: m.position[0] for n, m in mechanism.motion(np.array([angle]), 1.0).items()}
        raise MotionError(f"{mechanism.name}: {text}", bodies, angle, poses)


def _slot_ends(mechanism: Mechanism) -> Iterator[Refusal]:
    """Yield the slots of which a pin reaches an end."""
    for guide in mechanism.guides:
        if guide.at is None or guide.length is None:
            continue
        motions = mechanism.motion(REVOLUTION, 1.0)
        position = motion_in_guide(mechanism, guide, motions)[0][:, :2] - np.array(guide.at)
        along = position @ np.array(guide.direction)
        beside = np.abs(along - guide.middle_along)
        beyond = np.flatnonzero(beside > (0.5 + 1e-9) * guide.length)
        if len(beyond):
            angle = float(REVOLUTION[beyond[0]])
            about_middle, of_way = map(_rounded_up, (2.0 * beside.max(), np.ptp(along)))
            shorter = f" about its `middle`, or {of_way} m about that of the pin's way,"
            yield (
                f"the pin of {guide.body} reaches an end of {guide.key} at crank angle "
                f"{math.degrees(angle):.4g} deg; it needs a length of {about_middle} m"
                f"{shorter if of_way != about_middle else ''} and has {guide.length:g} m",
                (guide.body,),
                angle,
            )


def _rounded_up(length: float) -> str:
    """Return a length of four digits that suffices, m."""
    unit = 10.0 ** (math.floor(math.log10(length)) - 3)
    return f"{unit * math.ceil(length / unit - 1e-6):.4g}"


def _impossible_springs(mechanism: Mechanism) -> Iterator[Refusal]:
    """Yield the springs that cannot have an extreme length of a revolution."""
    for spring in mechanism.springs:
        angles = np.linspace(0.0, 2.0 * np.pi, 721)
        lengths = spring_motion(mechanism, spring, mechanism.motion(angles, 1.0)).length
        for extreme in (lengths.argmin(), lengths.argmax()):
            angle = float(angles[extreme])
            for _ in range(REFINEMENTS):
                motion = spring_motion(mechanism, spring, mechanism.motion(np.array([angle]), 1.0))
                slope = float((motion.position * motion.velocity).sum())
                curvature = (motion.velocity**2 + motion.position * motion.acceleration).sum()
                if abs(slope) < np.radians(0.5) * abs(curvature):
                    angle -= slope / curvature
            length = float(motion.length[0])
            length = length if length > 1e-9 * mechanism.size else 0.0
            if reason := spring.why_impossible(length):
                where = f"at crank angle {math.degrees(angle % (2.0 * np.pi)):.4g} deg"
                bodies = tuple(body for body in spring.between if body != GROUND)
                yield f"{where} springs.{spring.name} {reason}", bodies, angle % (2.0 * np.pi)
