"""Child processes: their start, requests, answers and end. No other module starts one.

A new child is `python -P -m fe_models.processes`: it runs nothing of the caller's script and
imports nothing from the working folder. On Linux a child may be a copy of the caller instead, which
is ready at once and has objects that no message carries, as an Exudyn system. Requests and answers
are pickles, each after its length. A child ends with its parent, whatever ends that: Linux kills
it, and on any system it ends itself when its requests close.
"""

import contextlib
import ctypes
import gc
import math
import os
import pickle
import signal
import stat
import subprocess
import sys
import tempfile
import threading
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO, NamedTuple

from fe_models.errors import DiskFullError, InputError, disk_full

__all__ = ["ONE_THREAD", "Child", "ChildError", "TimeLimitError", "may_copy"]

PR_SET_PDEATHSIG = 1
"""Of prctl(2): the signal that a process gets when its parent ends."""

ONE_THREAD = {
    f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "BLIS", "NGS")
} | {"VECLIB_MAXIMUM_THREADS": "1"}
"""Environment of a process whose libraries have one thread each."""

LAST_LETTERS = 2000
"""Most letters of a failed child's output in a message."""

NOT_FOUND = " (a child does not search the folder where one works; PYTHONPATH names others)"
"""Cure of a module that is not found."""

ANSWER, REPORT, WRONG_INPUT, NO_ROOM, FAILURE = range(5)
"""Kinds of a child's messages."""

DESCRIPTORS = "/proc/self/fd"
"""Linux's folder of the files and pipes that a process has open."""

try:
    WORKING_FOLDER = str(Path.cwd())
except OSError:  # it has been removed
    WORKING_FOLDER = ""


class ChildError(RuntimeError):
    """A child ended before it answered, or its function failed; the text says how."""


class TimeLimitError(ChildError):
    """A child was killed as it took too long."""


class Setup(NamedTuple):
    """What a child needs before its first request, in Python's own types.

    Attributes:
        parent: number of the parent's process.
        path: the parent's `sys.path`, without the working folder.
        function: "module:name" of the child's function; or the function, of a copy.
        niceness: added to the parent's.
        memory: bytes of address space that it may have, where the system limits them.
    """

    parent: int
    path: list[str]
    function: str | Callable[..., Any]
    niceness: int
    memory: int | None


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
                self._process = start([sys.executable], preexec_fn=partial(_run_copy, setup))
        else:
            flags = {"-E": sys.flags.ignore_environment, "-s": sys.flags.no_user_site}
            options = [option for option, is_set in flags.items() if is_set]
            environment = {**os.environ, **(ONE_THREAD if one_thread else {})}
            command = [sys.executable, *options, "-P", "-m", __name__]
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
                    kind, value = pickle.loads(_read(self._answers))
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
                    errors = {WRONG_INPUT: InputError, NO_ROOM: DiskFullError}
                    raise errors.get(kind, ChildError)(value)

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
            _send(self._requests, pickle.dumps(message))

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


def may_copy() -> bool:
    """Return whether a copy of this process can run by itself.

    It has this thread alone, so it never gets a lock that another thread holds; NGSolve has
    threads of its own.
    """
    return (
        sys.platform == "linux"
        and Path(DESCRIPTORS).is_dir()
        and threading.active_count() == 1
        and "ngsolve" not in sys.modules
    )


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


def _send(stream: Any, message: bytes) -> None:
    stream.write(len(message).to_bytes(8) + message)
    stream.flush()


def _read(stream: Any) -> bytes:
    """Return the next message; raise EOFError where the other side has ended."""
    head: bytes = stream.read(8)
    message: bytes = stream.read(int.from_bytes(head)) if len(head) == 8 else b""
    if len(head) < 8 or len(message) < int.from_bytes(head):
        raise EOFError
    return message


def _open_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Return requests and answers, which were standard input and output; output goes to errors."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    with Path(os.devnull).open("rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)
    return requests, answers


def _run_copy(setup: Setup) -> None:
    """Perform requests in a copy of this process; never returns."""
    code = 1
    try:
        gc.enable()  # which starting a process disables
        # the parent's ends of pipes; files stay open
        for number in [int(path.name) for path in Path(DESCRIPTORS).iterdir()]:
            with contextlib.suppress(OSError):
                if number > 2 and stat.S_ISFIFO(os.fstat(number).st_mode):
                    os.close(number)
        pipes = _open_pipes()
        sys.stdout = sys.stderr = os.fdopen(2, "w", closefd=False)
        _perform(setup, *pipes)
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else 1
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)  # nothing of the original is ended twice


def _perform(setup: Setup, requests: BinaryIO, answers: BinaryIO) -> None:
    """Perform requests until they close; answers wait in memory until they are read."""
    if sys.platform == "linux":  # compiled code need not notice a closed pipe
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != setup.parent:  # it has ended already
            os._exit(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if setup.niceness and hasattr(os, "nice"):
        os.nice(setup.niceness)
    if sys.platform != "win32" and setup.memory is not None:
        with contextlib.suppress(ImportError, ValueError, OSError):  # a system without such limits
            import resource

            resource.setrlimit(resource.RLIMIT_AS, (setup.memory, setup.memory))
    received: SimpleQueue[bytes] = SimpleQueue()
    ready: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_receive, args=(requests, received), daemon=True).start()
    threading.Thread(target=_deliver, args=(answers, ready), daemon=True).start()

    def report(*values: Any) -> None:
        ready.put(pickle.dumps((REPORT, values)))

    while True:
        request = received.get()
        try:
            arguments, reports = pickle.loads(request)
            function: Any = setup.function
            if isinstance(function, str):
                module, _, name = function.partition(":")
                function = getattr(import_module(module), name)
            value = function(*arguments, *([report] if reports else []))
            answer = pickle.dumps((ANSWER, value))
        except Exception as error:
            answer = pickle.dumps(_failure(error))
        ready.put(answer)


def _failure(error: Exception) -> tuple[int, str]:
    """Return kind and text of the message about an error."""
    if full := disk_full(error):
        return NO_ROOM, str(full)
    if isinstance(error, InputError):
        return WRONG_INPUT, str(error)
    text = " ".join(str(error).partition("\n\nAt:")[0].split())  # no calls of Exudyn
    cure = NOT_FOUND if isinstance(error, ModuleNotFoundError) else ""
    name = type(error).__name__
    return FAILURE, f"{name}: {text}{cure}" if text else name


def _receive(stream: BinaryIO, received: "SimpleQueue[bytes]") -> None:
    """Queue requests; where they close, end this process, whatever it computes."""
    with contextlib.suppress(EOFError):
        while True:
            received.put(_read(stream))
    os._exit(1)


def _deliver(stream: BinaryIO, ready: "SimpleQueue[bytes]") -> None:
    """Write answers as they come, while the next one is computed."""
    with contextlib.suppress(BrokenPipeError):  # the parent is gone
        while True:
            _send(stream, ready.get())


if __name__ == "__main__":
    pipes = _open_pipes()
    setup = Setup(*pickle.loads(_read(pipes[0])))
    sys.path[:] = setup.path
    _perform(setup, *pipes)
