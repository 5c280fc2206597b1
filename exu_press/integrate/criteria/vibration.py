"""Vibrations that are too small to be followed."""

import math

from exu_press.integrate.scales import FoundScales

__all__ = ["Quiet"]

LATE = 0.99
"""Part of the largest recent value that is left of it after a step."""


class Quiet:
    """Velocity amplitude of a vibration of which each step misses the same, m/s.

    All errors that steps make of a vibration add up to no more than the vibration itself. One whose
    amplitude is below the tolerance need not be followed, however long it lasts; if what a step may
    have shrank with the step there, steps would shrink until they resolve it, a thousandfold.

    A vibration of the amplitude V and the angular frequency omega has the velocity's third
    derivative b = omega^3 V. Its change from step to step, over the step and over b, is omega, and
    2 / h where the step h is too long to tell. Both are the largest of late, as each is zero at
    times. A jump of the accelerations is no vibration: it would be a tiny one of the frequency of a
    step, and what vibrates beside it would be taken for as quiet.
    """

    def __init__(self, scales: FoundScales) -> None:
        """Take the scales of the motion."""
        self._scales = scales
        self._before: list[float] = []
        self._size = self._rate = 0.0
        self._tried: tuple[list[float], float, float] = [], 0.0, 0.0
        self._jumped = False  # in the last accepted step

    def amplitude(self, change: list[float], step: float) -> float:
        """Return it, or infinity where it is not known yet.

        Args:
            change: of the accelerations' rate within a step, in SI over seconds.
            step: s.
        """
        if self._jumped:  # the change has the jump in it too
            self._tried = [], 0.0, 0.0
            return math.inf
        bend = [value / step for value in change]
        size = max(self._scales.norm(bend), LATE * self._size)
        rate = 0.0
        if self._before:
            turn = [a - b for a, b in zip(bend, self._before, strict=True)]
            rate = max(self._scales.norm(turn) / step, LATE * self._rate)
        self._tried = bend, size, rate
        if rate <= 0.0:
            return math.inf
        omega = min(rate / size, 2.0 / step)
        return size / (omega * omega * omega)

    def accept(self) -> None:
        """Remember the step last tried."""
        self._before, self._size, self._rate = self._tried
        self._jumped = False

    def forget(self) -> None:
        """Be told that accelerations have jumped in the accepted step."""
        self._jumped = True
