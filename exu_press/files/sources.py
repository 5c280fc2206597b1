"""Sources that decide a result: this package's, and modules of a user with what they import."""

import ast
import hashlib
import sys
from collections.abc import Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path

__all__ = ["FOR_READERS", "source_digest", "users_files"]

OURS = ("exu_press", "fe_models")
SUFFIXES = (".py", ".npz", ".toml")
FOR_READERS = ("cli", "page", "plots", "report", "view")
"""Subpackages that show results and compute no row."""


def source_digest(*names: str) -> str:
    """Return a digest of this package's sources, and of other packages or modules with all of the
    user's own files that they import or name.
    """
    digest = hashlib.sha256("".join(map(_digest_of_ours, OURS)).encode())
    for label, file in sorted(users_files(names).items()):
        digest.update(_named_content(label, file))
    return digest.hexdigest()[:16]


@cache
def _digest_of_ours(name: str) -> str:
    digest = hashlib.sha256()
    for label, file in sorted(_files(name).items()):
        digest.update(_named_content(label, file))
    return digest.hexdigest()


def _named_content(label: str, file: Path) -> bytes:
    content = file.read_bytes()
    return f"{label} {len(content)};".encode() + content


def users_files(names: Iterable[str]) -> dict[str, Path]:
    """Return the files of packages and modules, and of those that they import, by name.

    Installed packages count where they are named, not where they are imported. A text in a module
    that is the name of a file beside it counts too, as a law's table does.
    """
    files: dict[str, Path] = {}
    pending, seen = [*names], set(OURS)
    while pending:
        name = pending.pop()
        if name in seen:
            continue
        seen.add(name)
        for label, file in _files(name).items():
            files[label] = file
            if file.suffix == ".py":
                imported, texts = _imports_and_texts(file)
                pending += [module for module in imported if _is_users(module)]
                files |= {f"{name}/{t}": file.parent / t for t in texts if _is_beside(file, t)}
    return files


def _imports_and_texts(file: Path) -> tuple[set[str], set[str]]:
    """Return the top-level names of the modules that a source imports, and its texts."""
    try:
        nodes = [*ast.walk(ast.parse(file.read_bytes()))]
    except (SyntaxError, ValueError):
        return set(), set()
    modules = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    modules |= {
        node.module
        for node in nodes
        if isinstance(node, ast.ImportFrom) and node.module and not node.level
    }
    texts = {
        node.value for node in nodes if isinstance(node, ast.Constant) and type(node.value) is str
    }
    return {name.partition(".")[0] for name in modules}, texts


def _is_users(name: str) -> bool:
    """Return whether a module is the user's own, neither Python's nor installed."""
    if name in sys.stdlib_module_names:
        return False
    files = _files(name).values()
    return not any({"site-packages", "dist-packages"} & set(file.parts) for file in files)


def _is_beside(file: Path, text: str) -> bool:
    """Return whether a text is the name of a file beside another one."""
    if not (Path(text).suffix and text.isprintable()):
        return False
    try:
        return (file.parent / text).is_file()
    except OSError:  # too long for a name
        return False


def _files(name: str) -> dict[str, Path]:
    """Return a package's files, or a module's one, by names that are the same on any machine."""
    spec = find_spec(name)
    if spec is None:
        return {}
    folders = [Path(folder) for folder in spec.submodule_search_locations or ()]
    if not folders:
        return {name: Path(spec.origin)} if spec.has_location and spec.origin else {}
    return {
        f"{name}/{file.relative_to(folder).as_posix()}": file
        for folder in folders
        for file in folder.rglob("*")
        if file.suffix in SUFFIXES and file.relative_to(folder).parts[0] not in FOR_READERS
    }
