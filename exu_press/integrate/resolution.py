"""Whether the steps of a run resolved its impacts."""

import math
from dataclasses import dataclass

from exu_press.integrate.task import Task

__all__ = ["ImpactResolution", "UnresolvedImpact"]


@dataclass(frozen=True)
class UnresolvedImpact:
    """The step with the largest jump of an inertia force, in a run whose impacts are not resolved.

    Attributes:
        time: where the step ends, s.
        step: its size, s.
        node: index of the system's node whose inertia force jumps.
        jump: change of that force over the largest one of the run.
    """

    time: float
    step: float
    node: int
    jump: float


class ImpactResolution:
    """Measures from the inertia forces of all bodies whether steps resolve the impacts.

    A step of any size passes an impact, but then its size determines the peak. In an impact that is
    resolved the force rises over several steps. The measure is the largest change of an inertia
    force m |a| within one step over the largest inertia force of the run. On presses and
    slider-cranks, with steps of 1e-3 to 1e-5 s against a tolerance of 1e-5, joints' peak forces
    were off by 9 to 90 % where it was above 0.8, and by 2 to 17 % between 0.65 and 0.8.

    A load may jump itself: a jump that changes each speed by less than a tenth of the tolerance is
    ignored; with clearance joints, whose largest forces may be those of slight impacts, by less
    than a hundredth. Where all inertia forces are smaller than the largest weight, which joints
    bear as well, a jump is judged against that weight.
    """

    def __init__(self, task: Task) -> None:
        """Follow a task."""
        self._scales, self._largest_jump = task.scales, task.tuning.largest_jump
        self._radius = task.spectral_radius  # by which a ring decays from step to step
        self._least = (0.1 if task.system.joints is None else 0.01) * task.tolerance
        self._last: list[float] = []
        # A stiff film that starts from rest makes the accelerations ring; that is no impact.
        self._started: list[float] = []
        self._ring, self._largest, self._steps = 1.0, 0.0, 0
        # jump, end and size of the step (s), node, and half the change of speed in the step (m/s)
        self._jumps: list[tuple[float, float, float, int, float]] = []

    def begin(self, accelerations: list[float]) -> None:
        """Begin with the accelerations of all coordinates at the start."""
        self._last, self._started, self._ring = accelerations, [], 1.0

    def measure_step(self, time: float, step: float, accelerations: list[float]) -> None:
        """Measure an accepted step (s) that ends at a time (s)."""
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
