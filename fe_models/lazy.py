"""Names whose modules are loaded on first access."""

import importlib
import sys

TYPE_CHECKING = False  # that of typing takes longer to load than all of this

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

__all__ = ["lazy_names", "named_object"]


def lazy_names(package: str) -> "Callable[[str], Any]":
    """Return the `__getattr__` of a package.

    Its names are those that the package's file imports from its modules for type checkers alone.

    Args:
        package: its dotted name.
    """
    modules: dict[str, str] = {}

    def load(name: str) -> "Any":
        if not modules:
            modules.update(_imported_names(package))
        if name not in modules:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = named_object(f"{modules[name]}:{name}")
        setattr(sys.modules[package], name, value)
        return value

    return load


def named_object(name: str) -> "Any":
    """Return the class, function or other object "module:name"."""
    module, _, inside = name.partition(":")
    return getattr(importlib.import_module(module), inside)


def _imported_names(package: str) -> "dict[str, str]":
    """Return name -> module of all that a package's file imports from its modules."""
    import ast  # takes longer to load than this module, and is needed at the first name

    loader: Any = sys.modules[package].__loader__
    return {
        alias.name: node.module
        for node in ast.walk(ast.parse(loader.get_source(package)))
        if isinstance(node, ast.ImportFrom)
        and node.module
        and node.module.startswith(f"{package}.")
        for alias in node.names
    }
