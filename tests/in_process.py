"""Runs of studies in the process of the tests: a worker process costs more than a short run."""

import json
import os
import warnings
from concurrent.futures import Future
from contextlib import AbstractContextManager, redirect_stderr, redirect_stdout
from pathlib import Path

from exu_press.errors import DiskFullError
from exu_press.parallel.task import Row, Task, row_of_task


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
