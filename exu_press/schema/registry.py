"""Kinds by name, and parts of a table whose dataclass the table's keys choose."""

import dataclasses
import functools
from collections.abc import Callable, Collection, Iterator, Mapping
from keyword import iskeyword
from typing import Any

from exu_press.errors import InputError, MissingKeysError
from exu_press.lazy import load_object
from exu_press.schema.checks import key
from exu_press.schema.kinds import (
    CustomKind,
    UnresolvedName,
    custom_class,
    is_loaded,
    kind_name,
    loaded_kinds,
    refusal,
)

__all__ = ["Alternatives", "Choice", "Registry", "alternatives", "choice"]

PlaceOf = Callable[[str], str]
"""Name of a key in its table -> the dotted name that a message has for it."""


class Registry(Mapping[Any, type[Any]]):
    """Name of a kind -> its dataclass, whose module is imported when a scene names it."""

    def __init__(
        self,
        homes: Mapping[Any, str],
        base: str = "",
        convert: Callable[[Any], type[Any]] = lambda kind: kind,
    ) -> None:
        """Take "module:Class" for each name.

        Args:
            homes: within this package.
            base: class that kinds of other distributions and of users are derived from, likewise;
                "" where there are none.
            convert: class -> the dataclass that stands for it.
        """
        self.homes, self.base, self._convert = dict(homes), base, convert

    def __getitem__(self, name: Any) -> type[Any]:
        return self._convert(load_object(self.homes[name]))

    def __contains__(self, name: object) -> bool:
        return any(name == known and type(name) is type(known) for known in self.homes)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.homes)

    def __len__(self) -> int:
        return len(self.homes)

    def all_kinds(self) -> Iterator[tuple[Any, type[Any]]]:
        """Yield name and dataclass of all kinds, also of those from elsewhere that are loaded."""
        yield from self.items()
        if self.base:
            kinds = loaded_kinds(load_object(self.base))
            yield from ((kind_name(kind), self._convert(kind)) for kind in kinds)

    def choose(self, key: str, name: Any, keys: Collection[str] = ()) -> type[Any]:
        """Return the kind of a name, as `find` does; raise InputError where there is none."""
        kind = self.find(key, name, keys)
        if kind is None:
            allowed = "true or false" if True in self else f"one of {', '.join(map(repr, self))}"
            if name is None:
                path, _, last = key.rpartition(".")
                raise MissingKeysError([(path, f"{last}, {allowed}; give it in [{{path}}]")])
            raise InputError(f"{key} = {name!r:.200}: allowed is {allowed}")
        return kind

    def find(self, key: str, name: Any, keys: Collection[str] = ()) -> type[Any] | None:
        """Return the kind of a name, also one that users or distributions offer, or None.

        Args:
            key: that has the name, for messages.
            name: of the kind, or its class.
            keys: that a kind whose code is not loaded may have.

        Raises:
            InputError: the name stands for code that is not loaded, or for another class.
        """
        if name in self:
            return self[name]
        if not self.base:
            return None
        base = load_object(self.base)
        if isinstance(name, UnresolvedName) and not is_loaded(name):
            return self._convert(_unresolved_kind(base, name, tuple(sorted(name.keys & {*keys}))))
        kind = custom_class(key, name, base)
        return None if kind is None else self._convert(kind)


@functools.cache
def _unresolved_kind(base: Any, name: UnresolvedName, keys: tuple[str, ...]) -> type[Any]:
    """Return what stands for a kind whose code is not loaded, with keys of its table in a result.

    It is shown, not built.
    """

    def refuse(*_: Any, **__: Any) -> Any:
        raise InputError(f"{name!r}: {refusal(name)}")

    metadata = key(None, "of the kind", also=object).metadata
    known = {"kind", *(field.name for field in dataclasses.fields(base))}
    fields: list[Any] = [
        (name, Any, dataclasses.field(default=None, hash=False, metadata=metadata))
        for name in keys
        if name not in known and name.isidentifier() and not iskeyword(name)
    ]
    namespace = {"registered_name": name, "resolved": False}
    namespace |= dict.fromkeys(base.__abstractmethods__, refuse) | base.when_unresolved
    kind: type[Any] = dataclasses.make_dataclass(
        "UnresolvedKind", fields, bases=(base,), namespace=namespace, frozen=True
    )
    return kind


@dataclasses.dataclass(frozen=True)
class Choice:
    """A part of a table that the key of its own name chooses.

    Attributes:
        kinds: name -> dataclass.
    """

    kinds: Registry

    def select(self, key: str, path: str, keys: Mapping[str, Any], default: Any) -> type[Any]:
        """Return the dataclass that a table's keys choose, or else the default of the choosing key.

        Raises:
            InputError: there is no such kind.
        """
        return self.kinds.choose(path, keys.get(key, default), keys)

    def classes(self) -> Iterator[tuple[str, type[Any]]]:
        """Yield every name, as a scene file has it, with its dataclass."""
        for name, kind in self.kinds.all_kinds():
            yield str(name).lower() if isinstance(name, bool) else repr(name), kind

    def reason(self, key: str, place_of: PlaceOf, chosen: CustomKind, holders: list[str]) -> str:
        """Return why a key of other kinds, the holders, is not used beside the chosen one."""
        name = chosen.kind
        name_text = str(name).lower() if isinstance(name, bool) else repr(name)
        return f"{place_of(key)} is {name_text}; it belongs to {' or '.join(holders)}"


def _is_there(value: Any) -> bool:
    """Return whether the value of a key is neither None nor an empty list."""
    return value is not None and not (isinstance(value, list | tuple) and not value)


@dataclasses.dataclass(frozen=True)
class Alternatives:
    """A part of a table that the first of some keys chooses which is there.

    Attributes:
        homes: deciding key -> "module:Class"; "" where none of them is there, in which case the
            part may be None ("").
    """

    homes: Mapping[str, str]

    def select(
        self, key: str, path: str, keys: Mapping[str, Any], default: Any
    ) -> type[Any] | None:
        """Return the dataclass that a table's keys choose, or None."""
        home = next(
            (home for name, home in self.homes.items() if _is_there(keys.get(name))),
            self.homes.get("", ""),
        )
        return load_object(home) if home else None

    def classes(self) -> Iterator[tuple[str, type[Any]]]:
        """Yield every deciding key with its dataclass."""
        for name, home in self.homes.items():
            if home:
                yield name, load_object(home)

    def deciding_keys(self) -> dict[type[Any], set[str]]:
        """Return the keys that choose each dataclass; its own ones, where none decides."""
        keys: dict[type[Any], set[str]] = {}
        for name, kind in self.classes():
            own = {field.name for field in dataclasses.fields(kind)}
            keys.setdefault(kind, set()).update({name} if name else own)
        return keys

    def reason(self, key: str, place_of: PlaceOf, chosen: Any, holders: list[str]) -> str:
        """Return why a key of other kinds, the holders, is not used beside the chosen one."""
        order = list(self.homes)
        deciding = [
            n for n, home in self.homes.items() if home and load_object(home) is type(chosen)
        ]
        first = next((n for n in deciding if getattr(chosen, n, None) is not None), "")
        if (first and order.index(first) < order.index(holders[0])) or holders == [""]:
            because = getattr(chosen, "because", "")
            return f"{place_of(first)} is given{because and ': '}{because}"
        names = [place_of(name) for name in holders if name]
        return (
            f"{names[0]} is not given"
            if len(names) == 1
            else (f"neither {' nor '.join(names)} is given")
        )


def choice(default: Any, meaning: str, kinds: Registry, *, source: str = "") -> Any:
    """Declare a key whose value names the dataclass of a part of its table.

    In files the keys of that dataclass stand beside this one.
    """
    return dataclasses.field(
        default=default,
        metadata={
            **key(None, meaning, source=source).metadata,
            "choices": tuple(name for name in kinds if isinstance(name, str)),
            "part": Choice(kinds),
        },
    )


def alternatives(homes: Mapping[str, str]) -> Any:
    """Declare a part of a table whose dataclass those of its keys choose that are there.

    Args:
        homes: deciding key -> "module:Class"; "" for the dataclass without any of them.
    """
    return dataclasses.field(default=None, metadata={"part": Alternatives(dict(homes))})
