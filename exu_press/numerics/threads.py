"""One thread for small matrices: further ones only wait for each other."""

from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController

__all__ = ["one_thread"]


@cache
def _libraries() -> Any:
    """Return those at hand; to look for them takes as long as a short run."""
    return ThreadpoolController()


def one_thread() -> Any:
    """Return a context in which NumPy's linear algebra has one thread."""
    return _libraries().limit(limits=1)
