"""The one kind of error that a user's input can raise, here and in exu_press."""

import errno
import re
from typing import ClassVar

__all__ = ["DiskFullError", "InputError", "disk_full"]

NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Errors of a system that has no room left, for anybody, for this user or in this file."""

MOST_LETTERS = 8000
"""Most letters of a message: lists of what is allowed have up to half of them."""

MOST_IN_A_WORD = 400
"""Most letters of a word in a message: a path of a usual length stands in full, what was pasted by
mistake does not."""

LONG_WORD = re.compile(rf"\S{{{MOST_IN_A_WORD + 1},}}")


class InputError(ValueError):
    """Something the user gave is wrong: the message says what, where, and what is allowed.

    The command line prints the message in one line and exits with `exit_status`.
    """

    exit_status: ClassVar[int] = 2

    def __str__(self) -> str:
        """Return the message in one line; a very long one, or a long word, without its middle.

        What no terminal can show of a name in a file stands as in Python.
        """
        half = MOST_IN_A_WORD // 2
        text = LONG_WORD.sub(
            lambda word: f"{word[0][:half]}[...]{word[0][-half:]}", super().__str__()
        )
        if len(text) > MOST_LETTERS:
            half = MOST_LETTERS // 2
            text = f"{text[:half]} [...] {text[-half:]}"
        return "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text)


class DiskFullError(InputError):
    """A file cannot be written as there is no room left: the message names it.

    What was computed before is kept.
    """

    exit_status = 3


def disk_full(error: BaseException, path: object = None) -> DiskFullError | None:
    """Return what says that a disk is full, where that is why an error was raised.

    Args:
        error: that was raised.
        path: of the file, where the error has none.
    """
    if isinstance(error, DiskFullError):
        return error
    if not isinstance(error, OSError) or error.errno not in NO_ROOM:
        return None
    file = path or error.filename or "a temporary file"
    return DiskFullError(f"{file}: cannot be written ({error.strerror})")
