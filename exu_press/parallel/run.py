"""Batches of runs: finished rows are read, the others run, each saved as it finishes."""

import os
import sys
from collections import deque
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path
from typing import Any, Protocol, Self

from exu_press.errors import DiskFullError, InputError
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import output_directory
from exu_press.parallel.rows import RowFile
from exu_press.parallel.task import TIME_LIMIT, Function, Row, Task, name_of, task_of, versions
from exu_press.parallel.workers import Workers
from exu_press.terminal.progress import Progress

__all__ = ["FILE", "Batch", "Chain", "run_batch"]

FILE = "runs.jsonl"

MOST_WORKERS = 1024


Chain = Generator[Mapping[str, Any], Row, None]
"""Runs that depend on each other: yields the arguments of one, and is sent its row."""


class Pool(Protocol):
    """A performer of tasks.

    Attributes:
        window: number of tasks that are submitted at a time.
    """

    window: int

    def submit(self, task: Task) -> Future[Row]:
        """Return the future row of a task."""
        ...

    def row(self, future: Future[Row]) -> Row:
        """Return the row of a future that is done."""
        ...


class Batch(ExitStack):
    """Runs of one function in one directory, which resume after a stop or a kill.

    Finished rows are appended to directory/runs.jsonl, each on the disk before the next one. Every
    row has a `status` and a `reason` in one line. The status of a run without a result is "failed"
    (an exception), "time limit" or "worker died" (killed or crashed twice).
    """

    def __init__(
        self,
        function: Function,
        directory: str | Path,
        *,
        workers: int | None = None,
        dask: str | None = None,
        time_limit: float | None = None,
        has_files: Callable[[Mapping[str, Any]], bool] | None = None,
        modules: Sequence[str] = (),
        label: str = "sweep",
        quiet: bool = False,
    ) -> None:
        """Prepare; a process starts with the first run that is not finished yet.

        Args:
            function: takes and returns a JSON-able dictionary; it stands at the top level of a
                module, from where workers import it. NaN and infinity become None.
            directory: belongs to one batch at a time.
            workers: number of processes, each with one BLAS thread; all cores by default.
            dask: address of a Dask scheduler, tcp://host:port, whose workers are used instead.
            time_limit: of one run, s; a run over it is stopped.
            has_files: arguments of a run -> whether the files that it wrote still exist; a run
                without them is repeated.
            modules: that a worker imports first, for their declarations.

        Raises:
            InputError: the number of workers or the time limit is not positive.
            ValueError: the function cannot be imported.
        """
        super().__init__()
        if workers is not None and not 1 <= workers <= MOST_WORKERS:
            raise InputError(
                f"workers = {workers}: allowed is a whole number within 1 and {MOST_WORKERS}"
            )
        if time_limit is not None and not time_limit > 0.0:
            raise InputError(f"time_limit = {time_limit:g}: allowed is a number > 0 (s)")
        self._name, self._modules = name_of(function), tuple(modules)
        self._versions = versions(self._name, *self._modules)
        self.directory = Path(directory)
        self._workers, self._dask, self._limit = workers or os.cpu_count() or 1, dask, time_limit
        self._has_files, self._label, self._quiet = has_files, label, quiet
        self._pool: Pool | None = None

    def __enter__(self) -> Self:
        """Lock the directory and read the finished rows.

        Raises:
            InputError: `directory` cannot be used, or another batch is at work in it.
        """
        super().__enter__()
        try:
            output_directory(self.directory)
            self.enter_context(lock_directory(self.directory))
            self._file = self.enter_context(RowFile(self.directory / FILE))
            if self._file.count and not self._quiet:
                print(f"{self._label}: runs that are finished: {self._file.count}", file=sys.stderr)
        except BaseException:
            self.close()
            raise
        return self

    def rows(self, arguments: Sequence[Mapping[str, Any]]) -> list[Row]:
        """Return the function's row for each of the arguments, in their order.

        Args:
            arguments: one dictionary a run; equal ones are run once.

        Raises:
            InputError: no scheduler answers, or a row cannot be written.
            ValueError, TypeError: the arguments are no JSON.
            KeyboardInterrupt: after Ctrl-C; finished rows are kept.
        """
        tasks = [self._task(run) for run in arguments]
        arguments_of = {task.key: run for task, run in zip(tasks, arguments, strict=True)}
        rows = {task.key: self._finished_row(task, arguments_of[task.key]) for task in tasks}
        missing = [key for key, row in rows.items() if row is None]

        def alone(key: str) -> Chain:
            rows[key] = yield arguments_of[key]

        if missing:
            self.follow([alone(key) for key in missing], len(missing))
        return [dict(rows[task.key] or {}) for task in tasks]

    def follow(self, chains: Sequence[Chain], total: int) -> None:
        """Do the runs of chains: each one in its order, all chains beside each other.

        Only as many runs as the pool's window are under way at a time, and another one begins when
        rows are stored: so many at most are lost with the caller.

        Raises:
            DiskFullError: there is no room for a row or for what its run writes; no other run
                begins then, and those under way come to their end.
            As `rows` does.
        """
        under_way: dict[str, tuple[Future[Row], Task, list[Chain]]] = {}
        ready: deque[tuple[Chain, Row | None]] = deque((chain, None) for chain in chains)
        done = failed = 0
        full: DiskFullError | None = None

        def begin(chain: Chain, row: Row | None) -> None:
            """Submit the next run of a chain that is not finished yet."""
            nonlocal done
            try:
                while True:
                    arguments = next(chain) if row is None else chain.send(dict(row))
                    task = self._task(arguments)
                    row = self._finished_row(task, arguments)
                    if row is None:
                        break
                    done += 1
            except StopIteration:
                return
            if task.key not in under_way:
                under_way[task.key] = self._started_pool().submit(task), task, []
            under_way[task.key][2].append(chain)

        with Progress(self._label, total, "runs", quiet=self._quiet) as progress:
            while ready or under_way:
                while ready and (self._pool is None or len(under_way) < self._pool.window):
                    begin(*ready.popleft())
                wait([future for future, _, _ in under_way.values()], return_when=FIRST_COMPLETED)
                ended = [key for key, (future, _, _) in under_way.items() if future.done()]
                for future, task, waiting in [under_way.pop(key) for key in ended]:
                    try:
                        row = self._started_pool().row(future)
                        self._file.append(task.key, self._limit, row)
                    except DiskFullError as error:
                        full, failed = error, failed + 1
                        continue
                    done += len(waiting)
                    progress.update(done)
                    ready += [(chain, row) for chain in waiting]
                if full is not None:
                    ready.clear()
        if full is not None:
            raise DiskFullError(
                f"{full}: {failed} of {total} runs failed, {done} are finished and kept, others "
                "were not begun; with room on the disk the same command goes on"
            )

    def _task(self, arguments: Mapping[str, Any]) -> Task:
        return task_of(self._name, arguments, self._modules, self._versions)

    def _finished_row(self, task: Task, arguments: Mapping[str, Any]) -> Row | None:
        """Return the row of a run that need not be repeated, or None."""
        row = self._file.finished_row(task.key, self._limit)
        if (
            row
            and row["status"] != TIME_LIMIT
            and self._has_files
            and not self._has_files(arguments)
        ):
            return None
        return row

    def _started_pool(self) -> Pool:
        if self._pool is None:
            self._pool = self.enter_context(_pool(self._workers, self._dask, self._limit))
        return self._pool


def run_batch(
    function: Function,
    arguments: Sequence[Mapping[str, Any]],
    directory: str | Path,
    **options: Any,
) -> list[Row]:
    """Return the rows of one call: `Batch` with these options, and its `rows`."""
    with Batch(function, directory, **options) as batch:
        return batch.rows(arguments)


def _pool(
    workers: int, dask: str | None, time_limit: float | None
) -> AbstractContextManager[Pool, None]:
    """Return workers of this machine, or of a Dask cluster."""
    if dask is None:
        return Workers(workers, time_limit)
    from exu_press.parallel.cluster import Cluster

    return Cluster(dask, time_limit)
