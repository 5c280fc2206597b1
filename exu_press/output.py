"""A directory for results: known to be writable before anything is run, never half a file in it."""

import json
import os
import tempfile
from pathlib import Path
from typing import Any

from exu_press.errors import InputError

__all__ = ["output_directory", "write_json"]


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


def write_json(path: Path, data: Any) -> None:
    """Write strict JSON (no NaN) under a temporary name, then rename."""
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        partial.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n", encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror})") from None
    finally:
        partial.unlink(missing_ok=True)
