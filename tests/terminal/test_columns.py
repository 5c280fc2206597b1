"""Columns stand under each other."""

import pytest

from exu_press.terminal.columns import columns


def test_columns_are_as_wide_as_their_longest_cell():
    assert columns([("a", "bcd", "e"), ("fgh", "i", "")]) == ["a    bcd  e", "fgh  i"]


def test_lines_may_be_indented():
    assert columns([("a", "b")], 2) == ["  a  b"]


def test_rows_have_equally_many_cells():
    with pytest.raises(ValueError):
        columns([("a", "b"), ("c",)])


def test_columns_of_numbers_end_under_each_other():
    rows = [("axis", "cases"), ("speed", "7"), ("film", "123456")]
    assert columns(rows, right=True) == ["axis    cases", "speed       7", "film   123456"]
