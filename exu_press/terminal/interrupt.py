"""Ctrl-C where it would lose what is computed."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

__all__ = ["handled_interrupt", "postponed_interrupt", "unmasked_interrupt"]


@contextmanager
def handled_interrupt(handle: Callable[[], None]) -> Iterator[None]:
    """Call a function at Ctrl-C in the block, unless it is ignored, or another thread's."""
    ignored = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    if ignored or threading.current_thread() is not threading.main_thread():
        yield
        return
    handler = signal.signal(signal.SIGINT, lambda number, frame: handle())
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)


@contextmanager
def postponed_interrupt() -> Iterator[None]:
    """Postpone Ctrl-C in the block to its end.

    Raises:
        KeyboardInterrupt: at the end.
    """
    interrupts: list[None] = []
    with handled_interrupt(partial(interrupts.append, None)):
        yield
    if interrupts:
        raise KeyboardInterrupt


@contextmanager
def unmasked_interrupt() -> Iterator[None]:
    """Let Ctrl-C in the block be KeyboardInterrupt, whatever error compiled code makes of it.

    Raises:
        KeyboardInterrupt: at once, or in place of that error.
    """
    interrupts: list[None] = []

    def interrupt() -> None:
        interrupts.append(None)
        raise KeyboardInterrupt

    with handled_interrupt(interrupt):
        try:
            yield
        except Exception:
            if not interrupts:
                raise
    if interrupts:
        raise KeyboardInterrupt
