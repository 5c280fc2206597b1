"""What looks on while a model is integrated: progress, Ctrl-C, a budget of steps."""

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

import exudyn as exu

from exu_press.progress import Progress

__all__ = ["Watch"]

SECONDS_BETWEEN_UPDATES = 0.1


class Watch:
    """Called by Exudyn before every step: counts, shows progress, stops when asked to.

    Attributes:
        calls: number of steps tried.
        max_steps: of them, before the run is given up.
        interrupted: whether Ctrl-C was pressed.
        over_budget: whether all of `max_steps` were used up.
    """

    def __init__(
        self, progress: Progress, before_try: Callable[[float], None], max_steps: int
    ) -> None:
        """Watch a run.

        Args:
            progress: is shown ten times a second.
            before_try: called with the end of every step, s, before it is tried.
            max_steps: budget.
        """
        self.calls = 0
        self.interrupted = self.over_budget = False
        self.max_steps = max_steps
        self._progress = progress
        self._before_try = before_try
        self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES

    def before_step(self, mbs: exu.MainSystem, now: float) -> bool:
        """Return whether to go on."""
        self.calls += 1
        if not self.calls % 16 and time.monotonic() > self._next_update:
            self._next_update = time.monotonic() + SECONDS_BETWEEN_UPDATES
            self._progress.update(now)
        self._before_try(now)
        self.over_budget = self.calls >= self.max_steps
        return not (self.interrupted or self.over_budget)

    @contextmanager
    def catching_interrupts(self) -> Iterator[None]:
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
