"""When a joint's surfaces touch next, so that a step may end there; compiled like the joints.

A step that leaps into a contact is repeated, and so are shorter ones, until one of them ends about
where the surfaces touch: five tries of ten iterations each. Until then the journal flies freely,
and where it arrives can be told.
"""

import math

from exu_press.integrate.joint_error import JointError
from exu_press.integrate.tuning import Tuning
from exu_press.joints.joint import ClearanceJoint

__all__ = ["Touch"]

ITERATIONS = 5
"""To the instant of the touch; a Newton-like iteration that gains two digits each time."""


class Touch:
    """Foresees when a joint's surfaces touch, from its motion at the end of an accepted step."""

    def __init__(self, joint: ClearanceJoint, motion: JointError, tuning: Tuning) -> None:
        """Take a joint whose surfaces may touch.

        Args:
            joint: has the clearance and the reach.
            motion: remembers eccentricity, relative velocity and acceleration.
            tuning: numbers.
        """
        self._motion = motion
        self._reach = joint.reach
        self._depth = tuning.touch_depth * joint.clearance
        self._begins = joint.reach - tuning.touch_begun * self._depth
        self._stop = joint.reach - tuning.touch_reserve * self._depth
        self._shortest, self._far = tuning.shortest_touch, tuning.touch_from_afar

    def first_step(self) -> float:
        """Return the longest step (s) for a contact that is just beginning; infinite elsewhere."""
        distance, closing = self._after(0.0)
        if closing > 0.0 and self._begins <= distance < self._reach + self._depth:
            return max(self._depth / closing, self._shortest)
        return math.inf

    def until(self, step: float) -> float:
        """Return when within a step (s) the surfaces touch; the step itself if they do not.

        Half of that if it is far off, and never less than the shortest step for a touch.
        """
        if not self._motion.acceleration or self._after(0.0)[0] >= self._begins:
            return step
        when = step
        for _ in range(ITERATIONS):
            when = self._arrival(when)
            if when >= step:
                return step
        far_off = self._after(when)[1] * when > self._far * self._depth
        return min(step, max(0.5 * when if far_off else when, self._shortest))

    def _arrival(self, guess: float) -> float:
        """Return when a step is to end before the touch, at the mean rate until a guess (s)."""
        place, acceleration = self._motion.place, self._motion.acceleration
        along = square = excess = 0.0
        for i, rate in enumerate(self._motion.velocity):
            mean = rate + 0.5 * guess * acceleration[i]
            along += place[i] * mean
            square += mean * mean
            excess += place[i] * place[i]
        excess -= self._stop * self._stop  # below zero: the journal is inside
        if square == 0.0:
            return math.inf
        root = math.sqrt(along * along - square * excess)
        return (root - along) / square

    def _after(self, time: float) -> tuple[float, float]:
        """Return the eccentricity's length (m) and its rate (m/s) after a time (s)."""
        place, velocity, acceleration = (
            self._motion.place,
            self._motion.velocity,
            self._motion.acceleration,
        )
        square = along = 0.0
        for i in range(len(place)):
            change = time * acceleration[i] if acceleration else 0.0
            there = place[i] + time * velocity[i] + 0.5 * time * change
            square += there * there
            along += there * (velocity[i] + change)
        distance = math.sqrt(square)
        return distance, along / distance if distance > 0.0 else 0.0
