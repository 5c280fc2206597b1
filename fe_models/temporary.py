"""Temporary folders and files: each goes with its process, or after a kill at the next start."""

import contextlib
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO

__all__ = ["TemporaryFolder", "remove_abandoned", "replacing"]

BEGINNING = "exu_press_temporary_"
"""Of the folders' names."""

LOCK = ".lock"
"""File in a folder that its process keeps locked; the system frees it, however the process ends."""


class TemporaryFolder:
    """A folder that is removed with this object, or by the next one if its process is killed."""

    _lock: int

    def __init__(self, parent: Path | None = None) -> None:
        """Create it in a folder, that of temporary ones by default; remove what was left there.

        Raises:
            OSError: it cannot be created.
        """
        remove_abandoned(parent)
        self._folder = tempfile.TemporaryDirectory(
            prefix=BEGINNING, dir=parent, ignore_cleanup_errors=True
        )
        self.path = Path(self._folder.name)
        if sys.platform == "win32":
            return
        new = self.path / f"{LOCK}.new"
        self._lock = os.open(new, os.O_RDWR | os.O_CREAT | os.O_EXCL)
        _lock(self._lock)
        new.rename(self.path / LOCK)  # locked when others see it

    def remove(self) -> None:
        """Remove it."""
        self._folder.cleanup()

    def __enter__(self) -> Path:
        """Return its path."""
        return self.path

    def __exit__(self, *_: object) -> None:
        self.remove()

    def __del__(self) -> None:
        """Free the lock, which holds a file open."""
        with contextlib.suppress(AttributeError, OSError):
            os.close(self._lock)


def remove_abandoned(parent: Path | None = None) -> None:
    """Remove what killed processes have left in a folder, that of temporary ones by default."""
    with contextlib.suppress(OSError):  # no folder for temporary ones, or none that can be read
        for folder in (parent or Path(tempfile.gettempdir())).glob(f"{BEGINNING}*"):
            _remove_abandoned(folder)


def _remove_abandoned(folder: Path) -> None:
    """Remove a folder whose process has ended; one of another user cannot be locked."""
    with contextlib.suppress(OSError):
        lock = os.open(folder / LOCK, os.O_RDWR | getattr(os, "O_NOFOLLOW", 0))
        try:
            if _lock(lock) and not folder.is_symlink():
                shutil.rmtree(folder, ignore_errors=True)
        finally:
            os.close(lock)


@contextlib.contextmanager
def replacing(file: Path) -> Iterator[IO[bytes]]:
    """Yield a new file that replaces another one when it is written, or goes.

    Raises:
        OSError: it cannot be written.
    """
    with TemporaryFolder(file.parent) as folder:
        partial = folder / file.name
        with partial.open("wb") as stream:
            yield stream
        partial.replace(file)


def _lock(file: int) -> bool:
    """Lock an open file without waiting; return whether that was possible."""
    if sys.platform == "win32":  # folders that killed processes leave there stay
        return False
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
