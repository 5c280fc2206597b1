"""Whether the steps of a run resolved its impacts."""

import math
from dataclasses import dataclass

from exu_press.integrate.task import Task

__all__ = ["ImpactResolution", "Unresolved"]


@dataclass(frozen=True)
class Unresolved:
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

    A step of any size gets through an impact, and generalized-alpha is stable at all of them: the
    run ends, its curves look smooth, and its peaks have the height that the step gives them. What
    tells is how a peak is reached. Resolved, a force rises over several steps; where the largest
    force of the run comes or goes within one step, its height is the step's.

    So the figure is the largest change of an inertia force m |a| within one step, of any body,
    against the largest inertia force of the run. Measured against a tolerance of 1e-5 on dry,
    lubricated and mixed presses and slider-cranks of many clearances, speeds and dampings, steps of
    1e-3 to 1e-5 s: above 0.8 the joints' peak forces were off by 9 to 90 %, seldom less; between
    0.65 and 0.8 by 2 to 17 %. Below, steps say nothing against a peak, and nothing for it either:
    an error that an earlier impact left may have grown by then. How far a figure is off its stated
    error says (see `exu_press.verification`).

    Loads and prescribed motions may jump themselves, and steps end on that within what the
    tolerance leaves: a jump that changes no speed by a tenth of it is none of the step's; with
    clearance joints, whose largest forces may be those of slight impacts, by a hundredth.
    In an equilibrium, and in a press that stands, rounded forces come and go, and move nothing.
    Joints bear weights as well: where all inertia forces are smaller, as what is left of the start
    in a press that stands, a jump is judged against the largest weight.
    """

    def __init__(self, task: Task) -> None:
        """Follow a task."""
        self._scales, self._largest_jump = task.scales, task.tuning.largest_jump
        self._radius = task.spectral_radius  # by which a ring decays from step to step
        self._least = (0.1 if task.system.joints is None else 0.01) * task.tolerance
        self._before: list[float] = []
        # A stiff film that starts from rest makes the accelerations ring; that is no impact.
        self._started: list[float] = []
        self._ring = 1.0
        self._largest = 0.0
        self._steps = 0
        # size, end and size of the step (s), node, and half the change of speed in the step (m/s)
        self._jumps: list[tuple[float, float, float, int, float]] = []

    def begin(self, accelerations: list[float]) -> None:
        """Be told of all coordinates' accelerations where the motion begins, or begins anew."""
        self._before, self._started, self._ring = accelerations, [], 1.0

    def stepped(self, time: float, step: float, accelerations: list[float]) -> None:
        """Be told of an accepted step (s), and where it ends (s)."""
        before, self._before = self._before, accelerations
        scales = self._scales
        jumps = scales.squares([accelerations[i] - before[i] for i in range(len(before))])
        sizes = scales.squares(accelerations)
        masses = scales.masses
        if not self._started:
            self._started = [2.0 * math.sqrt(square) for square in jumps]
        else:
            self._ring *= self._radius
        self._steps += 1
        for i in range(len(masses)):
            mass = masses[i]
            if mass == math.inf:
                continue
            ringing = self._started[i] * self._ring
            self._largest = max(self._largest, mass * (math.sqrt(sizes[i]) - ringing))
            jump = mass * (math.sqrt(jumps[i]) - ringing)
            if jump > self._largest_jump * self._largest:
                self._jumps.append((jump, time, step, i, 0.5 * step * math.sqrt(jumps[i])))

    def worst(self) -> Unresolved | None:
        """Return the step with the largest change of an inertia force, if it is too large."""
        speed = self._scales.speed
        rest = self._scales.roundoff_speed
        least = max(self._least * speed, rest) if speed > rest else math.inf
        felt = [jump for jump in self._jumps if jump[-1] > least]
        if self._steps < 2 or not felt:
            return None
        jump, time, step, node, _ = max(felt)
        weight = self._scales.gravity * max(m for m in self._scales.masses if m < math.inf)
        if jump <= self._largest_jump * max(self._largest, weight):
            return None
        return Unresolved(time, step, node, jump / self._largest)
