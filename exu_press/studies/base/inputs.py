"""The arguments of a run, with digests of the files that its scene names."""

import hashlib
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.scene import Scene

__all__ = ["arguments_of", "scene_from"]


def arguments_of(scene: Scene) -> dict[str, Any]:
    """Return what identifies a run of a scene: its keys and the digests of its files."""
    data = scene.to_dict()
    files = {path: _digest(path) for path in _files_in(data)}
    return {"scene": data, "files": files} if files else {"scene": data}


def scene_from(arguments: dict[str, Any]) -> Scene:
    """Return the scene of a run's arguments.

    Raises:
        InputError: one of its files has been changed since they were made, or is gone.
    """
    for path, digest in arguments.get("files", {}).items():
        if _digest(path) != digest:
            raise InputError(
                f"{path}: has been changed while the study goes on; the same command does the run "
                "with the new file"
            )
    return Scene.from_dict(arguments["scene"])


def _files_in(data: Any) -> Iterator[str]:
    """Yield the texts of a scene that are names of files, as of STEP files."""
    if isinstance(data, dict):
        for value in data.values():
            yield from _files_in(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from _files_in(value)
    elif isinstance(data, str) and Path(data).suffix and Path(data).is_file():
        yield data


def _digest(path: str) -> str:
    try:
        about = Path(path).stat()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    return _digest_of(path, about.st_ino, about.st_size, about.st_mtime_ns)


@lru_cache(maxsize=64)
def _digest_of(path: str, *_: int) -> str:
    """Return the digest of a file, which is read again only where it has changed."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()
