"""Interpolation error of a force between two points, in the middle of a step."""

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from exu_press.integrate.task import Task
from exu_press.numerics.arrays import Array

__all__ = ["InterpolatedForceError"]


class InterpolatedForceError:
    """Deviation of a force from the line between its values at a step's ends, over its limit.

    With the vector r between the points and its rate v at the step's ends, that in its middle is::

        r_m = (r_0 + r_1) / 2 + h (v_0 - v_1) / 8,    v_m = 3 (r_1 - r_0) / (2 h) - (v_0 + v_1) / 4

    and the error is |F(r_m, v_m) - (F_0 + F_1) / 2| over tol max |F|. Constraints may bear the
    force, so that no velocity feels a peak that lies between two steps.
    """

    def __init__(
        self,
        task: Task,
        read: Callable[[], Iterable[Any]],
        force: Callable[[Array, Array], Array],
    ) -> None:
        """Follow a force.

        Args:
            task: of the run.
            read: returns r, m, and v, m/s, in the current state.
            force: (r, v) -> force, N.
        """
        self._tolerance, self._read, self._force = task.tolerance, read, force
        self._largest = 0.0  # so far, N
        self.restart()

    def restart(self) -> None:
        """Begin with the current state, as at the start."""
        self._start = self._now = self._state()

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state, as the step's cube."""
        self._now = r_1, v_1, force_1 = self._state()
        r_0, v_0, force_0 = self._start
        middle = 0.5 * (r_0 + r_1) + 0.125 * step * (v_0 - v_1)
        rate = 1.5 / step * (r_1 - r_0) - 0.25 * (v_0 + v_1)
        force = self._force(middle, rate)
        largest = max(self._largest, *(math.hypot(*f) for f in (force_0, force, force_1)))
        if largest == 0.0:
            return 0.0
        missed = math.hypot(*(force - 0.5 * (force_0 + force_1)))
        return math.pow(missed / (self._tolerance * largest), 1.5)

    def accept_step(self) -> None:
        """Take the end of the step last tried as the next one's beginning."""
        self._start = self._now
        self._largest = max(self._largest, math.hypot(*self._now[2]))

    def _state(self) -> tuple[Array, Array, Array]:
        """Return r, v and the force in the current state."""
        r, v = (np.array(values) for values in self._read())
        return r, v, self._force(r, v)
