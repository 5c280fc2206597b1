"""The scripts that print the tables of README and docs run, reduced, and end in numbers."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parents[2] / "scripts"


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["contact_restitution.py"], "(default)"),
        (["benchmark_modes.py", "--quick"], "ratio"),
        (["flexible_convergence.py", "--quick", "--out", "convergence"], "error 0.01"),
        (["flexible_parts.py", "--quick", "--out", "parts"], "flexible, second shapes"),
    ],
)
def test_script(arguments, expected, tmp_path):
    done = subprocess.run(
        [sys.executable, str(SCRIPTS / arguments[0]), *arguments[1:]],
        cwd=tmp_path, capture_output=True, text=True, timeout=200,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert expected in done.stdout
