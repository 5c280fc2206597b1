"""Worker processes of a batch on this machine, each looked after by a thread."""

import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import AbstractContextManager

from exu_press.parallel.task import TIME_LIMIT, WORKER_DIED, Row, Task, row_of_task
from fe_models.processes import Child, ChildError, TimeLimitError

__all__ = ["Workers", "perform", "worker", "worker_died"]

ATTEMPTS = 2
"""Attempts at a task whose worker dies."""


class Workers(AbstractContextManager["Workers", None]):
    """Performs tasks in processes that stay alive from task to task; a dead one is replaced.

    Not a pool of Python's own: one killed worker breaks `concurrent.futures.ProcessPoolExecutor`,
    and `multiprocessing.Pool` waits for ever for its task. Workers share nothing that a killed one
    could keep locked.
    """

    def __init__(self, workers: int, time_limit: float | None) -> None:
        """Prepare; a process starts with its first task."""
        self.window = workers
        self._time_limit = time_limit
        self._threads = ThreadPoolExecutor(workers)
        self._own = threading.local()
        self._children: set[Child] = set()
        self._lock = threading.Lock()
        self._ended = False

    def submit(self, task: Task) -> Future[Row]:
        """Return the future row of a task."""
        return self._threads.submit(perform, task, self._child, self._time_limit)

    def row(self, future: Future[Row]) -> Row:
        """Return the row of a future that is done."""
        return future.result()

    def _child(self, task: Task) -> Child:
        """Return this thread's process, a new one if there is none alive."""
        child: Child | None = getattr(self._own, "child", None)
        if child is not None:
            if child.alive:
                return child
            child.end()
        started = self._own.child = worker(task)
        with self._lock:
            self._children.discard(child or started)
            self._children.add(started)
            if not self._ended:
                return started
        started.end()  # begun while __exit__ ended the others
        raise ChildError("the batch was stopped")

    def __exit__(self, *_: object) -> None:
        """End every process; tasks not begun are dropped."""
        with self._lock:
            self._ended = True
            for child in self._children:
                child.kill()
        self._threads.shutdown(cancel_futures=True)
        for child in self._children:
            child.end()


def worker(task: Task) -> Child:
    """Return a new process that can do a task; what it prints is on standard error.

    Raises:
        InputError: it cannot import the task's function, or has other versions.
        ChildError: it ended at once.
    """
    name = f"{row_of_task.__module__}:{row_of_task.__name__}"
    child = Child(name, one_thread=True, silent=False)
    try:
        child.request(task, True)
        child.answer()  # imports do not count for a time limit
    except BaseException:
        child.end()
        raise
    return child


def perform(task: Task, child: Callable[[Task], Child], time_limit: float | None) -> Row:
    """Return a task's row; if its worker dies it is tried once more."""
    reason = ""
    for _ in range(ATTEMPTS):
        try:
            process = child(task)
            process.request(task)
            row: Row = process.answer(time_limit)
            return row
        except TimeLimitError as error:
            return {"status": TIME_LIMIT, "reason": str(error)}
        except ChildError as error:
            reason = str(error)
    return worker_died(f"{ATTEMPTS} times; the last: {reason}")


def worker_died(reason: str) -> Row:
    """Return the row of a task whose worker died whenever it was tried."""
    return {"status": WORKER_DIED, "reason": reason}
