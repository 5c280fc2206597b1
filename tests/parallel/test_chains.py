"""Runs that depend on each other: chains beside each other, none of which waits for another."""

import batch_functions

from exu_press.parallel import Batch


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


def test_finished_runs_of_a_chain_are_read(tmp_path):
    for _ in range(2):
        rows = []
        with Batch(batch_functions.waits, tmp_path, workers=1, quiet=True) as batch:
            batch.follow([sums(tmp_path / "marks", rows)], 4)
        assert rows == [0, 1, 3, 6]
    assert len(batch_functions.marks(tmp_path / "marks")) == 4


def test_what_two_chains_ask_for_at_once_is_run_once(tmp_path):
    one, other = [], []
    with Batch(batch_functions.waits, tmp_path, workers=2, quiet=True) as batch:
        batch.follow([sums(tmp_path / "marks", rows) for rows in (one, other)], 8)
    assert one == other == [0, 1, 3, 6]
    assert len(batch_functions.marks(tmp_path / "marks")) == 4
