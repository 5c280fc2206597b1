"""A worker process as its parent sees it: one task at a time, a time limit, and how it died."""

import contextlib
import json
import math
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.parallel.task import TIME_LIMIT, WORKER_DIED, Row, Task

__all__ = ["Child", "WorkerDiedError", "perform", "worker_died"]

ATTEMPTS = 2
"""Attempts at a task whose worker dies."""

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
"""Environment of a worker: one thread each, as there are as many processes as cores."""


class WorkerDiedError(Exception):
    """The process ended before it answered; the text says how."""


class Child(AbstractContextManager["Child", None]):
    """A process for the tasks of one function; a context manager that ends it."""

    def __init__(self, task: Task) -> None:
        """Start a process that can do `task` and others of its function.

        Raises:
            InputError: it cannot import the function, or has other versions than the task.
            WorkerDiedError: it ended at once.
        """
        paths = [path or str(Path.cwd()) for path in sys.path]
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "exu_press.parallel.worker", task.function, *task.modules],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(paths)},
            start_new_session=True,  # Ctrl-C in a terminal is for the parent alone
        )
        try:
            ready = self._read()
            if "error" in ready:
                names = ", ".join((task.function, *task.modules))
                raise InputError(f"{names}: a worker cannot import it ({ready['error']})")
            if ready["versions"] != dict(task.versions):
                raise InputError(
                    f"a worker has {ready['versions']}; allowed are the versions here, "
                    f"{dict(task.versions)}"
                )
        except BaseException:
            self.end()
            raise

    @property
    def alive(self) -> bool:
        """Return whether the process runs."""
        return self._process.poll() is None

    def perform(self, task: Task, time_limit: float | None) -> Row:
        """Return a task's row; over the time limit (s) the process is ended, and the row says so.

        Raises:
            WorkerDiedError: the process ended by itself or was killed.
        """
        expired = threading.Event()

        def stop() -> None:
            expired.set()
            self._process.kill()

        timer = threading.Timer(min(time_limit or math.inf, threading.TIMEOUT_MAX), stop)
        timer.daemon = True
        timer.start()
        try:
            assert self._process.stdin is not None
            with contextlib.suppress(BrokenPipeError):  # then there is no answer either
                self._process.stdin.write(task.arguments + "\n")
                self._process.stdin.flush()
            row = dict(self._read())
            if expired.is_set():
                self._process.wait()  # just done when it was killed: nothing more to ask of it
            return row
        except WorkerDiedError:
            if expired.is_set():
                return {"status": TIME_LIMIT, "reason": f"stopped after {time_limit:g} s"}
            raise
        finally:
            timer.cancel()

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            assert stream is not None
            with contextlib.suppress(OSError):  # a task it has not read
                stream.close()

    def kill(self) -> None:
        """Kill the process from another thread; a thread that waits gets WorkerDiedError."""
        self._process.kill()

    def _read(self) -> Any:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if line.endswith("\n"):
            return json.loads(line)
        code = self._process.wait()
        if code >= 0:
            raise WorkerDiedError(f"exit status {code}")
        with contextlib.suppress(ValueError):
            raise WorkerDiedError(f"killed by {signal.Signals(-code).name}")
        raise WorkerDiedError(f"killed by signal {-code}")

    def __exit__(self, *_: object) -> None:
        """End the process."""
        self.end()


def perform(task: Task, child: Callable[[], Child], time_limit: float | None) -> Row:
    """Return a task's row; if its worker dies it is tried once more.

    Args:
        task: to be done.
        child: returns a process to do it in, asked again for every attempt.
        time_limit: of an attempt, s.
    """
    reason = ""
    for _ in range(ATTEMPTS):
        try:
            return child().perform(task, time_limit)
        except WorkerDiedError as error:
            reason = str(error)
    return worker_died(f"{ATTEMPTS} times; the last: {reason}")


def worker_died(reason: str) -> Row:
    """Return the row of a task whose worker died whenever it was tried."""
    return {"status": WORKER_DIED, "reason": reason}
