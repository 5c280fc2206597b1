"""Kinds of joints, loads and laws that users write, and the code that a name in a file stands for.

A name alone imports nothing. It stands for a class that is there already, or for one that an
installed distribution registers; else its module is imported only where the user allows that.
"""

import re
import sys
import traceback
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any, ClassVar, TypeVar

from exu_press.errors import InputError
from exu_press.lazy import load_object

__all__ = [
    "CustomKind",
    "UnresolvedName",
    "custom_class",
    "custom_modules",
    "describe_own_error",
    "import_kinds",
    "is_loaded",
    "kind_module",
    "kind_name",
    "loaded_kinds",
    "refusal",
    "with_unresolved",
]

IMPORTLIB = import_module.__code__.co_filename

PLACES = {
    r"joints\.[^.]+(\.kind)?": "scene.joint:JOINT_KINDS",
    r"load\.[^.]+(\.kind)?": "scene.load:LOAD_KINDS",
    r"guide(\.[^.]+)?\.friction": "scene.friction:FRICTION",
    r"(joints\.[^.]+\.)?contact\.damping": "scene.contact:DAMPING",
    r"(joints\.[^.]+\.)?friction\.law": "scene.friction:FRICTION",
    r"(joints\.[^.]+\.)?film\.law": "scene.film:FILMS",
}
"""Dotted names of keys of a scene whose values are kinds -> where the package's own kinds are."""

OF_A_STUDY = re.compile(rf"(.*\.)?({'|'.join(PLACES)})")
"""The same keys where a study varies them."""


class UnresolvedName(str):
    """Name of a kind in a result, whose code is not loaded.

    Attributes:
        keys: that the result has beside it, of which some are the kind's.
    """

    keys: frozenset[str] = frozenset()


class CustomKind:
    """A kind that a scene calls by its name."""

    registered_name: ClassVar[Any] = ""
    """In the registry of its kinds, or of the entry point by which a distribution offers it."""

    resolved: ClassVar[bool] = True
    """False for what stands in a result for a kind whose code is not loaded."""

    when_unresolved: ClassVar[Mapping[str, Any]] = {}
    """Attributes of what stands there, beside those of the base; its other methods are refused."""

    @property
    def kind(self) -> str:
        """Name of the class, as a scene has it."""
        return kind_name(type(self))

    @property
    def module(self) -> str:
        """Module of a user's or another distribution's code that it is of; "" of ours."""
        return kind_module(type(self))


Kind = TypeVar("Kind", bound=CustomKind)


def custom_class(key: str, name: object, base: Any) -> type[Any] | None:
    """Return the class of a kind that a user has written; None for a text that is no such name.

    Raises:
        InputError: code of that name is not loaded, or the class is no such kind.
    """
    if isinstance(name, type) and issubclass(name, base):
        kind: type[Any] | None = name
    elif not isinstance(name, str):
        return None
    else:
        kind = _loaded_kind(name, base)
        if kind is None and ":" in name:
            derived = f"allowed is a dataclass derived from {base.__name__}"
            why = derived if is_loaded(name) else refusal(name)
            raise InputError(f"{key} = {name!r}: {why}")
        if kind is None:
            from exu_press.schema.registered import registered_class  # seldom needed

            kind = registered_class(key, name, base)
    missing = ", ".join(sorted(getattr(kind, "__abstractmethods__", ())))
    if missing:
        raise InputError(
            f"{key} = {name!r}: the class has no {missing}, which {base.__name__} asks for"
        )
    return kind


def import_kinds(data: Mapping[str, Any]) -> None:
    """Import the modules of the kinds that a scene's or a study's tables name.

    Raises:
        InputError: a module is not there, fails, or is one of Python's own.
    """
    for key, name in _kinds_in(data):
        module, colon, inside = name.partition(":")
        if not colon or is_loaded(name):
            continue
        if module.partition(".")[0] in sys.stdlib_module_names or "__main__" in module.split("."):
            raise InputError(
                f"{key} = {name!r}: allowed is a module of your own, not one of Python's or of a "
                "program"
            )
        try:
            kind = vars(import_module(module)).get(inside)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # a module may raise anything, and SystemExit
            raise InputError(
                f"{key} = {name!r}: {_error_text(error)}; allowed is a module that Python finds "
                "(PYTHONPATH names further folders) and one of its classes"
            ) from None
        if not is_loaded(name):
            what = f"module {module!r} has no attribute {inside!r}"
            if isinstance(kind, type) and issubclass(kind, CustomKind):
                what = f"this class is {kind_name(kind)!r}"
            elif kind is not None:
                what = "this is no class derived from it"
            raise InputError(
                f"{key} = {name!r}: {what}; allowed is a dataclass derived from CustomJoint, "
                "CustomLoad, ContactDamping, FrictionLaw or FilmLaw"
            )


def with_unresolved(data: Mapping[str, Any]) -> dict[str, Any]:
    """Return a result's tables, with an UnresolvedName for each kind whose code is not loaded."""
    tables: dict[str, Any] = _with_unresolved(data, data, {}, "")
    return tables


def _with_unresolved(
    data: Any, scene: Mapping[str, Any], beside: Mapping[str, Any], path: str
) -> Any:
    """Return data of a scene, at a dotted path in a table beside others, likewise."""
    if isinstance(data, Mapping):
        return {
            name: _with_unresolved(value, scene, data, f"{path}.{name}" if path else str(name))
            for name, value in data.items()
        }
    home = next((home for key, home in PLACES.items() if re.fullmatch(key, path)), None)
    if not isinstance(data, str) or home is None or data in load_object(home) or is_loaded(data):
        return data
    law, joints = home.partition(":")[0].rpartition(".")[2], scene.get("joints")
    owners = [scene, *(joints.values() if isinstance(joints, Mapping) else ())]
    laws = [owner.get(law) for owner in owners if isinstance(owner, Mapping)]
    tables = [beside] if path.endswith(".kind") else laws
    unresolved = UnresolvedName(data)
    unresolved.keys = frozenset(key for keys in tables if isinstance(keys, Mapping) for key in keys)
    return unresolved


def custom_modules(data: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the modules that a worker imports for the kinds that a scene's or a study's data name.

    Raises:
        InputError: a class is of the script itself or of a function, where no import finds it.
    """
    modules = set()
    kinds = (_loaded_kind(name, CustomKind) for _, name in _kinds_in(data))
    for kind in filter(None, kinds):
        if kind.__module__ == "__main__" or "<locals>" in kind.__qualname__:
            raise InputError(
                f"kind = {kind_name(kind)!r}: workers of a study do not run the script that the "
                "class is in; allowed is a class at the top level of a module that it imports"
            )
        modules.add(kind.__module__)
    return tuple(sorted(modules))


def kind_name(kind: type[CustomKind]) -> str:
    """Return the name by which a scene calls a class."""
    name: str = vars(kind).get("registered_name", "")
    return f"{kind.__module__}:{kind.__qualname__}" if name == "" else name


def kind_module(kind: type[CustomKind]) -> str:
    """Return the module of a class of a user or another distribution; "" of ours."""
    if not kind.resolved:  # its name may have the module
        module, colon, _ = kind_name(kind).partition(":")
        return module if colon else ""
    return "" if _is_ours(kind) else kind.__module__


def _loaded_kind(name: str, base: type[Kind]) -> type[Kind] | None:
    """Return the class of a name among those that Python has made by now; the last one counts."""
    kinds = [kind for kind in loaded_kinds(base) if kind_name(kind) == name]
    return kinds[-1] if kinds else None


def is_loaded(name: str) -> bool:
    """Return whether Python has made the class of a name by now."""
    return _loaded_kind(name, CustomKind) is not None


def loaded_kinds(base: Any) -> list[type[Any]]:
    """Return the kinds of users and other distributions that Python has made by now."""
    return [kind for kind in subclasses_of(base) if kind.resolved and not _is_ours(kind)]


def _is_ours(kind: type[Any]) -> bool:
    return kind.__module__.partition(".")[0] == "exu_press"


def subclasses_of(base: type[Kind]) -> Iterator[type[Kind]]:
    for kind in base.__subclasses__():
        yield kind
        yield from subclasses_of(kind)


def _kinds_in(data: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """Yield key and name of kinds in tables, in lists and dotted keys, too."""
    if isinstance(data, Mapping):
        for name, value in data.items():
            yield from _kinds_in(value, f"{path}.{name}" if path else str(name))
    elif isinstance(data, list | tuple):
        for value in data:
            yield from _kinds_in(value, path)
    elif isinstance(data, str) and OF_A_STUDY.fullmatch(path):
        yield path, data


def refusal(name: str) -> str:
    """Return why a kind is not loaded, and how that is allowed."""
    module = name.partition(":")[0]
    return (
        f"names code, the module {module!r}, and a file that names code runs it with all your "
        "rights; if you know what it does, allow it by --allow-code, in Python by "
        "Scene.load(..., allow_code=True), or import the module yourself"
    )


def describe_own_error(error: Exception) -> str | None:
    """Return an error in the code of a user's kind in words; None for an error elsewhere."""
    modules = [sys.modules.get(kind.__module__) for kind in loaded_kinds(CustomKind)]
    files = {getattr(module, "__file__", None) for module in modules}
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if frame.filename in files]
    if not own:
        return None
    return f"{_position(own)}{type(error).__name__}: {error}"


def _error_text(error: BaseException) -> str:
    """Return an error of an import in words, with file and line of the user's module."""
    kind = "" if isinstance(error, ImportError) else f"{type(error).__name__}: "
    own = [
        frame
        for frame in traceback.extract_tb(error.__traceback__)
        if not frame.filename.startswith("<") and frame.filename not in (__file__, IMPORTLIB)
    ]
    at = _position(own) if own else ""
    if isinstance(error, SyntaxError):
        at, error = f"{error.filename}, line {error.lineno}: ", SyntaxError(error.msg)
    return f"{at}{kind}{error}"


def _position(frames: list[traceback.FrameSummary]) -> str:
    """Return file and line of the innermost of some frames."""
    return f"{frames[-1].filename}, line {frames[-1].lineno}: "
