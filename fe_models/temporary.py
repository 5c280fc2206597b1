"""Temporary folders, removed with their object, or by the next one after a kill."""

import contextlib
import os
import shutil
import sys
import tempfile
from pathlib import Path

__all__ = ["TemporaryFolder", "remove_abandoned"]

BEGINNING = "exu_press_temporary_"
"""Of the folders' names."""

LOCK = ".lock"
"""File in a folder that its process keeps locked; the system frees it, however the process ends."""


class TemporaryFolder:
    """A folder that is removed with this object, or by the next one if its process is killed."""

    def __init__(self) -> None:
        """Create it, and remove the folders of killed processes.

        Raises:
            OSError: it cannot be created.
        """
        remove_abandoned()
        self._folder = tempfile.TemporaryDirectory(prefix=BEGINNING, ignore_cleanup_errors=True)
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


def remove_abandoned() -> None:
    """Remove the folders of killed processes."""
    with contextlib.suppress(OSError):  # no folder for temporary ones, or none that can be read
        for folder in Path(tempfile.gettempdir()).glob(f"{BEGINNING}*"):
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
