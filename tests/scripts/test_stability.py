"""scripts/stability.py: exit status, files and what it prints."""

import json

import pytest
from running import assert_refused, run


@pytest.mark.long
def test_one_axis_of_the_sample(tmp_path):
    options = ["--axis", "bearing length", "--workers", "1", "--out", str(tmp_path)]
    assert "4 cases: 4 right, 0 stopped with a reason" in run("stability.py", tmp_path, *options)
    report = json.loads((tmp_path / "stability.json").read_text())
    assert report["counts"] == {"right": 4, "stopped": 0, "wrong": 0}
    assert report["cases"][0]["parameters"]["film"]["length"] == 0.0141
    assert (tmp_path / "stability.png").stat().st_size > 10_000


@pytest.mark.parametrize(("option", "value"), [("axis", "nothing"), ("workers", "0")])
def test_wrong_input_is_refused(option, value, tmp_path):
    named = f"--axis {value}" if option == "axis" else "workers = 0"
    assert_refused("stability.py", tmp_path, f"--{option}", value, named=named)
