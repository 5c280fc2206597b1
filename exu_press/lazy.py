"""Names whose modules are loaded on first access."""

import importlib

TYPE_CHECKING = False  # that of typing takes longer to load than all of this

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

__all__ = ["lazy_names", "load_object"]


def lazy_names(package: str, names: "Mapping[str, str]") -> "Callable[[str], Any]":
    """Return the `__getattr__` of a package.

    Args:
        package: its dotted name.
        names: module of the package -> its names in the package, separated by blanks.
    """
    modules = {name: module for module, of_module in names.items() for name in of_module.split()}

    def load(name: str) -> "Any":
        if name not in modules:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(f"{package}.{modules[name]}"), name)
        setattr(importlib.import_module(package), name, value)
        return value

    return load


def load_object(home: str) -> "Any":
    """Return the class, function or other object "module:name" of this package."""
    module, _, name = home.partition(":")
    return getattr(importlib.import_module(f"exu_press.{module}"), name)
