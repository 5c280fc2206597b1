"""Runs of studies in the process of the tests: a worker process costs more than a short run."""

import json
import os
import warnings
from concurrent.futures import Future
from contextlib import AbstractContextManager, redirect_stderr, redirect_stdout
from importlib import import_module
from pathlib import Path

from exu_press.parallel.task import Row, Task, function_of
from exu_press.parallel.worker import row_of


class InProcess(AbstractContextManager["InProcess", None]):
    """Performs a task when it is handed over, as `worker` does; in place of `Processes`."""

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
            for module in task.modules:
                import_module(module)
            row = row_of(function_of(task.function), json.loads(task.arguments))
        future.set_result(json.loads(json.dumps(row, allow_nan=False)))
        return future

    def row(self, future: Future[Row]) -> Row:
        """Return the row of a future."""
        return future.result()

    def __exit__(self, *_: object) -> None:
        """There is nothing to end."""
