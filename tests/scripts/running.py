"""Runs a script as a user does, in its reduced form."""

import subprocess
import sys
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"


def run(name, place, *options, quick=True):
    """Return what a script printed that ran in a directory."""
    done = subprocess.run(
        [sys.executable, str(SCRIPTS / name), *["--quick"] * quick, *options],
        cwd=place,
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
