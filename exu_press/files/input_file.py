"""Files that a user names: regular ones, of a size that an input has."""

import stat
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.digests import note_content

__all__ = ["MOST_BYTES", "read_bytes", "read_text"]

MOST_BYTES = 100_000_000
"""Largest size of an input file; a table of a million lines has a third of it."""


def read_bytes(path: Path) -> bytes:
    """Return the content of a file.

    Raises:
        InputError: it cannot be read, is no regular file (a device or a pipe may never end), or is
            larger than MOST_BYTES.
    """
    try:
        about = path.stat()
        if stat.S_ISDIR(about.st_mode):
            raise InputError(f"{path}: is a directory; allowed is a file")
        if not stat.S_ISREG(about.st_mode):
            raise InputError(f"{path}: is no regular file; allowed is a file on a disk")
        if about.st_size > MOST_BYTES:
            raise InputError(
                f"{path}: has {about.st_size / 1e6:.0f} MB; allowed are {MOST_BYTES / 1e6:.0f} MB"
            )
        content = path.read_bytes()
        note_content(path, content)
        return content
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: cannot be read ({error})") from None  # a zero byte in the name


def read_text(path: Path) -> str:
    """Return the text of a file in UTF-8, without the mark of byte order that some editors write.

    Raises:
        InputError: as `read_bytes`, or the file is no text in UTF-8.
    """
    try:
        return read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{path}: is not a text in UTF-8") from None
