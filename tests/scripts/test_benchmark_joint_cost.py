"""The benchmark of the joints' cost runs and prints its table; times are not tested."""

import pytest
from running import run

ROWS = [
    "press, ideal joints",
    "press, lubricated pin, dry balls",
    "press, dry pin, dry balls",
    "chain, ideal joints",
    "chain, ten lubricated joints",
    "chain, user functions",
]


@pytest.mark.long
def test_quick_table(tmp_path):
    head, *lines = run("benchmark_joint_cost.py", tmp_path).splitlines()
    assert head[:34].strip() in ("joints compiled", "joints in Python")
    assert head[34:].split() == ["us/step", "Newton/step", "ratio"]
    table = {line[:34].strip(): [float(word) for word in line[34:].split()] for line in lines}
    assert list(table) == ROWS
    for name, (per_step, iterations, ratio) in table.items():
        assert per_step > 0.0 and iterations >= 1.0 and ratio > 0.0, name
        assert "ideal" not in name or ratio == 1.0
