"""A worker process: tasks from standard input, rows to its first standard output.

Started by `exu_press.parallel.child`; both ways a line is one JSON text. The process ends itself
when its standard input closes: that is how it learns that its parent is gone, even by kill -9.
"""

import json
import math
import os
import sys
import threading
from importlib import import_module
from queue import SimpleQueue
from typing import Any, TextIO

from exu_press.parallel.task import COMPLETED, FAILED, Function, Row, function_of, versions

__all__ = ["main", "row_of"]


def main() -> None:
    """Perform tasks until standard input closes."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # a function's own prints are no answer
    lines: SimpleQueue[str] = SimpleQueue()
    threading.Thread(target=_listen, args=(lines,), daemon=True).start()
    try:
        for module in sys.argv[2:]:
            import_module(module)
        function = function_of(sys.argv[1])
    except Exception as error:
        _answer(answers, {"error": _in_a_line(error)})
        return
    _answer(answers, {"versions": versions(*sys.argv[1:])})
    while True:
        _answer(answers, row_of(function, json.loads(lines.get())))


def row_of(function: Function, arguments: dict[str, Any]) -> Row:
    """Return a function's row with status and reason, in strict JSON: null where it has no number.

    An exception is a row too.
    """
    try:
        row = {"status": COMPLETED, "reason": "", **function(arguments)}
        return dict(_strict(row))
    except Exception as error:
        return {"status": FAILED, "reason": _in_a_line(error)}


def _listen(lines: "SimpleQueue[str]") -> None:
    """Hand on lines; at the end of standard input end the process, whatever it computes."""
    for line in sys.stdin:
        lines.put(line)
    os._exit(1)


def _answer(stream: TextIO, data: Any) -> None:
    stream.write(json.dumps(data, allow_nan=False) + "\n")
    stream.flush()


def _strict(data: Any) -> Any:
    """Return data with null for NaN and infinity, and NumPy's numbers and arrays as Python's."""
    if hasattr(data, "tolist"):
        data = data.tolist()
    if data is None or isinstance(data, (str, bool, int)):
        return data
    if isinstance(data, float):
        return data if math.isfinite(data) else None
    if isinstance(data, dict):
        return {str(name): _strict(value) for name, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_strict(value) for value in data]
    raise TypeError(f"{type(data).__name__} in a row: allowed are numbers, texts, lists and dicts")


def _in_a_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


if __name__ == "__main__":
    main()
