"""Locks of directories, each of which belongs to one command at a time."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import refuse_link, writing

__all__ = ["LOCK", "lock_directory", "remove_unused"]

LOCK = ".lock"


@contextmanager
def lock_directory(directory: Path) -> Iterator[Path]:
    """Keep other processes out of a directory, and yield it; a killed process frees it.

    May be nested.

    Raises:
        InputError: another process has it, or its lock file is a link.
    """
    from filelock import FileLock, Timeout  # takes longer to load than a short run needs it

    file = directory.resolve() / LOCK
    refuse_link(file)
    lock = FileLock(file, timeout=0, is_singleton=True)
    with writing(file):
        try:
            lock.acquire()
        except Timeout:
            raise InputError(
                f"{directory}: another run is writing here; allowed is to wait for it, or another "
                "directory"
            ) from None
    try:
        yield directory
    finally:
        lock.release()


def remove_unused(directory: Path) -> None:
    """Remove a locked directory in which nothing was written."""
    with suppress(OSError):
        if [file.name for file in directory.iterdir()] == [LOCK]:
            (directory / LOCK).unlink()
            directory.rmdir()
