"""Arrays in a file of a cache on disk, followed by a digest: damaged files are not read."""

import hashlib
import io
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_models.temporary import replacing

__all__ = ["cache_folder", "load_arrays", "save_arrays"]

DIGEST_SIZE = hashlib.sha256().digest_size


def cache_folder(name: str) -> Path:
    """Return $EXU_PRESS_CACHE, else a folder of this name under $XDG_CACHE_HOME or ~/.cache."""
    own = os.environ.get("EXU_PRESS_CACHE")
    if own:
        return Path(own)
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "exu_press" / name


def save_arrays(arrays: Mapping[str, NDArray[Any]], file: Path) -> None:
    """Write arrays, the whole file at once.

    Raises:
        OSError: it cannot be written.
    """
    content = io.BytesIO()
    np.savez(content, allow_pickle=False, **arrays)
    file.parent.mkdir(parents=True, exist_ok=True)
    with replacing(file) as stream:
        stream.write(content.getvalue())
        stream.write(hashlib.sha256(content.getvalue()).digest())


def load_arrays(file: Path) -> dict[str, NDArray[Any]] | None:
    """Return the arrays in a file of `save_arrays`, or None if it is missing or damaged."""
    try:
        data = file.read_bytes() if file.is_file() else b""
        content, digest = data[:-DIGEST_SIZE], data[-DIGEST_SIZE:]
        if hashlib.sha256(content).digest() != digest:
            return None
        with np.load(io.BytesIO(content), allow_pickle=False) as stored:
            return {key: stored[key] for key in stored.files}
    except Exception:  # whatever readers of archives and arrays raise of foreign bytes
        return None
