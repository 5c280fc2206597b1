"""Runs in the process of the tests: a new process costs more than a short run."""

import gc
import json
import os
import warnings
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import AbstractContextManager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

from exu_press.errors import DiskFullError
from exu_press.parallel.task import Row, Task, row_of_task
from fe_models.lazy import named_object
from fe_models.processes import Child


class InProcess(AbstractContextManager["InProcess", None]):
    """Performs a task when it is handed over, as a worker does; in place of `Workers`."""

    window = 1

    def __init__(self, workers: int, time_limit: float | None) -> None:
        """Prepare; there is one worker, and nothing to stop a run over its time limit."""

    def submit(self, task: Task) -> Future[Row]:
        """Return the row, as JSON hands it over; what a worker prints no test captures."""
        future: Future[Row] = Future()
        with (
            Path(os.devnull).open("w") as nowhere,
            redirect_stdout(nowhere),
            redirect_stderr(nowhere),
            warnings.catch_warnings(action="ignore"),
        ):
            try:
                row = row_of_task(task)
            except DiskFullError as error:
                future.set_exception(error)
            else:
                future.set_result(json.loads(json.dumps(row, allow_nan=False)))
        return future

    def row(self, future: Future[Row]) -> Row:
        """Return the row of a future."""
        return future.result()

    def __exit__(self, *_: object) -> None:
        """There is nothing to end."""


class ChildInProcess:
    """Calls its function when an answer is asked for; in place of a new `Child`."""

    def __init__(self, function: str) -> None:
        """Prepare a function, "module:name"."""
        self._function = named_object(function)
        self._requests: list[tuple[Any, ...]] = []

    def request(self, *arguments: Any) -> None:
        """Keep the arguments of a call."""
        self._requests.append(arguments)

    def answer(self) -> Any:
        """Return the function's value for the next request."""
        try:
            return self._function(*self._requests.pop(0))
        finally:
            gc.enable()  # which a child's function disables for its process

    def kill(self) -> None:
        """There is nothing to end."""

    end = kill


def copy_or_stand_in(function: str | Callable[..., Any], **options: Any) -> Child | ChildInProcess:
    """Return a child that is a copy of this process, or its stand-in where none can be made."""
    return ChildInProcess(function) if isinstance(function, str) else Child(function, **options)
