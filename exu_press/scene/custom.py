"""Kinds of joints and loads that users write, and the code that a name in a file stands for.

A name alone imports nothing. It stands for a class that is there already, or for one that an
installed distribution registers; else its module is imported only where the user allows that.
"""

import dataclasses
import re
import sys
import traceback
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

from exu_press.errors import InputError
from exu_press.schema.checks import Table, key

if TYPE_CHECKING:
    from exu_press.joints.interface import InterfaceLaw

__all__ = [
    "CustomJoint",
    "CustomKind",
    "UnresolvedJoint",
    "custom_class",
    "custom_modules",
    "import_kinds",
    "refusal",
    "with_unresolved",
]

IMPORTLIB = import_module.__code__.co_filename

PLACES = re.compile(r"(?:.*\.)?(?:joints|load)\.[^.]+(?:\.kind)?")
"""Dotted names of keys whose values are kinds, also where a study varies them."""


class CustomKind:
    """What the kinds that users write have in common: the name by which a scene calls them."""

    registered_name: ClassVar[str] = ""
    """Of the entry point by which an installed distribution offers it."""

    resolved: ClassVar[bool] = True
    """False for what stands in a result for a kind whose code is not loaded."""

    @property
    def kind(self) -> str:
        """Name of the class, as a scene has it."""
        return _name_of(type(self))


Kind = TypeVar("Kind", bound=CustomKind)


@dataclass(frozen=True)
class CustomJoint(CustomKind, Table, ABC):
    """Base of a joint kind of your own; `kind = "my_module:MyClass"` names it in a scene.

    The derived dataclass declares its keys by `exu_press.schema.checks.key`. A key whose default is
    None has to be given.
    """

    contact: ClassVar[None] = None
    friction: ClassVar[None] = None
    worn: ClassVar[None] = None
    onset: ClassVar[None] = None
    clearance: float = key(None, "eccentricity that others are compared with", "m", above=0)

    @abstractmethod
    def interfaces(self) -> Sequence["InterfaceLaw"]:
        """Return the interface laws that act in parallel; the first has the joint's clearance."""


@dataclass(frozen=True)
class UnresolvedJoint(CustomJoint):
    """A joint of a result whose kind is code that is not loaded: it is shown, and not built.

    Attributes:
        name: of the kind.
        keys: as the result has them.
    """

    resolved: ClassVar[bool] = False
    name: str = ""
    keys: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)

    @classmethod
    def of(cls, name: str, keys: Mapping[str, Any]) -> Self:
        """Return the joint of a kind and its keys."""
        clearance: Any = keys.get("clearance")
        return cls(clearance, name, keys)

    @property
    def kind(self) -> str:
        """Name of the class, as the result has it."""
        return self.name

    def interfaces(self) -> Sequence["InterfaceLaw"]:
        """Raise InputError: the laws are unknown."""
        raise InputError(refusal(self.name))


def custom_class(name: object, base: Any) -> type[Any] | None:
    """Return the class of a kind that a user has written; None for a text that is no such name.

    Args:
        name: of the kind, or the class itself.
        base: of such kinds.

    Raises:
        InputError: code of that name is not loaded, or the class is no such kind.
    """
    if isinstance(name, type) and issubclass(name, base):
        found: type[Any] | None = name
    elif not isinstance(name, str):
        return None
    else:
        found = _loaded(name, base)
        if found is None and ":" in name:
            derived = f"allowed is a dataclass derived from {base.__name__}"
            why = refusal(name) if _loaded(name, CustomKind) is None else derived
            raise InputError(f"kind = {name!r}: {why}")
        if found is None:
            from exu_press.scene.registered import registered_class  # seldom needed

            found = registered_class(name, base)
    missing = ", ".join(sorted(getattr(found, "__abstractmethods__", ())))
    if missing:
        raise InputError(
            f"kind = {name!r}: the class has no {missing}, which {base.__name__} asks for"
        )
    return found


def import_kinds(data: Mapping[str, Any]) -> None:
    """Import the modules of the kinds that a scene's or a study's tables name.

    Raises:
        InputError: a module is not there, fails, or is one of Python's own.
    """
    for name in dict.fromkeys(_kinds_in(data)):
        module, _, inside = name.partition(":")
        if _loaded(name, CustomKind) is not None:
            continue
        if module.partition(".")[0] in sys.stdlib_module_names or "__main__" in module.split("."):
            raise InputError(
                f"kind = {name!r}: allowed is a module of your own, not one of Python's or of a "
                "program"
            )
        try:
            found = vars(import_module(module)).get(inside)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # a module may raise anything, and SystemExit
            raise InputError(
                f"kind = {name!r}: {_told(error)}; allowed is a module that Python finds "
                "(PYTHONPATH names further folders) and one of its classes"
            ) from None
        if _loaded(name, CustomKind) is None:
            what = f"module {module!r} has no attribute {inside!r}"
            if isinstance(found, type) and issubclass(found, CustomKind):
                what = f"this class is {_name_of(found)!r}"
            elif found is not None:
                what = "this is no class derived from it"
            raise InputError(
                f"kind = {name!r}: {what}; allowed is a dataclass derived from CustomJoint or "
                "CustomLoad"
            )


def with_unresolved(
    data: Mapping[str, Any], tables: Mapping[str, tuple[Collection[str], Any]]
) -> dict[str, Any]:
    """Return a scene's tables, with what has a kind whose code is not loaded as unresolved.

    Args:
        data: of a result.
        tables: name of a table of tables -> kinds that need no code, and the class of the others.
    """
    changed = dict(data)
    for table, (known, unresolved) in tables.items():
        if not isinstance(data.get(table), Mapping):
            continue
        changed[table] = inner = dict(data[table])
        for name, given in data[table].items():
            keys = {"kind": given} if isinstance(given, str) else given
            if not isinstance(keys, Mapping) or not isinstance(kind := keys.get("kind"), str):
                continue
            if kind not in known and _loaded(kind, CustomKind) is None:
                inner[name] = unresolved.of(kind, {k: v for k, v in keys.items() if k != "kind"})
    return changed


def custom_modules(data: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the modules that a worker imports for the kinds that a scene's or a study's data name.

    Raises:
        InputError: a class is of the script itself or of a function, where no import finds it.
    """
    modules = set()
    kinds = (_loaded(name, CustomKind) for name in _kinds_in(data))
    for kind in filter(None, kinds):
        if kind.__module__ == "__main__" or "<locals>" in kind.__qualname__:
            raise InputError(
                f"kind = {_name_of(kind)!r}: workers of a study do not run the script that the "
                "class is in; allowed is a class at the top level of a module that it imports"
            )
        modules.add(kind.__module__)
    return tuple(sorted(modules))


def _name_of(kind: type[CustomKind]) -> str:
    return kind.registered_name or f"{kind.__module__}:{kind.__qualname__}"


def _loaded(name: str, base: type[Kind]) -> type[Kind] | None:
    """Return the class of a name among those that Python has made by now; the last one counts."""
    found = [kind for kind in _derived(base) if kind.resolved and _name_of(kind) == name]
    return found[-1] if found else None


def _derived(base: type[Kind]) -> Iterator[type[Kind]]:
    for kind in base.__subclasses__():
        yield kind
        yield from _derived(kind)


def _kinds_in(data: Any, path: str = "") -> Iterator[str]:
    """Yield the names of classes that tables give as kinds, in lists and under dotted keys, too."""
    if isinstance(data, Mapping):
        for name, value in data.items():
            yield from _kinds_in(value, f"{path}.{name}" if path else str(name))
    elif isinstance(data, list | tuple):
        for value in data:
            yield from _kinds_in(value, path)
    elif isinstance(data, str) and ":" in data and PLACES.fullmatch(path):
        yield data


def refusal(name: str) -> str:
    """Return why a kind is not loaded, and how that is allowed."""
    module = name.partition(":")[0]
    return (
        f"names code, the module {module!r}, and a file that names code runs it with all your "
        "rights; if you know what it does, allow it by --allow-code, in Python by "
        "Scene.load(..., allow_code=True), or import the module yourself"
    )


def _told(error: BaseException) -> str:
    """Return an error of an import in words, with file and line of the user's module."""
    kind = "" if isinstance(error, ImportError) else f"{type(error).__name__}: "
    own = [
        frame
        for frame in traceback.extract_tb(error.__traceback__)
        if not frame.filename.startswith("<") and frame.filename not in (__file__, IMPORTLIB)
    ]
    at = f"{own[-1].filename}, line {own[-1].lineno}: " if own else ""
    if isinstance(error, SyntaxError):
        at, error = f"{error.filename}, line {error.lineno}: ", SyntaxError(error.msg)
    return f"{at}{kind}{error}"
