"""Work that a class offers to users and a room above its own does.

Rooms know what lies below them alone: a scene knows no model, a result none of the figures that
people compare. But `scene.build()` and `result.summary()` are what users call. So the package's
face, which knows every room, says here who does this work, before any of these classes is loaded.
"""

TYPE_CHECKING = False  # loaded before Ctrl-C is quiet: nothing more

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

__all__ = ["WORKERS"]

WORKERS: "dict[str, Callable[[Any], Any]]" = {}
"""Name of a method -> what is called with its object."""
