"""Check in a process of its own that a STEP file can be read.

A damaged file may end the process that reads it, or keep it busy for ever.
"""

import functools
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from fe_models.errors import InputError

__all__ = ["check_step", "main", "read_step"]

LONGEST = 120.0
"""s, for a file; one of 10 MB takes some seconds."""

MOST_MEMORY = 8 * 2**30
"""Bytes of address space, where the system keeps such limits."""


def check_step(path: Path) -> None:
    """Read a STEP file in a further process; a file is read once a process.

    Raises:
        InputError: it is damaged: reading it fails, crashes or does not end.
    """
    about = path.stat()
    _check(path, about.st_mtime_ns, about.st_size)


@functools.cache
def _check(path: Path, changed: int, size: int) -> None:
    command = [sys.executable, "-m", __name__, str(path.resolve())]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=LONGEST,
            env=environment,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise InputError(
            f"STEP file {path}: reading it takes more than {LONGEST:g} s; it may be damaged"
        ) from None
    if done.returncode:
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        why = (
            lines[-1] if lines and done.returncode > 0 else f"the reader ended by {done.returncode}"
        )
        raise InputError(f"STEP file {path}: cannot be read, it may be damaged ({why})")
    extent = json.loads(done.stdout.splitlines()[-1])
    if not all(math.isfinite(number) for number in extent):
        raise InputError(f"STEP file {path}: a coordinate is no number")


def read_step(path: Path) -> Any:
    """Return the shape of a STEP file; netgen takes only names that end in small letters."""
    from netgen.occ import OCCGeometry  # type: ignore[import-untyped]

    with tempfile.TemporaryDirectory() as directory:
        if path.suffix != path.suffix.lower():
            path = Path(shutil.copy(path, Path(directory) / f"shape{path.suffix.lower()}"))
        return OCCGeometry(str(path)).shape


def main(path: str) -> None:
    """Read a file and print the corners of its bounding box."""
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    except (ImportError, ValueError):
        pass  # a system without such limits
    shape = read_step(Path(path))
    low, high = shape.bounding_box
    print(json.dumps([getattr(corner, axis) for corner in (low, high) for axis in "xyz"]))


if __name__ == "__main__":
    main(sys.argv[1])
