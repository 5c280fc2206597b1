"""One run of a batch: function, arguments, versions, and a digest of its sources."""

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import plain_data
from exu_press.files.sources import source_digest
from exu_press.installation.versions import version_of
from fe_models.errors import disk_full
from fe_models.lazy import named_object

__all__ = [
    "COMPLETED",
    "FAILED",
    "TIME_LIMIT",
    "WORKER_DIED",
    "Function",
    "Row",
    "Task",
    "name_of",
    "row_of",
    "row_of_task",
    "task_of",
    "versions",
]

Row = dict[str, Any]
Function = Callable[[dict[str, Any]], Row]

COMPLETED = "completed"
FAILED = "failed"
TIME_LIMIT = "time limit"
WORKER_DIED = "worker died"

PACKAGES = ("exu-press", "exudyn", "ngsolve")
"""Packages whose version changes a run's results."""


@dataclass(frozen=True)
class Task:
    """One run.

    Attributes:
        key: sha256 of everything that determines the row.
        function: "module:name".
        arguments: canonical JSON.
        modules: that a worker imports first, for their declarations.
        versions: of PACKAGES and of the sources; a worker with others refuses.
    """

    key: str
    function: str
    arguments: str
    versions: Mapping[str, str | None]
    modules: tuple[str, ...] = ()


def task_of(
    function: str,
    arguments: Mapping[str, Any],
    modules: tuple[str, ...] = (),
    task_versions: Mapping[str, str | None] | None = None,
) -> Task:
    """Return the task of a function's name and its arguments.

    Args:
        task_versions: `versions` of function and modules; None: they are looked up.

    Raises:
        ValueError, TypeError: the arguments are no JSON.
    """
    text = _canonical(arguments)
    task_versions = versions(function, *modules) if task_versions is None else task_versions
    everything = _canonical({"function": function, "arguments": text, "versions": task_versions})
    return Task(
        hashlib.sha256(everything.encode()).hexdigest(), function, text, task_versions, modules
    )


def versions(function: str, *modules: str) -> dict[str, str | None]:
    """Return the versions of PACKAGES, None for missing ones, and a digest of sources.

    The digest is of the packages of function and modules as they are on the disk: sources change
    between two versions of the package.
    """
    sources = source_digest(
        *(name.partition(":")[0].partition(".")[0] for name in (function, *modules))
    )
    return {"sources": sources, **{package: version_of(package) for package in PACKAGES}}


def name_of(function: Function) -> str:
    """Return "module:name" of a function that a worker can import.

    Raises:
        ValueError: it is a lambda, a method, inside a function, or in the script that is run.
    """
    module, name = function.__module__, function.__qualname__
    if module == "__main__" or getattr(import_module(module), name, None) is not function:
        raise ValueError(
            f"{module}.{name}: a worker cannot import it; allowed is a function at the top level "
            "of a module that is not the script itself"
        )
    return f"{module}:{name}"


def row_of_task(task: Task, only_imports: bool = False) -> Row:
    """Return a task's row, in a worker.

    Raises:
        InputError: its function cannot be imported here, or the versions here are others.
    """
    try:
        for module in task.modules:
            import_module(module)
        function: Function = named_object(task.function)
    except Exception as error:
        names = ", ".join((task.function, *task.modules))
        raise InputError(
            f"{names}: a worker cannot import it ({_in_a_line(error)}); allowed are modules in "
            "folders that Python knows without the one where you work; PYTHONPATH names further "
            "ones"
        ) from None
    here = _versions_when_imported(task.function, *task.modules)
    if here != task.versions:
        differences = [
            "other sources" if name == "sources" else f"{name} {here.get(name)}, not {version}"
            for name, version in task.versions.items()
            if here.get(name) != version
        ]
        raise InputError(f"a worker has {', '.join(differences)}; allowed are the versions here")
    return {} if only_imports else row_of(function, json.loads(task.arguments))


@cache
def _versions_when_imported(function: str, *modules: str) -> dict[str, str | None]:
    """Return the versions that this worker has imported, whatever changes on the disk later."""
    return versions(function, *modules)


def row_of(function: Function, arguments: dict[str, Any]) -> Row:
    """Return a function's row, or that of its exception, in strict JSON.

    Raises:
        DiskFullError: there is no room for what the function writes.
    """
    try:
        row = {"status": COMPLETED, "reason": "", **function(arguments)}
        return dict(plain_data(row))
    except Exception as error:
        if full := disk_full(error):
            raise full from None
        return {"status": FAILED, "reason": _in_a_line(error)}


def _in_a_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _canonical(data: Any) -> str:
    """Return JSON that is the same for equal data: sorted keys, no spaces, no NaN."""
    return json.dumps(data, sort_keys=True, separators=(",", ":"), allow_nan=False)
