"""Vibrations that are too small to be followed."""

import math
from dataclasses import dataclass, field

from exu_press.integrate.scales import FoundScales

__all__ = ["Quiet"]

LATE = 0.99
"""Part of the largest recent value that is left of it after a step."""


@dataclass
class Recent:
    """The velocity's third derivative in recent steps.

    Attributes:
        bend: itself, in the last step.
        mean: of the last two steps; empty before there are two.
        steps: the last two, s.
        span: between the last two bends, s.
        size: of the mean, its largest norm of late.
        rate: of the mean, likewise.
    """

    bend: list[float] = field(default_factory=list)
    mean: list[float] = field(default_factory=list)
    steps: tuple[float, float] = (0.0, 0.0)
    span: float = 0.0
    size: float = 0.0
    rate: float = 0.0


class Quiet:
    """Velocity amplitude of a vibration of which each step misses the same, m/s.

    All errors that steps make of a vibration add up to no more than the vibration itself. One whose
    amplitude is below the tolerance need not be followed, however long it lasts; if what a step may
    have shrank with the step there, steps would shrink until they resolve it, a thousandfold.

    A vibration of the amplitude V and the angular frequency omega has the velocity's third
    derivative b = omega^3 V. Its rate over b is omega. Both are the largest of late, as each is
    zero at times; both are divided differences, as a change of step would pass for a change of b.
    The mean of two steps counts: what alternates from step to step is the method's ringing, or a
    vibration that the step h is too long to tell, and has 2 / h. A jump of the accelerations is no
    vibration: it would be a tiny one of the frequency of a step, and what vibrates beside it would
    be taken for as quiet.
    """

    def __init__(self, scales: FoundScales) -> None:
        """Take the scales of the motion."""
        self._scales = scales
        self._last = self._tried = Recent()
        self._jumped = False  # in the last accepted step

    def amplitude(self, change: list[float], step: float) -> float:
        """Return it, or infinity where it is not known yet.

        Args:
            change: of the accelerations' rate within a step, in SI over seconds.
            step: s.
        """
        last, norm = self._last, self._scales.norm
        before, earlier = last.steps
        steps = step, before
        if self._jumped:  # the change has the jump in it too
            self._tried = Recent(steps=steps)
            return math.inf
        centred = 0.5 * (step + before) if before > 0.0 else step
        bend = [value / centred for value in change]
        self._tried = now = Recent(bend, steps=steps)
        if not last.bend:
            return math.inf
        now.span = 0.25 * (step + 2.0 * before + (earlier or before))
        now.mean = [0.5 * (a + b) for a, b in zip(bend, last.bend, strict=True)]
        now.size = max(norm(now.mean), LATE * last.size)
        if not last.mean:
            return math.inf
        turn = norm([a - b for a, b in zip(now.mean, last.mean, strict=True)])
        now.rate = max(turn / (0.5 * (now.span + last.span)), LATE * last.rate)
        quick = 0.5 * norm([a - b for a, b in zip(bend, last.bend, strict=True)])
        unseen = quick * (0.5 * step) ** 3
        if now.size == 0.0:
            return unseen
        omega = min(now.rate / now.size, 2.0 / step)
        return now.size / omega**3 + unseen if omega > 0.0 else math.inf

    def accept(self) -> None:
        """Remember the step last tried."""
        self._last = self._tried
        self._jumped = False

    def forget(self) -> None:
        """Be told that accelerations have jumped in the accepted step."""
        self._jumped = True
