"""Reading of others' files in a child process, as a damaged one may crash or block its reader.

`reduced_part` reads, meshes and reduces there in one go, and gets plain arrays.
The geometry kernel of this process never opens a STEP file.
"""

from collections.abc import Callable
from typing import Any

from fe_models.errors import InputError
from fe_models.processes import Child, ChildError, TimeLimitError

__all__ = ["read_in_child"]

NO_MEMORY = ("MemoryError", "bad_alloc", "failed to map segment", "allocation failed")
"""Texts of libraries' errors where memory is exhausted."""


def read_in_child(
    function: str,
    *arguments: Any,
    file: str,
    smaller: str,
    damage: Callable[[], str] = str,
    time_limit: float,
    memory_limit: float,
    report: Callable[..., None] | None = None,
) -> Any:
    """Return the value of a function that reads a file in a child.

    Args:
        function: "module:name".
        arguments: of it.
        file: its kind and path, for messages.
        smaller: what needs less of the limits, in words.
        damage: text about where the file is damaged, which may be empty.
        time_limit: of the child, s.
        memory_limit: of the child, bytes.
        report: called with (text about the progress, share done) by the function's last argument.

    Raises:
        InputError: the function raises it, or the file is damaged or needs more than its limits.
    """
    memory = round(memory_limit)
    with Child(function, memory=memory, one_thread=True, progress=report) as child:
        child.request(*arguments)
        try:
            return child.answer(time_limit)
        except TimeLimitError:
            why = f"takes more than {time_limit:g} s; allowed is a larger time_limit, {smaller}"
        except ChildError as error:
            how, *_ = str(error).partition(": ")
            if any(word in str(error) for word in NO_MEMORY):
                why = (
                    f"needs more than {memory_limit / 1e9:g} GB; allowed is a larger "
                    f"memory_limit_gb, {smaller}"
                )
            else:
                how = how if how.startswith(("killed", "exit")) else str(error)
                why = f"cannot be read and reduced, it may be damaged ({how})"
    raise InputError(f"{file}: {why}{damage()}")
