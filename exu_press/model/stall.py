"""The instant at which a press has stalled, and the reason."""

import math
from collections.abc import Mapping

import numpy as np

from exu_press.mechanism import Mechanism
from exu_press.scene import Scene
from exu_press.scene.applied import applied_loads

__all__ = ["Stall", "holding_torque", "stalled"]

SLOW = 0.01
"""Speed over that at the start, or without load: a crank that ran and is slower has stalled.
Pressed by a forming force, which fades with the ram's speed, it goes on creeping."""

PATIENCE = 0.1
"""Revolutions at the nominal speed for which a crank that is to start may get no faster."""

FASTER = 1e-3
"""Gain of speed, over that below which it is slow, by which a crank has got faster."""


class Stall:
    """Tells a press that stalls from one that starts.

    One that ran stalls when its crank is slow. One that starts is slow, too, but gets faster: where
    it does not for some time, its loads, or friction, hold it.

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
        """Return whether it has stalled.

        Args:
            time: s.
            speed: of the crank, rad/s.
            driven: whether something is to turn it.
        """
        if not driven or self._since == -math.inf:
            self._starts, self._fastest, self._since = True, speed, time
        if speed > self._slow:
            self._starts = False
        elif driven and not self._starts:
            return True
        elif speed > self._fastest + FASTER * self._slow:
            self._fastest, self._since = speed, time
        return driven and self._starts and time - self._since > self._patience


def stalled(time: float, angle: float, wanted: float, there: float, *, slips: bool) -> str:
    """Return in words that a press has stalled.

    Args:
        time: s.
        angle: of the crank, rad.
        wanted: torque that loads and weights want of the crank, N m.
        there: torque that turns it, N m.
        slips: whether that is the torque of a clutch that slips.
    """
    has = "the clutch, which slips," if slips else "the motor"
    cure = "a larger drive.inertia, or a motor of a larger torque"
    if slips:
        cure = "a larger drive.clutch_torque"
    rubs = f"; friction holds at least {there - wanted:.4g} N m" if there > wanted else ""
    place = f"t = {time:.6g} s, crank angle {math.degrees(angle) % 360.0:.2f} deg"
    return (
        f"the press stalled at {place}: loads and weights, without friction, want {wanted:.4g} N m "
        f"there, and {has} has {there:.4g} N m{rubs}; try {cure}"
    )


def holding_torque(
    mechanism: Mechanism, scene: Scene, forces: Mapping[str, float], angle: float
) -> float:
    """Return the crank's torque that holds loads and weights, N m, by virtual work.

    Args:
        mechanism: ideal, and without friction.
        scene: with the loads.
        forces: of the loads, as they were before the output came to rest, N.
        angle: of the crank, rad.
    """
    per_angle = mechanism.motion(np.array([angle]), 1.0)
    torque = 0.0
    for body in mechanism.bodies:
        torque += body.mass * scene.gravity * float(per_angle[body.name].velocity[0, 1])
    closes = float(mechanism.output_component(per_angle[mechanism.slider].velocity)[0]) < 0.0
    for name, load in applied_loads(scene).items():
        if load.fade is None or closes:
            moved = per_angle[load.body].point_motion(load.point).velocity[0, :2]
            torque -= forces[name] * float(moved @ np.array(load.direction))
    return torque
