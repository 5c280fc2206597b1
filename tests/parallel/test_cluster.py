"""A Dask cluster of worker processes on loopback, one of them killed."""

import os
import signal
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import batch_functions
import pytest

from exu_press import InputError
from exu_press.parallel import cluster as cluster_module
from exu_press.parallel import run_batch

distributed = pytest.importorskip("distributed")


@contextmanager
def local(workers, **more):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(Path(__file__).parent))
        at = {"host": "127.0.0.1", "protocol": "tcp", "dashboard_address": None}
        with distributed.LocalCluster(None, workers, 1, **at, **more) as made:
            yield made


@pytest.fixture(scope="module")
def cluster():
    """One for the tests of one worker, a thread, which the last of them closes."""
    with local(1, processes=False) as made:
        yield made


@pytest.fixture
def two():
    with local(2) as made:
        yield made


@pytest.mark.long
def test_one_of_two_workers_killed_midway(two, tmp_path):
    arguments = [{"x": x, "marks": str(tmp_path / "marks")} for x in range(6)]
    with distributed.Client(two.scheduler_address) as client:
        first, _ = client.run(os.getpid).values()

    def kill():
        while not (tmp_path / "marks").exists() or not (tmp_path / "marks").read_text():
            time.sleep(0.01)
        os.kill(first, signal.SIGKILL)
        killed.set()

    killed = threading.Event()
    threading.Thread(target=kill, daemon=True).start()
    rows = run_batch(
        batch_functions.slow_digits, arguments, tmp_path, dask=two.scheduler_address, quiet=True
    )
    assert killed.is_set()
    here = [batch_functions.digits(each) for each in arguments]
    assert rows == [{"status": "completed", "reason": "", **row} for row in here]


def test_what_goes_wrong_is_a_row(cluster, tmp_path):
    for function, options, status, reason in (
        (batch_functions.raises, {}, "failed", "ValueError: no number"),
        (batch_functions.dies, {}, "worker died", "2 times; the last: killed by SIGKILL"),
        (batch_functions.sleeps, {"time_limit": 0.3}, "time limit", "stopped after 0.3 s"),
    ):
        (row,) = run_batch(
            function,
            [{"seconds": 60.0}],
            tmp_path,
            dask=cluster.scheduler_address,
            quiet=True,
            **options,
        )
        assert row == {"status": status, "reason": reason}


def test_the_scheduler_goes_away(cluster, tmp_path):
    arguments = [{"x": x, "marks": str(tmp_path / "marks")} for x in range(200)]

    def close():
        rows = tmp_path / "runs.jsonl"
        while not (rows.exists() and rows.stat().st_size):
            time.sleep(0.01)
        cluster.close()

    closer = threading.Thread(target=close, daemon=True)
    closer.start()
    with pytest.raises(InputError, match="the scheduler is gone; finished runs are kept"):
        run_batch(
            batch_functions.slow_digits,
            arguments,
            tmp_path,
            dask=cluster.scheduler_address,
            quiet=True,
        )
    closer.join()  # two that close a cluster at once get into each other's way


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("127.0.0.1:8786", "allowed is the address of a scheduler"),
        ("tcp://127.0.0.1:port", "allowed is the address of a scheduler"),
        ("foo://x:1", "allowed is the address of a scheduler"),
        ("tcp://127.0.0.1:1", r"tcp://127\.0\.0\.1:1: no scheduler answers"),
    ],
)
def test_where_no_scheduler_is(address, message, tmp_path, monkeypatch):
    monkeypatch.setattr(cluster_module, "SECONDS_TO_ANSWER", 0.5)
    with pytest.raises(InputError, match=message):
        run_batch(batch_functions.digits, [{"x": 1}], tmp_path, dask=address, quiet=True)
