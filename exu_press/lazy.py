"""Faces of packages whose names are loaded on first access."""

import importlib

TYPE_CHECKING = False  # that of typing takes longer to load than all of this

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

__all__ = ["lazy_names"]


def lazy_names(package: str, names: "Mapping[str, str]") -> "Callable[[str], Any]":
    """Return the `__getattr__` of a package's face.

    Args:
        package: its dotted name.
        names: module of the package -> names that it lends to the face, with blanks between.
    """
    homes = {name: module for module, lent in names.items() for name in lent.split()}

    def load(name: str) -> "Any":
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(f"{package}.{homes[name]}"), name)
        setattr(importlib.import_module(package), name, value)
        return value

    return load
