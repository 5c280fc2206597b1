"""A directory for results: known to be writable before anything is run, never half a file in it."""

import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from exu_press.errors import InputError

__all__ = ["output_directory", "replacing", "write_json"]


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
        partial.unlink(missing_ok=True)


def write_json(path: Path, data: Any) -> None:
    """Write strict JSON (no NaN)."""
    text = json.dumps(data, indent=2, allow_nan=False) + "\n"
    with replacing(path) as partial:
        partial.write_text(text, encoding="utf-8")
