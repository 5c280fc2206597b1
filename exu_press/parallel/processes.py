"""Worker processes on this machine: as many threads as workers, each looking after one process."""

import threading
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import AbstractContextManager

from exu_press.parallel.child import Child, WorkerDiedError, perform
from exu_press.parallel.task import Row, Task

__all__ = ["Processes"]


class Processes(AbstractContextManager["Processes", None]):
    """Performs tasks in processes that stay alive from task to task; a dead one is replaced.

    Python's own pools of processes are of no use here: one killed worker breaks the whole of
    `concurrent.futures.ProcessPoolExecutor`, and `multiprocessing.Pool` waits for ever for its
    task. Here nothing is shared between workers that a killed one could keep locked.
    """

    def __init__(self, workers: int, time_limit: float | None) -> None:
        """Prepare; a process starts with its first task.

        Args:
            workers: number of processes.
            time_limit: of a task, s.
        """
        self.window = workers
        self._time_limit = time_limit
        self._threads = ThreadPoolExecutor(workers)
        self._own = threading.local()
        self._children: set[Child] = set()
        self._lock = threading.Lock()
        self._ended = False

    def submit(self, task: Task) -> Future[Row]:
        """Return the future row of a task."""
        return self._threads.submit(perform, task, lambda: self._child(task), self._time_limit)

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
        started = self._own.child = Child(task)
        with self._lock:
            self._children.discard(child or started)
            self._children.add(started)
            if not self._ended:
                return started
        started.end()  # begun while __exit__ ended the others
        raise WorkerDiedError("the batch was stopped")

    def __exit__(self, *_: object) -> None:
        """End every process; tasks not begun are dropped."""
        with self._lock:
            self._ended = True
            for child in self._children:
                child.kill()
        self._threads.shutdown(cancel_futures=True)
        for child in self._children:
            child.end()
