"""Detection of a press that has stalled, and the message about it."""

import math

from exu_press.scene.motor import Motor
from exu_press.scene.solver import RPM

__all__ = ["Stall", "stall_of"]

SLOW = 0.01
"""Speed over that in operation, or without load, below which a running crank has stalled: under a
forming force, which fades with the ram's speed, it goes on creeping."""

PATIENCE = 0.1
"""Time, in revolutions at the nominal speed, for which a starting crank may fail to accelerate."""

FASTER = 1e-3
"""Gain of speed, over the speed of a stalled crank, that counts as acceleration."""


class Stall:
    """Distinguishes a press that stalls from one that starts.

    A running press stalls when its crank becomes slow. A starting one is slow, too, but
    accelerates: if it does not for some time, loads or friction hold it.

    >>> stall = Stall(speed=10.0, period=1.0)
    >>> [stall(time, speed, driven=True) for time, speed in ((0.0, 0.0), (0.05, 0.05), (0.1, 5.0))]
    [False, False, False]
    >>> stall(0.3, 0.05, driven=True)
    True
    """

    def __init__(self, speed: float, period: float) -> None:
        """Take the crank's speed in operation, rad/s, and the time of a revolution, s."""
        self._slow, self._patience = SLOW * speed, PATIENCE * period
        self._fastest, self._since = 0.0, -math.inf
        self._starts = True

    def __call__(self, time: float, speed: float, *, driven: bool) -> bool:
        """Return whether the press has stalled at a time, s, at a speed of its crank, rad/s."""
        if not driven or self._since == -math.inf:
            self._starts, self._fastest, self._since = True, speed, time
        if speed > self._slow:
            self._starts = False
        elif driven and not self._starts:
            return True
        elif speed > self._fastest + FASTER * self._slow:
            self._fastest, self._since = speed, time
        return driven and self._starts and time - self._since > self._patience

    @staticmethod
    def message(time: float, angle: float, needed: float, available: float, *, slips: bool) -> str:
        """Return the message about a press that has stalled at a time, s, and crank angle, rad.

        Loads, springs and weights need one torque, N m; the motor, or a clutch that slips, has the
        available one.
        """
        source, cure = "the motor", "a larger drive.inertia, or a motor of a larger torque"
        if slips:
            source, cure = "the clutch, which slips,", "a larger drive.clutch_torque"
        friction = available - needed
        rubs = f"; friction holds at least {friction:.4g} N m" if friction > 0.0 else ""
        degrees = math.degrees(angle) % 360.0
        return (
            f"the press stalled at t = {time:.6g} s, crank angle {degrees:.2f} deg: loads "
            f"and weights, without friction, want {needed:.4g} N m there, and {source} has "
            f"{available:.4g} N m{rubs}; try {cure}"
        )


def stall_of(motor: Motor, speed_rpm: float) -> Stall:
    """Return the detection of a press with a motor, of a nominal speed, that stalls."""
    return Stall(min(speed_rpm * RPM, motor.torque.fastest(speed_rpm)), 60.0 / speed_rpm)
