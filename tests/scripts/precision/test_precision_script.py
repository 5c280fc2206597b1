"""scripts/precision.py, in its reduced form and reduced further."""

import json
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[3] / "scripts" / "precision.py"


def run(*arguments):
    """Start the script as a user does."""
    words = [sys.executable, str(SCRIPT), "--quick", *arguments]
    return subprocess.run(words, capture_output=True, text=True, timeout=200)


def test_one_case_of_the_table(tmp_path):
    done = run("--quiet", "--case", "slider_crank_ideal", "--out", str(tmp_path))
    assert done.returncode == 0 and done.stdout == "", done.stderr
    report = json.loads((tmp_path / "precision.json").read_text())
    assert {row["case"] for row in report["rows"]} == {"slider_crank_ideal"}
    assert (tmp_path / "precision_slider_crank_ideal.png").stat().st_size > 10_000


def test_an_unknown_case_is_refused_in_one_line(tmp_path):
    refused = run("--case", "nothing", "--out", str(tmp_path / "out"))
    assert refused.returncode == 2
    assert "--case nothing" in refused.stderr and refused.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())
