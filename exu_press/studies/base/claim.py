"""A directory belongs to one study."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.files.output_directory import write_json
from exu_press.parallel import FILE
from exu_press.schema.stored import from_json

__all__ = ["STUDY_FILE", "claim"]

STUDY_FILE = "study.json"


def claim(directory: Path, study: Mapping[str, Any], written: Sequence[str]) -> None:
    """Write down whose directory this is.

    Args:
        directory: of one study.
        study: the data that tell it from others.
        written: names of files that the study writes in the end.

    Raises:
        InputError: it is another study's, or its files are there without its study.json.
    """
    path = directory / STUDY_FILE
    wanted = json.loads(json.dumps(study))
    if not path.exists():
        taken = [name for name in written if (directory / name).exists()]
        if taken:
            raise InputError(
                f"{directory}: has {taken[0]} and no {path.name}, so that it may belong to another "
                f"study; allowed is a directory of the study's own, or to delete "
                f"{' and '.join(taken)}; runs of this study in {FILE} are kept"
            )
        write_json(path, wanted)
        return
    try:
        found = from_json(dict[str, Any], path.read_bytes(), path.name)
    except (OSError, InputError):
        found = None
    if found != wanted:
        raise InputError(
            f"{directory}: belongs to another study ({path.name} differs{_where(found, wanted)}); "
            "allowed is another directory, or to remove this one"
        )


def _where(found: Any, wanted: dict[str, Any]) -> str:
    """Return the first key in which two studies differ, in words."""
    if isinstance(found, dict):
        for name in {**wanted, **found}:
            if found.get(name) != wanted.get(name):
                return f" in {name}"
    return ""
