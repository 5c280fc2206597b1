"""Joint kinds and studies that installed distributions register, by entry points.

A distribution counts that lies in a folder of this interpreter's packages, and so does its module:
what the working folder or PYTHONPATH brings under the same name is none of it.
"""

import site
import sys
from collections.abc import Iterator
from importlib.machinery import BuiltinImporter, FrozenImporter, ModuleSpec, PathFinder
from importlib.metadata import EntryPoint, distributions
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from exu_press.errors import InputError

__all__ = ["GROUP", "registered_class"]

GROUP = "exu_press.kinds"


def registered_class(key: str, name: str, base: type[Any], group: str = GROUP) -> type[Any] | None:
    """Return the class that a distribution registers by a name, or None.

    Args:
        key: that has the name, for messages.
        name: of the entry point.
        base: that the class is derived from.
        group: of the entry points; that of kinds, or of studies.

    Raises:
        InputError: two distributions register it, its module cannot be imported, or is another one
            than the distribution's.
    """
    entries = {
        entry.value: (entry, str(distribution.name))
        for distribution in distributions(path=_folders())
        for entry in distribution.entry_points.select(group=group, name=name)
    }
    if not entries:
        return None
    owners = (
        f"{key} = {name!r}, registered by {' and '.join(owner for _, owner in entries.values())}"
    )
    if len(entries) > 1:
        raise InputError(f"{owners}: allowed is one of them; remove the other")
    entry, _ = next(iter(entries.values()))
    _refuse_other_module(owners, entry)
    try:
        kind_class = entry.load()
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a module may raise anything, and SystemExit
        raise InputError(f"{owners}: {type(error).__name__}: {error}") from None
    if not (isinstance(kind_class, type) and issubclass(kind_class, base)):
        raise InputError(f"{owners}: {entry.value} is no class derived from {base.__name__}")
    kind: Any = kind_class
    kind.registered_name = name
    return kind_class


def _folders() -> list[str]:
    """Return the folders of this interpreter's packages, and those that their .pth files name."""
    folders = [*site.getsitepackages()]
    if site.ENABLE_USER_SITE:
        folders.append(site.getusersitepackages())
    return [*folders, *(path for folder in folders for path in _named_in(Path(folder)))]


def _named_in(folder: Path) -> Iterator[str]:
    for file in sorted(folder.glob("*.pth")):
        for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.strip() and not line.startswith(("#", "import ", "import\t")):
                yield str(folder / line.strip())


def _refuse_other_module(owners: str, entry: EntryPoint) -> None:
    """Raise InputError where Python would import another module than the distribution's."""
    top = entry.module.partition(".")[0]
    if top in sys.stdlib_module_names:
        raise InputError(f"{owners}: {entry.module} is one of Python's own modules")
    own = PathFinder.find_spec(top, _folders()) or _editable(top)
    usual = find_spec(top)
    if own is None or usual is None or _location(own) != _location(usual):
        where = "nowhere" if usual is None else usual.origin or _location(usual)[1]
        raise InputError(
            f"{owners}: Python finds its module {top!r} in {where}; allowed is the one that is "
            "installed: work in another folder, or take it out of PYTHONPATH"
        )


def _editable(top: str) -> ModuleSpec | None:
    """Return where an installation in editable mode has a module."""
    usual = (PathFinder, BuiltinImporter, FrozenImporter)
    for finder in sys.meta_path:
        spec = None if finder in usual else finder.find_spec(top, None)
        if spec is not None:
            return spec
    return None


def _location(spec: ModuleSpec) -> tuple[str | None, tuple[str, ...]]:
    return spec.origin, tuple(spec.submodule_search_locations or ())
