"""Workers of a Dask cluster."""

import contextlib
from concurrent.futures import CancelledError, Future
from contextlib import AbstractContextManager
from urllib.parse import urlsplit

from exu_press.errors import DiskFullError, InputError, required_package
from exu_press.parallel.task import Row, Task
from exu_press.parallel.workers import perform, worker, worker_died

__all__ = ["Cluster", "perform_alone"]

SCHEMES = ("tcp", "tls", "ws", "wss", "ucx")
SECONDS_TO_ANSWER = 10.0
TASKS_AHEAD = 4
"""Tasks submitted for each thread of the cluster, so that none waits for the network."""


class Cluster(AbstractContextManager["Cluster", None]):
    """Performs tasks on a running Dask cluster."""

    def __init__(self, address: str, time_limit: float | None) -> None:
        """Connect.

        Raises:
            InputError: no address, no scheduler or no worker there, or distributed not installed.
        """
        self._address, self._time_limit = address, time_limit
        _check(address)
        distributed = required_package("distributed", f"dask = {address}", "'exu-press[dask]'")
        try:
            self._client = distributed.Client(
                address, timeout=SECONDS_TO_ANSWER, set_as_default=False
            )
        except OSError as error:
            raise InputError(
                f"dask = {address}: no scheduler answers ({_in_a_line(error)})"
            ) from None
        try:
            self._client.wait_for_workers(1, timeout=SECONDS_TO_ANSWER)
        except TimeoutError:
            self._client.close()
            raise InputError(
                f"dask = {address}: the scheduler has no workers; `dask worker {address}` "
                "starts one"
            ) from None
        except OSError:
            self._client.close()
            raise self._scheduler_lost() from None
        self._executor = self._client.get_executor(pure=False)
        self.window = TASKS_AHEAD * sum(self._client.nthreads().values())

    def submit(self, task: Task) -> Future[Row]:
        """Return the future row of a task."""
        future: Future[Row] = self._executor.submit(perform_alone, task, self._time_limit)
        return future

    def row(self, future: Future[Row]) -> Row:
        """Return the row of a future that is done.

        Raises:
            InputError: the scheduler is gone, or its workers cannot perform the task.
        """
        from distributed import KilledWorker

        try:
            return future.result()
        except KilledWorker as error:
            return worker_died(f"with every Dask worker it was given to: {_in_a_line(error)}")
        except CancelledError:
            raise self._scheduler_lost() from None
        except DiskFullError:
            raise
        except Exception as error:
            raise InputError(
                f"dask = {self._address}: its workers cannot do this ({_in_a_line(error)}); they "
                "need the packages that are installed here"
            ) from None

    def _scheduler_lost(self) -> InputError:
        return InputError(
            f"dask = {self._address}: the scheduler is gone; finished runs are kept, and the same "
            "call goes on with them"
        )

    def __exit__(self, *_: object) -> None:
        """Cancel the tasks that have not begun, and leave the cluster running."""
        self._executor.shutdown(wait=False)
        self._client.close()


def perform_alone(task: Task, time_limit: float | None) -> Row:
    """Return a task's row from a process of its own, on a Dask worker.

    So the time limit holds, a crash spares the Dask worker, and its threads share no Exudyn.
    """
    with contextlib.ExitStack() as processes:
        return perform(task, lambda task: processes.enter_context(worker(task)), time_limit)


def _check(address: str) -> None:
    """Raise InputError unless this is an address."""
    parts = urlsplit(address)
    with contextlib.suppress(ValueError):  # a port that is no number
        if parts.scheme in SCHEMES and parts.hostname and parts.port:
            return
    raise InputError(
        f"dask = {address}: allowed is the address of a scheduler, as in tcp://host:8786"
    )


def _in_a_line(error: Exception) -> str:
    return " ".join(str(error).split()) or type(error).__name__
