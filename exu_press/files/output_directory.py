"""A directory for results: known to be writable before anything is run, never half a file in it."""

import json
import math
import secrets
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from fe_models.errors import disk_full

__all__ = [
    "COMPARED",
    "COMPARISON_FILE",
    "FORMATS",
    "PICTURES",
    "REPORT_FILE",
    "RUN_FILE",
    "check_writable",
    "checkpoint_directory",
    "folder_name",
    "output_directory",
    "plain_data",
    "refuse_link",
    "remove_partial",
    "remove_pictures",
    "replacing",
    "subdirectory",
    "write_json",
    "writing",
]

FORMATS = (".png", ".svg", ".pdf")
"""Endings of pictures."""

PICTURES = {
    "run": ("slider", "orbit", "force", "press", "energy"),
    "compare": ("compare_slider", "compare_force", "compare_measured"),
}
"""Names of the pictures of a command, without their endings."""

COMPARED = ".compared"
"""File in the directory of a run that a comparison wrote, and the next one may replace."""

RUN_FILE, COMPARISON_FILE, REPORT_FILE = "run.nc", "comparison.json", "report.json"
"""File of a run, of a comparison and of a study in its directory, of which a page is made."""


def output_directory(path: str | Path) -> Path:
    """Return a directory that exists and can be written to.

    Raises:
        InputError: it cannot.
    """
    directory = Path(path)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=directory):
            pass
    except OSError as error:
        raise disk_full(error, directory) or InputError(
            f"--out {directory}: cannot be written to ({error.strerror}); "
            "allowed is a directory that exists or can be made"
        ) from None
    return directory


def checkpoint_directory(path: Path) -> Path:
    """Return the directory beside a run's file in which the run is while it goes on."""
    return path.with_name(f"{path.name}.unfinished")


def subdirectory(directory: Path, name: str) -> Path:
    """Return a directory inside an output directory, made where there is none.

    Raises:
        InputError: it is a link, through which files outside would be written, or cannot be made.
    """
    refuse_link(directory / name)
    return output_directory(directory / name)


def refuse_link(path: Path) -> None:
    """Refuse a link inside an output directory: what is written through it lands elsewhere.

    Raises:
        InputError: the path is a symbolic link, whether or not it leads anywhere.
    """
    if path.is_symlink():
        raise InputError(
            f"{path}: is a link to {path.readlink()}, which lies elsewhere; inside an output "
            "directory nothing is written through links: remove it, or take another directory"
        )


def folder_name(label: str) -> str:
    """Return a label as the name of a visible folder, which is no way out of another one.

    >>> folder_name("my press"), folder_name("..")
    ('my_press', '_..')
    """
    name = label.replace(" ", "_")
    return f"_{name}" if name.startswith(".") or not name else name


def remove_pictures(directory: Path, command: str) -> None:
    """Remove a command's pictures of before, which would pass for those of the new results."""
    for name in PICTURES[command]:
        for ending in FORMATS:
            (directory / f"{name}{ending}").unlink(missing_ok=True)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn an OSError of writing a file into one error that names the file.

    Raises:
        DiskFullError: there is no room left.
        InputError: the file cannot be written for another reason.
    """
    try:
        yield
    except OSError as error:
        raise disk_full(error, path) or InputError(
            f"{path}: cannot be written ({error.strerror or error})"
        ) from None


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary file beside `path`; on success it takes the place of `path`.

    Whatever goes wrong, an existing file stays as it was and no half file is left. The temporary
    file has a random name and is made anew, so that no link that lies there is followed; a link at
    `path` is replaced itself.

    Raises:
        InputError: as of `writing`.
    """
    partial = path.with_name(_partial_name(path, secrets.token_hex(8)))
    try:
        with writing(path):
            partial.touch(exist_ok=False)
            yield partial
            partial.replace(path)
    finally:
        with suppress(OSError):  # on a file system that became read-only
            partial.unlink(missing_ok=True)


def remove_partial(path: Path) -> None:
    """Remove what processes left that were killed within `replacing`."""
    with suppress(OSError):
        for partial in path.parent.glob(_partial_name(path, "*")):
            partial.unlink(missing_ok=True)


def _partial_name(path: Path, sign: str) -> str:
    return f".{path.name[:40]}.{sign}.part"


def check_writable(path: Path) -> None:
    """Refuse a file that cannot be written, before the work that it is to hold.

    Raises:
        InputError: there is no such directory, or nothing can be written into it.
    """
    if not path.parent.is_dir():
        raise InputError(f"{path}: there is no directory {path.parent}; allowed is one that exists")
    if path.is_dir():
        raise InputError(f"{path}: is a directory; allowed is a file")
    with writing(path), tempfile.TemporaryFile(dir=path.parent):
        pass


def plain_data(data: Any) -> Any:
    """Return data with null for NaN and infinity, and NumPy's numbers and arrays as Python's."""
    if hasattr(data, "tolist"):
        data = data.tolist()
    if data is None or isinstance(data, (str, bool, int)):
        return data
    if isinstance(data, float):
        return data if math.isfinite(data) else None
    if isinstance(data, dict):
        return {str(name): plain_data(value) for name, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [plain_data(value) for value in data]
    raise TypeError(f"{type(data).__name__} in a file: allowed are numbers, texts, lists and dicts")


def write_json(path: Path, data: Any) -> None:
    """Write strict JSON (no NaN)."""
    text = json.dumps(data, indent=2, allow_nan=False) + "\n"
    with replacing(path) as partial:
        partial.write_text(text, encoding="utf-8")
