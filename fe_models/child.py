"""A child process from inside: messages of its pipes, and the loop that answers requests.

Requests and answers are pickles, each after its length. A child ends with its parent, whatever ends
that: Linux kills it, and on any system it ends itself when its requests close.
"""

import contextlib
import ctypes
import gc
import os
import pickle
import signal
import stat
import sys
import threading
import traceback
from collections.abc import Callable
from pathlib import Path
from queue import SimpleQueue
from typing import Any, BinaryIO, NamedTuple

from fe_models.errors import DiskFullError, InputError, disk_full
from fe_models.lazy import named_object

__all__ = [
    "ANSWER",
    "DESCRIPTORS",
    "ERRORS",
    "OF_PIPES",
    "REPORT",
    "Setup",
    "read",
    "run_copy",
    "send",
]

PR_SET_PDEATHSIG = 1
"""Of prctl(2): the signal that a process gets when its parent ends."""

NOT_FOUND = " (a child does not search the folder where one works; PYTHONPATH names others)"
"""Cure of a module that is not found."""

ANSWER, REPORT, WRONG_INPUT, NO_ROOM, FAILURE = range(5)
"""Kinds of a child's messages."""

ERRORS = {WRONG_INPUT: InputError, NO_ROOM: DiskFullError}
"""Kind of a message about an error that the parent raises likewise."""

OF_PIPES = "pipe of a child"
"""Name of a child's threads that read requests and write answers."""

DESCRIPTORS = "/proc/self/fd"
"""Linux's folder of the files and pipes that a process has open."""


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


def send(stream: Any, message: bytes) -> None:
    """Write a message after its length."""
    stream.write(len(message).to_bytes(8) + message)
    stream.flush()


def read(stream: Any) -> bytes:
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


def run_copy(setup: Setup) -> None:
    """Perform requests in a copy of this process; never returns."""
    code = 1
    try:
        gc.freeze()  # of the parent's objects nothing is freed, and few pages are copied
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
    for serve, of_pipe in ((_receive, (requests, received)), (_deliver, (answers, ready))):
        threading.Thread(target=serve, args=of_pipe, name=OF_PIPES, daemon=True).start()

    def report(*values: Any) -> None:
        ready.put(pickle.dumps((REPORT, values)))

    while True:
        request = received.get()
        try:
            arguments, reports = pickle.loads(request)
            function: Any = setup.function
            if isinstance(function, str):
                function = named_object(function)
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
            received.put(read(stream))
    os._exit(1)


def _deliver(stream: BinaryIO, ready: "SimpleQueue[bytes]") -> None:
    """Write answers as they come, while the next one is computed."""
    with contextlib.suppress(BrokenPipeError):  # the parent is gone
        while True:
            send(stream, ready.get())


if __name__ == "__main__":
    pipes = _open_pipes()
    setup = Setup(*pickle.loads(read(pipes[0])))
    sys.path[:] = setup.path
    _perform(setup, *pipes)
