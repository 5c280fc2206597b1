"""Rows, their order, what becomes of runs that go wrong, memory, and chains of runs."""

import json
import os
import subprocess
import sys

import batch_functions
import pytest

from exu_press import InputError
from exu_press.parallel import Batch, run_batch


def batch(function, arguments, directory, **options):
    return run_batch(function, arguments, directory, **{"workers": 1, "quiet": True, **options})


EDITED = """
import sys; sys.path[:] = {path!r}
import edited
from exu_press.parallel import run_batch
print(run_batch(edited.function, [{{}}], "out", workers=1, quiet=True)[0]["value"])
"""


def test_edited_code_gives_new_rows(tmp_path):
    code = EDITED.format(path=[str(tmp_path), *sys.path])
    # workers would keep what they compile, as both edits are within a second
    plain = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    for value in (1, 2):
        (tmp_path / "edited.py").write_text(f"def function(_):\n    return {{'value': {value}}}\n")
        done = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=plain
        )
        assert done.stdout == f"{value}\n", done.stderr


def test_a_run_whose_file_is_gone_is_run_again(tmp_path):
    marks = str(tmp_path / "marks")
    arguments = [{"x": x, "marks": marks} for x in range(3)]
    for _ in range(2):
        batch(batch_functions.slow_digits, arguments, tmp_path, has_files=lambda run: run["x"] != 1)
    assert sorted(x for x, _ in batch_functions.marks(marks)) == [0, 1, 1, 2]


def test_what_a_run_gives_or_does_wrong_is_a_row(tmp_path, capfd):
    """In the order of the arguments, as strict JSON; nothing that a run prints is an answer."""
    functions = {
        "nothing_finite": ("completed", ""),
        "raises": ("failed", "ValueError: no number"),
        "no_json": ("failed", "TypeError: PosixPath in a file: allowed are"),
        "dies": ("worker died", "2 times; the last: killed by SIGKILL"),
        "exits": ("worker died", "2 times; the last: exit status 7"),
        "own_status": ("film broke down", "at 0.1 s"),
        "sleeps": ("time limit", "stopped after 2 s"),
        "prints": ("completed", ""),
        "threads": ("completed", ""),
    }
    arguments = [{"function": name, "seconds": 60.0} for name in functions]
    rows = batch(batch_functions.performs, arguments, tmp_path, time_limit=2.0)
    for row, (status, reason) in zip(rows, functions.values(), strict=True):
        assert row["status"] == status
        assert row["reason"].startswith(reason) and "\n" not in row["reason"]
    assert rows[0] == {
        "status": "completed", "reason": "", "nan": None, "list": [1.0, None],
        "inner": {"value": None}, "numpy": 0.1, "whole": 3, "array": [0.5, None],
    }  # fmt: skip
    assert "NaN" not in (tmp_path / "runs.jsonl").read_text()
    assert rows[-2] == {"status": "completed", "reason": "", "x": 1}
    assert (rows[-1]["omp"], rows[-1]["blas"]) == ("1", "1")
    assert capfd.readouterr().out == ""


def test_a_run_whose_worker_dies_is_tried_once_more(tmp_path):
    arguments = [{"x": x, "mark": str(tmp_path / "mark")} for x in range(3)]
    rows = batch(batch_functions.dies_once, arguments, tmp_path)
    assert [row["x"] for row in rows] == list(range(3))


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"workers": 0}, "workers = 0"),
        ({"workers": 10**30}, "workers = 1000"),
        ({"time_limit": 0.0}, "time_limit = 0"),
        ({"time_limit": float("nan")}, "time_limit = nan"),
    ],
)
def test_wrong_options_are_refused(options, named, tmp_path):
    with pytest.raises(InputError, match=named):
        batch(batch_functions.digits, [{"x": 1}], tmp_path / "new", **options)
    assert not list(tmp_path.iterdir())


def test_a_worker_of_other_versions_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("exu_press.parallel.run.versions", lambda function: {"exudyn": "0.0"})
    with pytest.raises(InputError, match=r"a worker has exudyn .*, not 0\.0; allowed are the"):
        batch(batch_functions.digits, [{"x": 1}], tmp_path)


THOUSAND = """
import resource, batch_functions
from exu_press.parallel import run_batch
def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
arguments = [{{"x": x}} for x in range(1000)]
run_batch(batch_functions.memory, arguments[:100], r"{0}", workers=2, quiet=True)
before = peak()
rows = run_batch(batch_functions.memory, arguments, r"{0}", workers=2, quiet=True)
print(before, peak(), *(row["megabytes"] for row in rows))
"""


@pytest.mark.long
def test_a_thousand_runs_hold_memory_flat(tmp_path):
    code = f"import sys; sys.path[:] = {sys.path!r}\n" + THOUSAND.format(tmp_path)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    before, after, *workers = map(float, done.stdout.split())
    assert after - before < 10.0  # MB; the rows themselves are one of them
    assert max(workers) - min(workers) < 5.0
    lines = (tmp_path / "runs.jsonl").read_text().splitlines()
    assert len({json.loads(line)["key"] for line in lines}) == len(lines) == 1000


def sums(path, rows, waiting=()):
    """A chain: each run is told the sum of those before; the named ones wait for a file."""
    before = 0
    for x in range(4):
        more = waiting[x] if x < len(waiting) else {}
        row = yield {"x": x, "before": before, "marks": str(path), **more}
        before = row["sum"]
        rows.append(before)


def test_a_slow_run_of_one_chain_does_not_keep_another_one(tmp_path):
    """The first run of the one ends only when all runs of the other are done."""
    slow, fast = [], []
    until_all = {"file": str(tmp_path / "fast"), "lines": 4}
    with Batch(batch_functions.waits, tmp_path, workers=2, quiet=True) as batch:
        chains = [sums(tmp_path / "slow", slow, [until_all]), sums(tmp_path / "fast", fast)]
        batch.follow(chains, 8)
    assert slow == fast == [0, 1, 3, 6]


def test_what_two_chains_ask_for_at_once_is_run_once(tmp_path):
    one, other = [], []
    with Batch(batch_functions.waits, tmp_path, workers=2, quiet=True) as batch:
        batch.follow([sums(tmp_path / "marks", rows) for rows in (one, other)], 8)
    assert one == other == [0, 1, 3, 6]
    assert len(batch_functions.marks(tmp_path / "marks")) == 4
