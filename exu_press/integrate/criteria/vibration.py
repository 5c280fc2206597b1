"""Vibrations that are too small to be followed."""

import math

__all__ = ["Quiet"]

LATE = 0.99
"""Part of the largest recent value that is left of it after a step."""


class Quiet:
    """Velocity amplitude of a vibration of which each step misses the same, m/s.

    All errors that steps make of a vibration add up to no more than the vibration itself. One whose
    amplitude is below the tolerance need not be followed, however long it lasts; if what a step may
    have shrank with the step there, steps would shrink until they resolve it, a thousandfold.

    A vibration of the amplitude V and the angular frequency omega has accelerations of the rate
    j = omega^2 V, and these the second derivative b = omega^3 V. So omega is b / j, or 2 / h where
    the step h is too long to tell. Both are the largest of late, as each is zero at times. A slow
    motion beside it makes j larger, and V is overestimated then. A jump of the accelerations is no
    vibration: it would be a tiny one of the frequency of a step, and what vibrates beside it would
    be taken for as quiet.
    """

    def __init__(self) -> None:
        """Know nothing yet."""
        self._before = 0.0  # step, s
        self._rate = self._bend = 0.0
        self._tried = 0.0, 0.0, 0.0  # step, rate and bend
        self._spoilt = 0  # number of steps to come that have a jump in them

    def amplitude(self, rate: float, change: float, step: float) -> float:
        """Return it, or infinity where it is not known yet.

        Args:
            rate: of the accelerations within a step, kinetic norm, m/s^3.
            change: of this rate from the step before, likewise.
            step: s.
        """
        if self._spoilt:
            self._tried = step, 0.0, 0.0
            return math.inf
        centred = 0.5 * (step + (self._before or step))  # between the middles of two steps
        jerk = max(rate, LATE * self._rate)
        bend = max(change / centred, LATE * self._bend)
        self._tried = step, jerk, bend
        square = bend * bend
        if square == 0.0:
            return math.inf
        shortest = 0.5 * step  # 1 / omega
        return max(jerk * jerk * jerk / square, bend * shortest * shortest * shortest)

    def accept(self) -> None:
        """Remember the step last tried."""
        self._before, self._rate, self._bend = self._tried
        self._spoilt = max(self._spoilt - 1, 0)

    def forget(self) -> None:
        """Be told that accelerations have jumped in the accepted step, or will do so behind it.

        Exudyn lets a step end where a contact begins: the next one has the jump, and the change of
        the rate behind that as well.
        """
        self._spoilt = 2
