"""Runs a script as a user does, in its reduced form."""

import contextlib
import io
import runpy
import subprocess
import sys
from pathlib import Path
from unittest.mock import patch

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
    told, script = io.StringIO(), str(SCRIPTS / name)
    with (
        patch("sys.argv", [script, "--quick", *options]),
        contextlib.chdir(place),
        contextlib.redirect_stderr(told),
    ):
        try:
            runpy.run_path(script, run_name="__main__")
        except SystemExit as ended:
            assert ended.code == 2
        else:
            raise AssertionError(f"{name} ended without a status")
    assert named in told.getvalue() and told.getvalue().count("\n") == 1
    assert not list(place.rglob("*.json*"))
