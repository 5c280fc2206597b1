"""The run monitor: the one place where Exudyn calls, before, in and after every step."""

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType
from typing import Any, Protocol

import exudyn as exu

from exu_press.integrate.constraints import StepChange
from exu_press.integrate.newton import Newton
from exu_press.integrate.scales import FoundScales
from exu_press.integrate.settings import Tuning
from exu_press.progress import Progress

__all__ = ["Control", "Monitor", "Resolution", "Unresolved"]

SECONDS_BETWEEN_UPDATES = 0.1


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
    error says (see `exu_press.confidence`).

    Loads and prescribed motions of other systems may jump themselves, and steps end on that within
    what the tolerance leaves: a jump that changes no speed by a tenth of it is none of the step's.
    """

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
        jumps = scales.squares([a - b for a, b in zip(accelerations, before, strict=True)])
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


class Control(Protocol):
    """Sets the steps."""

    def after_newton(self, time: float) -> list[float]:
        """Return Exudyn's error and recommended step for a try of a step to `time`, s."""

    def after_step(self, time: float) -> list[float]:
        """Set the step after one that was accepted, or the first; return the accelerations."""


class Monitor:
    """Hands Exudyn's calls on to the parts of an integration, and to the user's own functions.

    Also counts, shows progress, and stops when asked to.

    Attributes:
        tries: number of steps tried.
        steps: of them, accepted ones.
        max_steps: tries before the run is given up.
        interrupted: whether Ctrl-C was pressed.
        over_budget: whether all of `max_steps` were used up.
        resolution: of the impacts.
        go_on: False once a function of the user's own asked to stop.
    """

    def __init__(
        self,
        begin: Callable[[], None],
        step_change: StepChange,
        newton: Newton,
        control: Control,
        resolution: Resolution,
        progress: Progress,
        start: float,
        max_steps: int,
    ) -> None:
        """Watch a run.

        Args:
            begin: called once, when Exudyn has computed the start's accelerations.
            step_change: is told of every try.
            newton: is told of every iteration.
            control: is told of every Newton solve and every step.
            resolution: is told of every accepted step.
            progress: is shown ten times a second.
            start: of the run, s.
            max_steps: budget.
        """
        self.tries = self.steps = 0
        self.interrupted = self.over_budget = False
        self.max_steps = max_steps
        self._begin, self._step_change, self._newton = begin, step_change, newton
        self._control, self.resolution, self._progress = control, resolution, progress
        self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
        self._start = start
        self._users: tuple[Any, Any, Any, Any] = 0, 0, 0, 0
        self.go_on = True

    @contextmanager
    def attached(self, mbs: exu.MainSystem) -> Iterator[None]:
        """Let Exudyn call this monitor; the user's own functions are called by it, and put back."""
        self._users = (
            _function(mbs.GetPreStepUserFunction()),
            _function(mbs.GetPreNewtonResidualUserFunction()),
            _function(mbs.GetPostNewtonUserFunction()),
            _function(mbs.GetPostStepUserFunction()),
        )
        places: tuple[Any, Any, Any, Any] = (
            mbs.SetPreStepUserFunction,
            mbs.SetPreNewtonResidualUserFunction,
            mbs.SetPostNewtonUserFunction,
            mbs.SetPostStepUserFunction,
        )
        ours = self._before_step, self._before_residual, self._after_newton, self._after_step
        for place, function in zip(places, ours, strict=True):
            place(function)
        try:
            with self._catching_interrupts():
                yield
        finally:
            for place, function in zip(places, self._users, strict=True):
                place(function)

    def _before_step(self, mbs: exu.MainSystem, end: float) -> bool:
        """Return whether to go on."""
        self.tries += 1
        if not self.tries % 16 and time.monotonic() > self._next_update:
            self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
            self._progress.update(end - self._start)
        self._step_change.before_try(end)
        self.over_budget = self.tries >= self.max_steps
        if self._users[0] and not self._users[0](mbs, end):
            self.go_on = False
        return self.go_on and not (self.interrupted or self.over_budget)

    def _before_residual(self, mbs: exu.MainSystem, end: float, iteration: int, other: int) -> None:
        if self._users[1]:
            self._users[1](mbs, end, iteration, other)
        self._newton.before_residual(end, iteration)

    def _after_newton(self, mbs: exu.MainSystem, end: float) -> list[float]:
        ours = self._control.after_newton(end)
        if not self._users[2]:
            return ours
        error, step = self._users[2](mbs, end)
        steps = [size for size in (ours[1], step) if size > 0.0]
        return [max(ours[0], error), min(steps, default=-1.0)]

    def _after_step(self, mbs: exu.MainSystem, end: float) -> bool:
        if self.tries == 0:  # Exudyn calls at the start too
            self._begin()
        accelerations = self._control.after_step(end)
        self.resolution.stepped(end, accelerations)
        self.steps += self.tries > 0
        if self._users[3] and not self._users[3](mbs, end):
            self.go_on = False
        return self.go_on

    @contextmanager
    def _catching_interrupts(self) -> Iterator[None]:
        """Let Ctrl-C end the run after the step under way, so that nothing is lost."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return

        def on_interrupt(number: int, frame: FrameType | None) -> None:
            self.interrupted = True

        before = signal.signal(signal.SIGINT, on_interrupt)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)


def _function(found: Any) -> Any:
    """Return what Exudyn's getters of user functions hold, or 0 where nothing is set."""
    return found["function"] if isinstance(found, dict) else 0
