"""How far a long job is, and columns in a terminal."""

import io
import re
import threading

import pytest

from exu_press.terminal.columns import columns
from exu_press.terminal.progress import Progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_part_goes_on_from_where_the_whole_is():
    """A run of many blocks shows one bar, and says how long all of them take.

    It starts no thread: a process with threads cannot be copied for refinement runs.
    """
    stream, before = Terminal(), threading.active_count()
    with Progress("run", 4.0, whole=True, stream=stream) as whole:
        whole.update(1.0)
        with Progress("run", 2.0, stream=stream) as part:
            part.update(1.0)
            assert part.time_left(1.0) == pytest.approx(whole.time_left(2.0), rel=0.5)
            part.update(2.0)
        assert threading.active_count() == before
    assert " 75 %" in stream.getvalue().rpartition("\r")[2]
    with Progress("compare", 15, "runs", stream=stream) as other:
        other.update(0.0724)
        assert re.search(r" 0 %\|.*\| of 15 runs, .* left", stream.getvalue())
        other.update(15)
    assert "100 %" in stream.getvalue().rpartition("\r")[2]


def test_columns_of_numbers_end_under_each_other():
    rows = [("axis", "cases"), ("speed", "7"), ("film", "123456")]
    table = ["axis    cases", "speed       7", "film   123456"]
    assert columns(rows, right=True) == table
    heading = ("a wider heading", "")
    assert columns([*rows, heading], right=True) == [*table, heading[0]]
