"""Whether the steps of a run resolved its impacts."""

import math
from dataclasses import dataclass

from exu_press.integrate.task import Task

__all__ = ["ImpactResolution", "UnresolvedImpact"]


@dataclass(frozen=True)
class UnresolvedImpact:
    """The worst step of a run that its steps do not resolve.

    Attributes:
        time: where the step ends, s.
        step: its size, s.
        node: whose inertia force jumps, counted as in the problem.
        jump: of that force, over the largest one of the run.
    """

    time: float
    step: float
    node: int
    jump: float


class ImpactResolution:
    """Follows the inertia forces of all bodies: do the steps resolve the impacts?

    A step of any size gets through an impact, and determines its peak. Resolved, a force rises over
    several steps: the largest change of an inertia force m |a| within one counts, over the largest.
    Against a tolerance of 1e-5 on presses and slider-cranks, steps of 1e-3 to 1e-5 s: above 0.8 the
    joints' peak forces were off by 9 to 90 %, between 0.65 and 0.8 by 2 to 17 %.

    Loads may jump themselves: a jump that changes no speed by a tenth of the tolerance is none of
    the step's; with clearance joints, whose largest forces may be those of slight impacts, by a
    hundredth. Joints bear weights as well: where all inertia forces are smaller, a jump is judged
    against the largest weight.
    """

    def __init__(self, task: Task) -> None:
        """Follow a task."""
        self._scales, self._largest_jump = task.scales, task.tuning.largest_jump
        self._radius = task.spectral_radius  # by which a ring decays from step to step
        self._least = (0.1 if task.system.joints is None else 0.01) * task.tolerance
        self._last: list[float] = []
        # A stiff film that starts from rest makes the accelerations ring; that is no impact.
        self._started: list[float] = []
        self._ring = 1.0
        self._largest = 0.0
        self._steps = 0
        # jump, end and size of the step (s), node, and half the change of speed in the step (m/s)
        self._jumps: list[tuple[float, float, float, int, float]] = []

    def begin(self, accelerations: list[float]) -> None:
        """Begin with the accelerations of all coordinates at the start."""
        self._last, self._started, self._ring = accelerations, [], 1.0

    def accept(self, time: float, step: float, accelerations: list[float]) -> None:
        """Look at an accepted step (s), and where it ends (s)."""
        last, self._last = self._last, accelerations
        inertias, masses, ends = self._scales.inertias, self._scales.masses, self._scales.ends
        first = not self._started
        if not first:
            self._ring *= self._radius
        self._steps += 1
        i = 0
        for k in range(len(ends)):  # one pass over all coordinates, as it is done in each step
            size = jump = 0.0
            while i < ends[k]:
                now = accelerations[i]
                change = now - last[i]
                size += inertias[i] * now * now
                jump += inertias[i] * change * change
                i += 1
            mass = masses[k]
            excluded = mass == math.inf
            jump = 0.0 if excluded else math.sqrt(jump / mass)
            if first:
                self._started.append(2.0 * jump)
            if excluded:
                continue
            ringing = self._started[k] * self._ring
            self._largest = max(self._largest, mass * (math.sqrt(size / mass) - ringing))
            force = mass * (jump - ringing)
            if force > self._largest_jump * self._largest:
                self._jumps.append((force, time, step, k, 0.5 * step * jump))

    def worst(self) -> UnresolvedImpact | None:
        """Return the step with the largest change of an inertia force, if it is too large."""
        speed, rest = self._scales.speed, self._scales.roundoff_speed
        least = max(self._least * speed, rest) if speed > rest else math.inf
        felt = [jump for jump in self._jumps if jump[-1] > least]
        if self._steps < 2 or not felt:
            return None
        jump, time, step, node, _ = max(felt)
        weight = self._scales.gravity * max(m for m in self._scales.masses if m < math.inf)
        if jump <= self._largest_jump * max(self._largest, weight):
            return None
        return UnresolvedImpact(time, step, node, jump / self._largest)
