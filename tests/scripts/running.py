"""Runs a script as a user does, in its reduced form."""

import subprocess
import sys
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"


def process(name, place, *options, quick=True):
    """Run a script in a directory to its end."""
    return subprocess.run(
        [sys.executable, str(SCRIPTS / name), *["--quick"] * quick, *options],
        cwd=place,
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )


def run(name, place, *options, quick=True):
    """Return what a script printed that did its work."""
    done = process(name, place, *options, quick=quick)
    assert done.returncode == 0, done.stderr
    return done.stdout


def assert_refused(name, place, *options, named):
    """A script refuses its options in one line that names what is wrong, and runs nothing."""
    refused = process(name, place, *options)
    assert refused.returncode == 2
    assert named in refused.stderr and refused.stderr.count("\n") == 1
    assert not list(place.rglob("*.json*"))
