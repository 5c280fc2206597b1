"""Whether a run's steps resolved its impacts: asked of every accepted step, told after the end.

A step of any size gets through an impact, and generalized-alpha is stable at all of them: the run
ends, its curves look smooth, and its peaks have the height that the step gives them. What tells is
how a peak is reached. Resolved, a force rises over several steps; where the largest force of the
run comes or goes within one step, its height is the step's.

So the figure is the largest change of an inertia force m |a| within one step, of any body, against
the largest inertia force of the run. Measured against a tolerance of 1e-5 on dry, lubricated and
mixed presses and slider-cranks of many clearances, speeds and dampings, steps of 1e-3 to 1e-5 s:
above 0.8 the joints' peak forces were off by 9 to 90 %, seldom less; between 0.65 and 0.8 by 2 to
17 %. Below, steps say nothing against a peak, and nothing for it either: an error that an earlier
impact left may have grown by then. How far a figure is off its stated error says (see
`exu_press.confidence`).

Loads and prescribed motions of other systems may jump themselves, and steps end on that within what
the tolerance leaves: a jump that changes no speed by a tenth of it is none of the step's.
"""

import math
from dataclasses import dataclass

from exu_press.integrate.body_error import squares
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.tuning import Tuning

__all__ = ["Resolution", "Unresolved"]


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
    """Follows the inertia forces of all bodies from step to step."""

    def __init__(
        self, scales: FoundScales, spectral_radius: float, least: float, tuning: Tuning
    ) -> None:
        """Start.

        Args:
            scales: of the motion, which knows the bodies.
            spectral_radius: at infinity, by which a ring decays from step to step.
            least: part of the largest speed that a jump must change within its step to count.
            tuning: numbers.
        """
        self._scales, self._radius = scales, spectral_radius
        self._least = least
        self._allowed = tuning.largest_jump
        self._time = 0.0
        self._before: list[float] = []
        # A stiff film that starts from rest makes the accelerations ring; that is no impact.
        self._started: list[float] = []
        self._ring = 1.0
        self._largest = 0.0
        self._steps = 0
        # size, end and size of the step (s), node, and half the change of speed in the step (m/s)
        self._jumps: list[tuple[float, float, float, int, float]] = []

    def stepped(self, time: float, accelerations: list[float]) -> None:
        """Be told of an accepted step's end (s), or of the start."""
        before, self._before = self._before, accelerations
        start, self._time = self._time, time
        if not before:
            return
        scales = self._scales
        jumps = squares(scales, [a - b for a, b in zip(accelerations, before, strict=True)])
        sizes = squares(scales, accelerations)
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
            if jump > self._allowed * self._largest:
                change = 0.5 * (time - start) * math.sqrt(jumps[i])
                self._jumps.append((jump, time, time - start, i, change))

    def worst(self) -> Unresolved | None:
        """Return the step with the largest change of an inertia force, if it is too large."""
        least = self._least * self._scales.speed
        felt = [found for found in self._jumps if found[-1] > least]
        if self._steps < 2 or not felt:
            return None
        jump, time, step, node, _ = max(felt)
        if jump <= self._allowed * self._largest:
            return None
        return Unresolved(time, step, node, jump / self._largest)
