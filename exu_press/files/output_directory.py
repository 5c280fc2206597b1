"""A directory for results: known to be writable before anything is run, never half a file in it."""

import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from exu_press.errors import InputError

__all__ = [
    "FORMATS",
    "PICTURES",
    "check_writable",
    "output_directory",
    "remove_pictures",
    "replacing",
    "write_json",
]

FORMATS = (".png", ".svg", ".pdf")
"""Endings of pictures."""

PICTURES = {
    "run": ("slider", "orbit", "force", "press", "energy"),
    "compare": ("compare_slider", "compare_force", "compare_measured"),
    "sweep": ("sweep",),
    "bifurcation": ("bifurcation",),
    "fit": ("fit", "profiles"),
    "sensitivity": ("sensitivity",),
    "wear": ("wear",),
    "optimise": ("front",),
}
"""Names of the pictures of a command, without their endings."""


def output_directory(path: str | Path) -> Path:
    """Return a directory that exists and can be written to; raise InputError if it cannot."""
    directory = Path(path)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            pass
    except OSError as error:
        raise InputError(
            f"--out {directory}: cannot be written to ({error.strerror}); "
            "allowed is a directory that exists or can be made"
        ) from None
    return directory


def remove_pictures(directory: Path, command: str) -> None:
    """Remove a command's pictures of before, which would pass for those of the new results."""
    for name in PICTURES[command]:
        for ending in FORMATS:
            (directory / f"{name}{ending}").unlink(missing_ok=True)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary name beside `path`; on success it takes the place of `path`.

    Whatever goes wrong, an existing file stays as it was and no half file is left. OSError becomes
    InputError.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield partial
        partial.replace(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror})") from None
    finally:
        with suppress(OSError):  # on a file system that became read-only
            partial.unlink(missing_ok=True)


def check_writable(path: Path) -> None:
    """Refuse a file that cannot be written, before the work that it is to hold.

    Raises:
        InputError: there is no such directory, or nothing can be written into it.
    """
    if not path.parent.is_dir():
        raise InputError(f"{path}: there is no directory {path.parent}")
    if path.is_dir():
        raise InputError(f"{path}: is a directory; allowed is a file")
    try:
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror})") from None


def write_json(path: Path, data: Any) -> None:
    """Write strict JSON (no NaN)."""
    text = json.dumps(data, indent=2, allow_nan=False) + "\n"
    with replacing(path) as partial:
        partial.write_text(text, encoding="utf-8")
