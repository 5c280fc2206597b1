"""Errors of a user's input; fe_models, on which this package builds, raises them too."""

import importlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from fe_models.errors import DiskFullError, InputError

__all__ = [
    "DiskFullError",
    "InputError",
    "MissingKeysError",
    "Need",
    "UnusedKeyError",
    "collected_needs",
    "error_prefix",
    "required_package",
]

Need = tuple[str, str]
"""Dotted name of a place in a scene, and what it needs, in which {path} stands for that name, and
{list} for that of the list that has the place."""

for error in (InputError, DiskFullError):
    error.__module__ = __name__  # as tracebacks and the reference name it


class UnusedKeyError(InputError):
    """A key or a table of a scene that the scene does not use.

    Attributes:
        name: dotted, or a table's.
    """

    def __init__(self, name: str, text: str, reason: str) -> None:
        super().__init__(f"{text}: not used by this scene ({reason}); remove it")
        self.name = name


class MissingKeysError(InputError):
    """Keys that decide the result of a scene, have no default and are missing.

    Attributes:
        needs: of every place that lacks some.
    """

    def __init__(self, needs: Iterable[Need]) -> None:
        self.needs = tuple(dict.fromkeys(needs))
        paths: dict[tuple[str, str], list[str]] = {}
        for path, text in self.needs:
            paths.setdefault((path.partition(".")[0], text), []).append(path)
        messages = []
        for (kind, text), names in paths.items():
            (name, verb) = (names[0], "needs") if len(names) == 1 else (f"{kind}.NAME", "need")
            text = text.replace("{path}", name).replace("{list}", names[0].rpartition(".")[0])
            messages.append(f"{', '.join(n.strip('.') or 'it' for n in names)} {verb} {text}")
        super().__init__("; ".join(messages))


@contextmanager
def collected_needs(needs: list[Need]) -> Iterator[None]:
    """Add what the block needs to a list, and go on behind it."""
    try:
        yield
    except MissingKeysError as error:
        needs += error.needs


@contextmanager
def error_prefix(prefix: str) -> Iterator[None]:
    """Begin the message of an InputError with a prefix; one that ends in "." names a place."""
    try:
        yield
    except InputError as error:
        if isinstance(error, MissingKeysError) and prefix.endswith("."):
            raise MissingKeysError((prefix + path, text) for path, text in error.needs) from None
        kind = DiskFullError if isinstance(error, DiskFullError) else InputError
        raise kind(f"{prefix}{error}") from None


def required_package(name: str, use: str, install: str) -> Any:
    """Return a package that not every installation has.

    Args:
        name: of the package.
        use: beginning of the message, the key or method that needs it.
        install: its name for pip.

    Raises:
        InputError: it is not installed.
    """
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise InputError(
            f"{use}: needs the package {name}; install it by pip install {install}"
        ) from None
