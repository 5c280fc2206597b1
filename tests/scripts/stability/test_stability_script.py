"""scripts/stability.py: exit status, files and what it prints."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "scripts" / "stability.py"


def run(*arguments):
    """Start the script as a user does."""
    words = [sys.executable, str(SCRIPT), "--quick", *arguments]
    return subprocess.run(words, capture_output=True, text=True, timeout=200)


def test_one_axis_of_the_sample(tmp_path):
    done = run("--axis", "bearing length", "--workers", "1", "--out", str(tmp_path))
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "stability.json").read_text())
    assert report["counts"] == {"right": 4, "stopped": 0, "wrong": 0}
    assert report["cases"][0]["parameters"]["film"]["length"] == 0.0141
    assert (tmp_path / "stability.png").stat().st_size > 10_000
    assert "4 cases: 4 right, 0 stopped with a reason" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "named"),
    [(["--axis", "nothing"], "--axis nothing"), (["--workers", "0"], "workers = 0")],
)
def test_wrong_input_is_refused_in_one_line(arguments, named, tmp_path):
    refused = run(*arguments, "--out", str(tmp_path / "out"))
    assert refused.returncode == 2
    assert named in refused.stderr and refused.stderr.count("\n") == 1
