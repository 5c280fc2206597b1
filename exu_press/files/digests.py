"""Digests of files: as they are, and as they were read."""

import hashlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path

from exu_press.errors import InputError

__all__ = [
    "file_digest",
    "files_read",
    "locate",
    "note_content",
    "note_digests",
    "note_file",
    "recorded_files",
]

PACKAGE = Path(__file__).parents[1]
SHIPPED = "exu_press:"
"""Begins the name of a file of this package, which lies elsewhere on another machine."""

_READ: ContextVar[dict[str, str] | None] = ContextVar("read", default=None)


@contextmanager
def recorded_files() -> Iterator[Mapping[str, str]]:
    """Yield the sha256 of the files that are read inside the block, by name.

    A block around it has them, too.
    """
    outer, inner = _READ.get(), dict[str, str]()
    token = _READ.set(inner)
    try:
        yield inner
    finally:
        _READ.reset(token)
        if outer is not None:
            outer.update(inner)


def files_read() -> dict[str, str]:
    """Return the sha256 of the files that the innermost block has read so far, by name."""
    return dict(_READ.get() or {})


def note_content(path: Path, content: bytes) -> None:
    """Record a file's content as read."""
    if _READ.get() is not None:
        note_digests({_name_of(path): hashlib.sha256(content).hexdigest()})


def note_file(path: Path) -> None:
    """Record a file as read, as it is now; one that has not changed is hashed once."""
    if _READ.get() is not None:
        note_digests({_name_of(path): file_digest(path)})


def note_digests(digests: Mapping[str, str]) -> None:
    """Record files as read, of which the digests are known."""
    files = _READ.get()
    if files is not None:
        files.update(digests)


def _name_of(path: Path) -> str:
    """Return a path as it was given; of a shipped file its place in the package."""
    if path.is_relative_to(PACKAGE):
        return f"{SHIPPED}{path.relative_to(PACKAGE).as_posix()}"
    return str(path)


def locate(name: str) -> Path:
    """Return the path of a recorded file's name."""
    shipped = name.startswith(SHIPPED)
    return PACKAGE / name.removeprefix(SHIPPED) if shipped else Path(name)


def file_digest(path: str | Path) -> str:
    """Return the sha256 of a file as it is.

    Raises:
        InputError: it cannot be read, or is no regular file (a device or a pipe may never end).
    """
    if not Path(path).is_file():
        raise InputError(f"{path}: is no file that can be read")
    try:
        about = Path(path).stat()
        return _digest_of(str(path), about.st_ino, about.st_size, about.st_mtime_ns)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None


@lru_cache(maxsize=64)
def _digest_of(path: str, *_: int) -> str:
    """Return the digest of a file, which is read again only where it has changed."""
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
