"""The run monitor: the one place where Exudyn calls, before, in and after every step."""

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Protocol

import exudyn as exu

from exu_press.integrate.ending import Resolution
from exu_press.integrate.newton import Newton
from exu_press.integrate.step_change import StepChange
from exu_press.progress import Progress

__all__ = ["Control", "Monitor"]

SECONDS_BETWEEN_UPDATES = 0.1


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
        self._control, self._resolution, self._progress = control, resolution, progress
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
        self._resolution.stepped(end, accelerations)
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
