"""kill -9 of parents and of workers, Ctrl-C, two parents: nothing finished is lost."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import batch_functions
import pytest
from waiting import alive, until

from exu_press import InputError
from exu_press.parallel import run_batch

RUNS = 24

PARENT = """
import sys; sys.path[:] = {path!r}
import batch_functions
from exu_press.parallel import run_batch
run_batch(batch_functions.{function}, {arguments!r}, {directory!r}, workers=2, quiet=True)
"""


def parent(function, arguments, directory):
    """Return the process of a batch of its own."""
    code = PARENT.format(
        path=sys.path, function=function, arguments=arguments, directory=str(directory)
    )
    return subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)


def lines(directory):
    path = directory / "runs.jsonl"
    return path.read_bytes().count(b"\n") if path.exists() else 0


@pytest.fixture
def arguments(tmp_path):
    return [{"x": x, "marks": str(tmp_path / "marks")} for x in range(RUNS)]


@pytest.fixture
def undisturbed(arguments, tmp_path):
    rows = [batch_functions.digits(each) for each in arguments]
    return [{"status": "completed", "reason": "", **row} for row in rows]


def go_on(arguments, directory):
    return run_batch(batch_functions.slow_digits, arguments, directory, workers=2, quiet=True)


def test_a_killed_parent_loses_only_what_was_under_way(arguments, undisturbed, tmp_path):
    """Killed twice, then left alone: the same rows bit by bit, no orphans, nobody locked out."""
    for enough in (5, 12):
        process = parent("slow_digits", arguments, tmp_path)
        until(lambda enough=enough: lines(tmp_path) >= enough)
        process.kill()
        process.communicate()
    calls = batch_functions.marks(tmp_path / "marks")
    until(lambda: not any(alive(worker) for _, worker in calls), seconds=5.0)
    assert lines(tmp_path) < RUNS
    assert go_on(arguments, tmp_path) == undisturbed
    calls = batch_functions.marks(tmp_path / "marks")
    assert RUNS <= len(calls) <= RUNS + 2 * 2  # two workers, two kills


def test_a_folder_belongs_to_one_parent_and_orphans_end_in_the_middle_of_a_run(tmp_path):
    process = parent("sleeps", [{"seconds": 600.0}], tmp_path)
    until(lambda: children(process.pid))
    time.sleep(0.5)  # it sleeps, deaf to SIGTERM
    (worker,) = children(process.pid)
    with pytest.raises(InputError, match="another run is writing here"):
        go_on([], tmp_path)
    process.kill()
    process.communicate()
    until(lambda: not alive(worker), seconds=5.0)


def children(process):
    """Return the numbers of a process's children, whichever of its threads started them."""
    files = Path(f"/proc/{process}/task").glob("*/children")
    return [int(word) for file in files for word in file.read_text().split()]


def test_ctrl_c_ends_the_workers_and_keeps_rows(arguments, undisturbed, tmp_path):
    process = parent("slow_digits", arguments, tmp_path)
    until(lambda: lines(tmp_path) >= 4)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=10)
    assert errors.strip().endswith("KeyboardInterrupt")
    calls = batch_functions.marks(tmp_path / "marks")
    assert not any(alive(worker) for _, worker in calls)
    assert 4 <= lines(tmp_path) < RUNS
    assert go_on(arguments, tmp_path) == undisturbed
