"""Interpolation error of a film's force between two instants, while it turns."""

import math

from exu_press.integrate.task import Task
from exu_press.joints.joint import ClearanceJoint

__all__ = ["FilmForceError"]


class FilmForceError:
    """Deviation of a film's force F from the line between a step's ends, over its limit.

    A force that turns by an angle theta bulges by `|F| theta^2 / 8` beside this line. With that of
    both ends, `|F|^2 = |F_0| |F_1|`, and theta^2 / 2 as 1 - cos(theta)::

        (|F_0| |F_1| - F_0 . F_1) / (4 sqrt(|F_0| |F_1|))    over tol max |F|

    A film whose load is reversed passes it to its other side within microseconds. Its force turns
    by half a turn then, and no other criterion sees this peak. A force that comes back after a step
    does not pass to another side: stiff films ring with the method, however short the steps are.

    Attributes:
        joint: whose force it is.
    """

    def __init__(self, task: Task, joint: ClearanceJoint) -> None:
        """Follow the force of a lubricated joint."""
        self.joint, self._tolerance = joint, task.tolerance
        self._shortest, self._taken_back = task.shortest_first, task.tuning.taken_back
        self._start_force: tuple[float, ...] = ()
        self._now: tuple[float, ...] = ()
        self._change: tuple[float, ...] = ()  # in the step before
        self._most = 0.0  # so far, N

    def restart(self) -> None:
        """Begin with the next step."""
        self._start_force = self._change = ()

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends where the joint was last asked for its force."""
        self._now = now = self.joint.force
        if not self._start_force or step < self._shortest:
            return 0.0
        here = there = along = 0.0
        for i, force in enumerate(now):
            start = self._start_force[i]
            here += start * start
            there += force * force
            along += start * force
        product = math.sqrt(here) * math.sqrt(there)
        largest = max(self._most, math.sqrt(max(here, there)))
        if not product > 0.0:
            return 0.0
        if self._oscillates():
            return 0.0
        off = (product - along) / (4.0 * math.sqrt(product) * self._tolerance * largest)
        return math.pow(max(off, 0.0), 1.5)  # as the step's cube

    def _oscillates(self) -> bool:
        """Return whether the force takes back a good part of its last change."""
        back = last = 0.0
        for change, a, b in zip(self._change, self._start_force, self._now, strict=False):
            back -= change * (b - a)
            last += change * change
        return back > self._taken_back * last > 0.0

    def accept_step(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""
        if self._start_force:
            self._change = tuple(b - a for a, b in zip(self._start_force, self._now, strict=True))
        self._start_force = self._now
        self._most = max(self._most, math.hypot(*self._now))
