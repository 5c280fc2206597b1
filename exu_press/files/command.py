"""The command that this process executes, as a user gave it."""

import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

__all__ = ["command_line", "executing"]

_WORDS: ContextVar[Sequence[str]] = ContextVar("words")


@contextmanager
def executing(words: Sequence[str]) -> Iterator[None]:
    """Take words for the command inside the block."""
    token = _WORDS.set(words)
    try:
        yield
    finally:
        _WORDS.reset(token)


def command_line() -> str:
    """Return the command, for a shell: of exu-press, or the script that Python runs."""
    script = [Path(sys.argv[0]).name, *sys.argv[1:]] if sys.argv else []
    return shlex.join(_WORDS.get(script))
