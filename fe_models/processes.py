"""Child processes: how one starts, gets its work, answers, and ends; here alone one is started.

A new child is `python -P -m fe_models.processes`: it runs nothing of the caller's script and
imports nothing from the folder where one works. On Linux a child may be a copy of the caller
instead, which is there at once and has what no message carries, as an Exudyn system. Requests and
answers are pickles, each after its length. A child ends with its parent, whatever ends that: Linux
kills it, and on any system it ends itself when its requests close.
"""

import contextlib
import ctypes
import math
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO

from fe_models.errors import DiskFullError, InputError, disk_full

__all__ = ["ONE_THREAD", "Child", "ChildError", "TimeLimitError", "may_copy"]

PR_SET_PDEATHSIG = 1
"""Of prctl(2): the signal that a process gets when its parent ends."""

ONE_THREAD = dict.fromkeys(
    (
        "OMP_NUM_THREADS",
        "OPENBLAS_NUM_THREADS",
        "MKL_NUM_THREADS",
        "BLIS_NUM_THREADS",
        "VECLIB_MAXIMUM_THREADS",
        "NGS_NUM_THREADS",
    ),
    "1",
)
"""Environment of a process whose libraries have one thread each."""

LAST_LETTERS = 2000
"""Of what a child that failed has printed, in the message."""

NOT_FOUND = " (a child does not search the folder where one works; PYTHONPATH names others)"
"""Cure of a module that is not found."""

ANSWER, REPORT, WRONG_INPUT, NO_ROOM, FAILURE = range(5)
"""What a message from a child is."""


def _working_folder() -> str:
    """Return the folder where this process works, or nothing where that is gone."""
    try:
        return str(Path.cwd())
    except OSError:
        return ""


WORKING_FOLDER = _working_folder()
"""Where this process was started: it seldom works elsewhere before this import."""


class ChildError(RuntimeError):
    """A child ended before it answered, or its function failed; the text says how."""


class TimeLimitError(ChildError):
    """A child was ended as it took too long."""


@dataclass(frozen=True)
class Setup:
    """What a child is told first, in Python's own types.

    Attributes:
        parent: number of the parent's process.
        path: the parent's `sys.path`, without the folder where one works.
        function: "module:name" of what the child performs; or the function, of a copy.
        niceness: by how much the child gives way to others.
        memory: bytes of address space that it may have, where the system limits them.
    """

    parent: int
    path: list[str]
    function: str | Callable[..., Any]
    niceness: int
    memory: int | None


class Child(AbstractContextManager["Child", None]):
    """A process that performs one function, on one request after another; a context manager.

    It is ended where it was started, by the same thread: Linux ends a child with this thread.
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
            niceness: by how much it gives way to others.
            memory: bytes of address space that it may have.
            one_thread: libraries of a new process have one thread each.
            silent: what it prints is shown only if it fails; else on standard error.
            progress: called with what the function reports; the function has a further argument,
                `report`, to do so.
        """
        setup = Setup(os.getpid(), _search_path(), function, niceness, memory)
        self._progress = progress
        # without a name: none is left behind
        self._printed = tempfile.TemporaryFile() if silent else None  # noqa: SIM115
        errors = 2 if self._printed is None else self._printed.fileno()
        if callable(function):
            self._process: subprocess.Popen[bytes] | _Copy = _Copy(setup, errors)
        else:
            self._process = subprocess.Popen(
                [sys.executable, *_flags(), "-P", "-m", __name__],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                env={**os.environ, **(ONE_THREAD if one_thread else {})},
                start_new_session=True,  # Ctrl-C in a terminal is for the parent alone
            )
            self._write(vars(setup))

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self._process.poll() is None

    def request(self, *arguments: Any) -> None:
        """Let the function be called; the child works off requests in their order."""
        self._write((arguments, self._progress is not None))

    def answer(self, time_limit: float | None = None) -> Any:
        """Return what the function returns for the next request.

        Args:
            time_limit: s, after which the child is ended.

        Raises:
            InputError: the function says that the input is wrong, or a disk is full.
            TimeLimitError: it takes too long.
            ChildError: it raises another error, or the process ends.
        """
        with self._ended_after(time_limit) as expired:
            while True:
                try:
                    kind, value = pickle.loads(_read(self._stream("stdout")))
                except EOFError:
                    code = self._process.wait()
                    if expired.is_set():
                        raise TimeLimitError(f"stopped after {time_limit:g} s") from None
                    raise ChildError(f"{_how(code)}{self._said()}") from None
                if kind == REPORT and self._progress is not None:
                    self._progress(*value)
                elif kind == ANSWER:
                    return value
                elif kind in (WRONG_INPUT, NO_ROOM):
                    raise (InputError if kind == WRONG_INPUT else DiskFullError)(value)
                else:
                    raise ChildError(value)

    def kill(self) -> None:
        """Kill the process from another thread; one that waits for it gets `ChildError`."""
        self._process.kill()

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._printed):
            with contextlib.suppress(OSError):  # a request that it has not read
                if stream is not None:
                    stream.close()

    def __exit__(self, *_: object) -> None:
        self.end()

    def _stream(self, name: str) -> BinaryIO:
        stream: BinaryIO = getattr(self._process, name)
        return stream

    def _write(self, message: Any) -> None:
        with contextlib.suppress(BrokenPipeError):  # then there is no answer either
            _send(self._stream("stdin"), pickle.dumps(message))

    @contextmanager
    def _ended_after(self, time_limit: float | None) -> Iterator[threading.Event]:
        """End the process after a time, s; the event is set then."""
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
                self._process.wait()  # just done when it was killed: nothing more to ask of it

    def _said(self) -> str:
        """Return the end of what the child has printed in a line, after a colon; no traceback."""
        if self._printed is None:
            return ""
        size = self._printed.seek(0, os.SEEK_END)
        self._printed.seek(max(0, size - LAST_LETTERS))
        text = self._printed.read().decode(errors="replace").strip()
        if "Traceback (most recent call last)" in text:
            text = text.splitlines()[-1]
        return f": {' '.join(text.split())}" if text else ""


class _Copy:
    """A copy of this process, with what `Child` uses of `subprocess.Popen`."""

    def __init__(self, setup: Setup, errors: int) -> None:
        (requests, stdin), (stdout, answers) = os.pipe(), os.pipe()
        for stream in (sys.stdout, sys.stderr):
            stream.flush()  # else the copy writes it once more
        with warnings.catch_warnings():  # of threads: those of libraries wait for work
            warnings.simplefilter("ignore", DeprecationWarning)
            self.pid = os.fork()
        if self.pid == 0:
            os.close(stdin)
            os.close(stdout)
            _perform_in_copy(setup, requests, answers, errors)
        os.close(requests)
        os.close(answers)
        self.stdin, self.stdout = os.fdopen(stdin, "wb"), os.fdopen(stdout, "rb")
        self._code: int | None = None

    def poll(self) -> int | None:
        """Return the exit status, negative for a signal, or None as long as it runs."""
        return self._wait(os.WNOHANG)

    def wait(self) -> int:
        """Return the exit status once it has ended."""
        code = self._wait(0)
        assert code is not None
        return code

    def kill(self) -> None:
        """Kill it, if it has not ended."""
        if self._code is None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)

    def _wait(self, option: int) -> int | None:
        if self._code is None:
            try:
                ended, status = os.waitpid(self.pid, option)
                self._code = os.waitstatus_to_exitcode(status) if ended else None
            except ChildProcessError:  # a program that ignores its children's ends (SIGCHLD)
                self._code = 0
        return self._code


def may_copy() -> bool:
    """Return whether a copy of this process can go on by itself.

    It has this thread alone, so a lock that another one holds is never released in it; NGSolve has
    threads of its own.
    """
    return (
        sys.platform == "linux" and threading.active_count() == 1 and "ngsolve" not in sys.modules
    )


def _search_path() -> list[str]:
    """Return `sys.path` without the entry that `-c`, `-m` or a prompt sets for the working folder.

    Folders that the user has named stay: PYTHONPATH's, and that of his script.
    """
    path = [entry for entry in sys.path if entry]
    run_as_module = getattr(sys.modules.get("__main__"), "__spec__", None) is not None
    if run_as_module and not sys.flags.safe_path and WORKING_FOLDER in path:
        path.remove(WORKING_FOLDER)
    return path


def _flags() -> list[str]:
    """Return the options by which this process does without the user's environment and packages."""
    flags = {"-E": sys.flags.ignore_environment, "-s": sys.flags.no_user_site}
    return [option for option, is_set in flags.items() if is_set]


def _how(code: int) -> str:
    """Return how a process ended, in words."""
    if code >= 0:
        return f"exit status {code}"
    with contextlib.suppress(ValueError):
        return f"killed by {signal.Signals(-code).name}"
    return f"killed by signal {-code}"


def _send(stream: BinaryIO, message: bytes) -> None:
    stream.write(len(message).to_bytes(8) + message)
    stream.flush()


def _read(stream: BinaryIO) -> bytes:
    """Return the next message; raise EOFError where the other side has ended."""
    head = stream.read(8)
    message = stream.read(int.from_bytes(head)) if len(head) == 8 else b""
    if len(head) < 8 or len(message) < int.from_bytes(head):
        raise EOFError
    return message


def main() -> None:
    """Perform requests from standard input; answers go to what standard output was."""
    requests, answers = os.dup(0), os.dup(1)
    with Path(os.devnull).open("rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    os.dup2(2, 1)  # what a function prints is no answer
    stream = os.fdopen(requests, "rb")
    setup = Setup(**pickle.loads(_read(stream)))
    sys.path[:] = setup.path
    _perform(setup, stream, os.fdopen(answers, "wb"))


def _perform_in_copy(setup: Setup, requests: int, answers: int, errors: int) -> None:
    """Perform requests in a copy of this process; never returns."""
    code = 1
    try:
        for terminal in (1, 2):
            os.dup2(errors, terminal)
        sys.stdout = sys.stderr = os.fdopen(errors, "w", closefd=False)
        if hasattr(os, "setsid"):
            os.setsid()
        _perform(setup, os.fdopen(requests, "rb"), os.fdopen(answers, "wb"))
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else 1
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)  # nothing of the original is ended twice


def _perform(setup: Setup, requests: BinaryIO, answers: BinaryIO) -> None:
    """Perform requests until they close; answers wait in memory until they are read."""
    _end_with(setup.parent)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if setup.niceness and hasattr(os, "nice"):
        os.nice(setup.niceness)
    _limit(setup.memory)
    received: SimpleQueue[bytes] = SimpleQueue()
    ready: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_receive, args=(requests, received), daemon=True).start()
    threading.Thread(target=_hand_over, args=(answers, ready), daemon=True).start()

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
            if full := disk_full(error):
                answer = pickle.dumps((NO_ROOM, str(full)))
            elif isinstance(error, InputError):
                answer = pickle.dumps((WRONG_INPUT, str(error)))
            else:
                text = " ".join(str(error).partition("\n\nAt:")[0].split())  # no calls of Exudyn
                name = type(error).__name__
                missing = NOT_FOUND if isinstance(error, ModuleNotFoundError) else ""
                answer = pickle.dumps((FAILURE, f"{name}: {text}{missing}" if text else name))
        ready.put(answer)


def _receive(stream: BinaryIO, received: "SimpleQueue[bytes]") -> None:
    """Hand on requests; where they close, end this process, whatever it computes."""
    with contextlib.suppress(EOFError):
        while True:
            received.put(_read(stream))
    os._exit(1)


def _hand_over(stream: BinaryIO, ready: "SimpleQueue[bytes]") -> None:
    """Write answers as they come, while the next one is computed."""
    with contextlib.suppress(BrokenPipeError):  # the parent is gone
        while True:
            _send(stream, ready.get())


def _end_with(parent: int) -> None:
    """Let Linux kill this process when its parent ends: compiled code need not notice a pipe."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # it has ended before
            os._exit(1)


def _limit(memory: int | None) -> None:
    """Limit the address space of this process, bytes."""
    if memory is None:
        return
    with contextlib.suppress(ImportError, ValueError, OSError):  # a system without such limits
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


if __name__ == "__main__":
    main()
