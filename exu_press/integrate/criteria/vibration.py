"""Vibrations: those too small to be followed, and errors over a whole cycle."""

import math

__all__ = ["Envelope", "Quiet"]

LATE = 0.99
"""Least part of the largest recent value that is left of it after a step."""

FADING = 0.05
"""Part of it that is gone after a radian of the vibration: both values are zero at times, and in
steps of a hundredth of a radian most of it would be forgotten before they return."""

WINDOW = 1.5
"""Angle of a vibration after which an error is forgotten, in one window more, rad: the largest
errors come every half turn."""


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
        late = max(LATE, 1.0 - FADING * self.turned(step))
        centred = 0.5 * (step + (self._before or step))  # between the middles of two steps
        jerk = max(rate, late * self._rate)
        bend = max(change / centred, late * self._bend)
        self._tried = step, jerk, bend
        square = bend * bend
        if square == 0.0:
            return math.inf
        shortest = 0.5 * step  # 1 / omega
        return max(jerk * jerk * jerk / square, bend * shortest * shortest * shortest)

    def turned(self, step: float) -> float:
        """Return the angle by which the vibration goes on in a step (s), rad; at most one."""
        turned = step * self._bend
        return turned / self._rate if turned < self._rate else 1.0

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


class Envelope:
    """Lets the error of a step be no smaller than those of the last part of a cycle.

    The estimated error of velocities is zero twice in a cycle. There it is that of positions which
    is largest, and each step makes the same of the phase, h^3 omega^3 / 12, wherever it lies. Steps
    that grew there fourfold made five times the phase error of as many equal ones, and each change
    of a step costs several.
    """

    def __init__(self) -> None:
        """Know nothing yet."""
        # largest errors over the step's cube, in this window and the one before it, m/s^4
        self._here = self._before = 0.0
        self._turned = 0.0  # in this window so far, rad
        self._tried = 0.0, 0.0  # error over the step's cube, and angle

    def over(self, error: float, allowed: float, turned: float, quiet: float) -> float:
        """Return the error of a step, or of those before it, which repeats no step.

        Args:
            error: of the step, 1 is allowed.
            allowed: error over the step's cube, m/s^4.
            turned: angle by which the vibration goes on in the step, rad, at most one.
            quiet: amplitude over what the run may miss (`Quiet`); below 1 less is remembered.
        """
        self._tried = error * allowed, turned
        before = min(1.0, quiet) * max(self._here, self._before) / allowed
        return max(error, min(1.0, before))

    def accept(self) -> None:
        """Remember the step last tried."""
        error, turned = self._tried
        self._tried = 0.0, 0.0
        self._here = max(self._here, error)
        self._turned += turned
        if self._turned > WINDOW:
            self._before, self._here, self._turned = self._here, 0.0, 0.0
