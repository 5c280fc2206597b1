"""The sources that a row comes from, as one digest: edited code gives new rows."""

import hashlib
from functools import cache
from importlib.util import find_spec
from pathlib import Path

__all__ = ["source_digest"]

OURS = ("exu_press", "fe_models")
SUFFIXES = (".py", ".npz", ".toml")

FOR_READERS = ("cli", "page", "plots", "report", "view")
"""Folders of a package that no row comes from: they show results."""


@cache
def source_digest(*packages: str) -> str:
    """Return a digest of this package's sources and of those of other packages or modules."""
    digest = hashlib.sha256()
    for name in dict.fromkeys((*OURS, *packages)):
        for file, known_as in _files(name):
            digest.update(f"{known_as} {file.stat().st_size};".encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def _files(name: str) -> list[tuple[Path, str]]:
    """Return a package's files, or a module's one, with names that are the same on any machine."""
    spec = find_spec(name)
    if spec is None:
        return []
    folders = [Path(folder) for folder in spec.submodule_search_locations or ()]
    if not folders:
        return [] if spec.origin is None else [(Path(spec.origin), name)]
    found = [
        (file, f"{name}/{file.relative_to(folder).as_posix()}")
        for folder in folders
        for file in folder.rglob("*")
        if file.suffix in SUFFIXES and file.relative_to(folder).parts[0] not in FOR_READERS
    ]
    return sorted(found, key=lambda each: each[1])
