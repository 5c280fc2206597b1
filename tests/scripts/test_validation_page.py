"""The tables of docs/validation.md: what a test compares, and what the script makes of it."""

import pytest
from running import run

from validation import merged, page_lines

ROW = {
    "kind": "table",
    "subject": "bearing",
    "source": "its author",
    "licence": "printed numbers",
    "remark": "",
    "quantity": "load",
    "unit": "N",
    "theirs": 100.0,
    "ours": 101.0,
    "error": 0.5,
    "deviation": 0.01,
    "allowed": 0.02,
    "is_relative": True,
    "count": 3,
    "test": "tests/test_a.py::test_a",
}


@pytest.mark.long
def test_a_test_hands_its_numbers_to_the_page(tmp_path):
    printed = run("validation.py", tmp_path, "tests/laws/test_contact_stiffness.py", quick=False)
    (row,) = [line for line in printed.splitlines() if line.startswith("| stiffness of a pin")]
    assert "stiffness, kN/um (3 values)" in row and "exact" in row
    assert "`tests/laws/test_contact_stiffness.py::test_cylindrical_slope" in printed


def test_a_quantity_of_several_tests_is_one_row_with_the_worst_of_them():
    worse = {**ROW, "ours": 98.0, "deviation": -0.02, "count": 2, "test": "tests/test_b.py::test_b"}
    (row,) = merged([ROW, worse])
    assert (row["ours"], row["count"]) == (98.0, 5)
    lines = page_lines([ROW, worse])
    cells = [cell.strip() for cell in lines[4].strip("|").split("|")]
    assert cells == ["bearing [1]", "load, N (5 values)", "100", "98.00 +- 0.50", "-2 %", "2 %"]
    assert lines[-1].endswith(": `tests/test_a.py::test_a`, `tests/test_b.py::test_b`.")
