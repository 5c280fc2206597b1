"""Child processes: their start, requests, answers and end. No other module starts one.

A new child is `python -P -m fe_models.child`: it runs nothing of the caller's script and imports
nothing from the working folder. On Linux a child may be a copy of the caller instead, which is
ready at once and has objects that no message carries, as an Exudyn system.
"""

import contextlib
import math
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from fe_models import child
from fe_models.child import ANSWER, DESCRIPTORS, ERRORS, REPORT, Setup, read, run_copy, send

__all__ = [
    "ONE_THREAD",
    "Child",
    "ChildError",
    "TimeLimitError",
    "may_copy",
    "performed_beside",
    "why_not_copied",
]

Value = TypeVar("Value")

ONE_THREAD = {
    f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "BLIS", "NGS")
} | {"VECLIB_MAXIMUM_THREADS": "1"}
"""Environment of a process whose libraries have one thread each."""

LAST_LETTERS = 2000
"""Most letters of a failed child's output in a message."""

try:
    WORKING_FOLDER = str(Path.cwd())
except OSError:  # it has been removed
    WORKING_FOLDER = ""


class ChildError(RuntimeError):
    """A child ended before it answered, or its function failed; the text says how."""


class TimeLimitError(ChildError):
    """A child was killed as it took too long."""


class Child(AbstractContextManager["Child", None]):
    """A process that performs one function, on one request after another; a context manager.

    The thread that has started it must end it, too: Linux ends a child with this thread.
    """

    def __init__(
        self,
        function: str | Callable[..., Any],
        *,
        niceness: int = 0,
        memory: int | None = None,
        one_thread: bool = False,
        silent: bool = True,
        progress: Callable[..., None] | None = None,
    ) -> None:
        """Start it.

        Args:
            function: "module:name" for a new process; a function for a copy of this one, where
                `may_copy` allows it.
            niceness: added to that of this process.
            memory: bytes of address space that it may have.
            one_thread: libraries of a new process have one thread each.
            silent: its output is shown only if it fails; else on standard error.
            progress: called with what the function reports; the function has a further argument,
                `report`, to do so.
        """
        setup = Setup(os.getpid(), _search_path(), function, niceness, memory)
        self._progress = progress
        # without a name: a kill leaves no file
        self._output = tempfile.TemporaryFile() if silent else None  # noqa: SIM115
        start = partial(
            subprocess.Popen,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=2 if self._output is None else self._output.fileno(),
            start_new_session=True,  # Ctrl-C in a terminal is for the parent alone
            restore_signals=False,  # a closed pipe is an exception, not a signal
        )
        if callable(function):
            for stream in (sys.stdout, sys.stderr):
                stream.flush()  # else the copy writes it once more
            with warnings.catch_warnings():  # of threads: those of libraries wait for work
                warnings.simplefilter("ignore", DeprecationWarning)
                self._process = start([sys.executable], preexec_fn=partial(run_copy, setup))
        else:
            flags = {"-E": sys.flags.ignore_environment, "-s": sys.flags.no_user_site}
            options = [option for option, is_set in flags.items() if is_set]
            environment = {**os.environ, **(ONE_THREAD if one_thread else {})}
            command = [sys.executable, *options, "-P", "-m", child.__name__]
            self._process = start(command, env=environment)
        assert self._process.stdin is not None and self._process.stdout is not None
        self._requests, self._answers = self._process.stdin, self._process.stdout
        if not callable(function):
            self._write(tuple(setup))

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self._process.poll() is None

    def request(self, *arguments: Any) -> None:
        """Request a call of the function; the child works off requests in their order."""
        self._write((arguments, self._progress is not None))

    def answer(self, time_limit: float | None = None) -> Any:
        """Return the function's value for the next request.

        Args:
            time_limit: s, after which the child is killed.

        Raises:
            InputError: the function says that the input is wrong, or a disk is full.
            TimeLimitError: it takes too long.
            ChildError: it raises another error, or the process ends.
        """
        with self._kill_after(time_limit) as expired:
            while True:
                try:
                    kind, value = pickle.loads(read(self._answers))
                except EOFError:
                    code = self._process.wait()
                    if expired.is_set():
                        raise TimeLimitError(f"stopped after {time_limit:g} s") from None
                    raise ChildError(f"{_describe_end(code)}{self._last_output()}") from None
                if kind == REPORT and self._progress is not None:
                    self._progress(*value)
                elif kind == ANSWER:
                    return value
                else:
                    raise ERRORS.get(kind, ChildError)(value)

    def kill(self) -> None:
        """Kill the process from another thread; one that waits for it gets `ChildError`."""
        self._process.kill()

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        for stream in (self._requests, self._answers, self._output):
            with contextlib.suppress(OSError):  # an unread request
                if stream is not None:
                    stream.close()

    def __exit__(self, *_: object) -> None:
        self.end()

    def _write(self, message: Any) -> None:
        with contextlib.suppress(BrokenPipeError):  # then there is no answer either
            send(self._requests, pickle.dumps(message))

    @contextmanager
    def _kill_after(self, time_limit: float | None) -> Iterator[threading.Event]:
        """Kill the process after a time, s, and set the event."""
        expired = threading.Event()

        def stop() -> None:
            expired.set()
            self.kill()

        timer = threading.Timer(min(time_limit or math.inf, threading.TIMEOUT_MAX), stop)
        timer.daemon = True
        if time_limit is not None:
            timer.start()
        try:
            yield expired
        finally:
            timer.cancel()
            if expired.is_set():
                self._process.wait()  # it may have answered just before

    def _last_output(self) -> str:
        """Return the end of the child's output in a line, after a colon; no traceback."""
        if self._output is None:
            return ""
        size = self._output.seek(0, os.SEEK_END)
        self._output.seek(max(0, size - LAST_LETTERS))
        text = self._output.read().decode(errors="replace").strip()
        if "Traceback (most recent call last)" in text:
            text = text.splitlines()[-1]
        return f": {' '.join(text.split())}" if text else ""


@contextmanager
def performed_beside(
    function: Callable[..., Value],
) -> Iterator[Callable[..., Callable[[], Value]]]:
    """Yield what begins to compute a function of arguments, and returns what returns its value.

    A copy of this process computes, in the order of the beginnings; values are asked for in it,
    too. With a single core, or where no copy can run, this process computes when it is asked.
    """
    if (os.cpu_count() or 1) == 1 or not may_copy():
        yield partial(partial, function)
        return
    with Child(function) as child:

        def begin(*arguments: Any) -> Callable[[], Value]:
            child.request(*arguments)
            return child.answer

        yield begin


def may_copy() -> bool:
    """Return whether a copy of this process can run by itself."""
    return not why_not_copied()


def why_not_copied() -> str:
    """Return why a copy of this process cannot run by itself, or nothing.

    It has this thread alone, so it never gets a lock that another thread holds, but those of a
    child's pipes, which hold none that it needs; NGSolve has threads of its own.
    """
    if sys.platform != "linux" or not Path(DESCRIPTORS).is_dir():
        return f"this is {sys.platform}"
    if "ngsolve" in sys.modules:
        return "NGSolve is loaded"
    threads = sum(thread.name != child.OF_PIPES for thread in threading.enumerate())
    return f"there are {threads} threads" if threads > 1 else ""


def _search_path() -> list[str]:
    """Return `sys.path` without the entry that `-c`, `-m` or a prompt adds for the working folder.

    Folders that the user has named stay: PYTHONPATH's, and that of his script.
    """
    path = [entry for entry in sys.path if entry]
    run_as_module = getattr(sys.modules.get("__main__"), "__spec__", None) is not None
    if run_as_module and not sys.flags.safe_path and WORKING_FOLDER in path:
        path.remove(WORKING_FOLDER)
    return path


def _describe_end(code: int) -> str:
    """Return a text about the exit status of a process, negative for a signal."""
    if code >= 0:
        return f"exit status {code}"
    with contextlib.suppress(ValueError):
        return f"killed by {signal.Signals(-code).name}"
    return f"killed by signal {-code}"
