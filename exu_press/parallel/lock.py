"""One directory belongs to one batch at a time."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from filelock import FileLock, Timeout

from exu_press.errors import InputError

__all__ = ["locked"]


@contextmanager
def locked(directory: Path) -> Iterator[None]:
    """Keep other processes out of a directory; the system frees it if this one is killed.

    May be nested.

    Raises:
        InputError: another process has it.
    """
    lock = FileLock(directory / ".lock", timeout=0, is_singleton=True)
    try:
        with lock:
            yield
    except Timeout:
        raise InputError(
            f"{directory}: another run is writing here; allowed is to wait for it, or another "
            "directory"
        ) from None
