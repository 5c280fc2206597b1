"""Steps: their sizes, by a tolerance or fixed, and whether they resolved the impacts."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from exu_press.integrate.controller import Controller, LimitedGrowth
from exu_press.integrate.error import StepError
from exu_press.integrate.settings import SAME, Task

__all__ = ["FixedSteps", "Resolution", "StepControl", "Unresolved"]

LARGEST_JUMP = 0.65
"""Change of an inertia force within one step, over the run's largest one, above which impacts are
not resolved."""


class StepControl:
    """Sets the step so that its error stays below 1.

    Attributes:
        error: of the last try.
        of_force: whether that is too large, in a step that cannot be shorter, as a force jumps.
    """

    def __init__(
        self,
        task: Task,
        estimate: StepError,
        next_corner: Callable[[float], float],
        next_sample: Callable[[float], float],
        controller: Controller | None = None,
    ) -> None:
        """Control the steps of a task.

        Args:
            task: to be solved.
            estimate: of the error of a step.
            next_corner: time -> the next instant at which a load has a corner, s, or infinity.
            next_sample: time -> the next one of a grid on which steps end, s, or infinity.
            controller: changes steps for their errors; `LimitedGrowth` unless given.
        """
        self.error, self.of_force = 0.0, False
        self._controller = controller or LimitedGrowth(task.tuning, impacts=task.impacts)
        self._estimate, self._next_corner = estimate, next_corner
        self._next_sample = next_sample
        self._end, self._smallest, self._largest = task.end, task.smallest, task.largest
        self._no_shorter = task.no_shorter
        self._step = self._first = task.first
        self._asked = 0.0  # what Exudyn is to try, s; shorter than the step, up to a corner
        # the step that failed last, s, its change of speeds, m/s, and what is left of it, s
        self._failed, self._change, self._left = math.inf, 0.0, 0.0

    def start_again(self) -> None:
        """Go on with the first step's size, as the motion begins anew."""
        self._step = self._first

    def shorter(self, step: float) -> float:
        """Return with which step to repeat one just tried, s, or 0.0 where it is good enough."""
        error = self._estimate(step)
        if error > 1.0 and step <= self._no_shorter:
            error = min(error, self._estimate.of_jump(step))
        self.error = error
        if error <= 1.0:
            return 0.0
        self.of_force = step <= self._no_shorter and self._changes_with(step)
        self._failed = self._left = step
        self._change = self._estimate.change_of_speed()
        self._step = self._asked = step * self._controller.repeated(error)
        return self._step

    def _changes_with(self, step: float) -> bool:
        """Return whether a jump in a step (s) changes speeds by less than in the longer one before.

        So does that of a force, with the step, however slow the motion is that it meets. What
        changes speeds by as much in any step is a blow, or a constraint that jumps.
        """
        allowed = self._change * math.sqrt(step / self._failed)
        # what failed before lies behind: it had another jump
        return self._left >= -self._smallest and self._estimate.change_of_speed() < allowed

    def accept(self, step: float) -> None:
        """Take the step last tried as done; choose the size of those to come."""
        self._left -= step
        shortened = step < (1.0 - SAME) * self._asked  # by Exudyn
        self._estimate.accept(shortened)
        if shortened and step >= 0.5 * self._step:  # else by a contact that it ends on
            self._step = step
        part = step / self._step
        self._step *= self._controller.continued(self.error / (part * part * part))

    def next_step(self, time: float) -> float:
        """Return the step from a time on, s; it ends exactly on corners, samples and the end.

        Two steps of one size lead to the next corner, where one would not get there. A corner
        that only rounding tells from the end is the end: as a stop of its own it would be neared by
        halves, down to the smallest step. Samples are many, and all steps between two are of one
        size: a change of the step takes as long as three.
        """
        self._step = step = min(self._step, self._largest)
        left, corner = self._end - time, self._next_corner(time)
        if self._smallest < corner - time < left - self._smallest:
            left = corner - time
        if left > self._smallest and step > 0.5 * left:
            step = left if step >= left else 0.5 * left
        left = self._next_sample(time) - time
        if self._smallest < left < math.inf:
            step = min(step, left / math.ceil((1.0 - SAME) * left / step))
        self._asked = step
        return step


class FixedSteps:
    """Keeps steps of one size on their grid t = n h.

    The first one may be taken in pieces that double, so that a film takes up its load; and after a
    step that Exudyn had to halve, steps double back to the grid.

    Attributes:
        error: none that is known.
        of_force: never.
    """

    def __init__(self, task: Task) -> None:
        """Take the steps of a task."""
        self.error, self.of_force = 0.0, False
        self._step, self._start = task.largest, task.start
        self._size = self._next = task.first

    def start_again(self) -> None:
        """Keep the grid."""

    def shorter(self, step: float) -> float:
        """Return 0.0: every step is good enough."""
        return 0.0

    def accept(self, step: float) -> None:
        """Take a step (s) as done."""
        halved = step < 0.99 * self._next
        self._size = step if halved else min(self._step, 2.0 * self._size)

    def next_step(self, time: float) -> float:
        """Return the step from a time on, s."""
        h, gone = self._step, time - self._start
        to_grid = (math.floor(gone / h * (1.0 + 1e-9)) + 1) * h - gone
        on_grid = to_grid > (1.0 - 1e-9) * h
        self._next = self._size if on_grid else min(to_grid, self._size)
        return self._next


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


class Resolution:
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
        self._scales = task.scales
        self._radius = task.spectral_radius  # by which a ring decays from step to step
        self._least = (0.1 if task.problem.joints is None else 0.01) * task.tolerance
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
            if jump > LARGEST_JUMP * self._largest:
                self._jumps.append((jump, time, step, i, 0.5 * step * math.sqrt(jumps[i])))

    def worst(self) -> Unresolved | None:
        """Return the step with the largest change of an inertia force, if it is too large."""
        speed = self._scales.speed
        rest = self._scales.rest
        least = max(self._least * speed, rest) if speed > rest else math.inf
        felt = [found for found in self._jumps if found[-1] > least]
        if self._steps < 2 or not felt:
            return None
        jump, time, step, node, _ = max(felt)
        weight = self._scales.gravity * max(m for m in self._scales.masses if m < math.inf)
        if jump <= LARGEST_JUMP * max(self._largest, weight):
            return None
        return Unresolved(time, step, node, jump / self._largest)
