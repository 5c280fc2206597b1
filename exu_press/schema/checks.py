"""Keys of a scene: their allowed values, and the validation."""

import copy
import dataclasses
import difflib
import functools
import importlib
import itertools
import math
import numbers
import types
import typing
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sized
from typing import Any, ClassVar, Self, TypeVar

from exu_press.errors import InputError, UnusedKeyError

__all__ = [
    "RENAMED",
    "Table",
    "Uses",
    "as_float",
    "changed_table",
    "check_columns",
    "check_increasing",
    "demand_keys",
    "demand_known",
    "demand_name",
    "demand_number",
    "given_in",
    "inner",
    "key",
    "names_in",
    "nearest",
    "plain",
    "refuse_unknown",
    "table_from",
    "table_with",
]

T = TypeVar("T")

_fields: Callable[[Any], tuple[dataclasses.Field[Any], ...]] = functools.cache(dataclasses.fields)

SMALLEST, LARGEST = 1e-30, 1e30
"""Magnitudes of a number other than 0: sums and squares within them are numbers, too."""

Uses = Mapping[str, Mapping[Any, tuple[str, ...]]]

RENAMED = {
    "crank_pin": "joints.crank_pin",
    "balls": "joints.balls",
    "clearance": "joints.NAME.clearance",
    "contact.radius": "joints.NAME.radius",
    "flexible": "bodies.NAME",
    "blanking": "load.NAME with kind = 'blanking'",
    "guide.damping_depth": "contact.damping_depth",
    "woehler_stress": "sn_stress, of the S-N curve",
    "woehler_cycles": "sn_cycles, of the S-N curve",
    "woehler_slope": "sn_slope, of the S-N curve",
    "guide.slider_inertia": "a key of [press] or [slider_crank]",
    "guide.slide_inertia": "press.slide_inertia",
    "guide.counterweight_inertia": "press.counterweight_inertia",
}
"""Old keys -> new ones, in words."""


def key(
    default: Any,
    meaning: str,
    unit: str = "",
    *,
    above: float | None = None,
    at_least: float | None = None,
    at_most: float | None = None,
    choices: tuple[str, ...] = (),
    also: type | None = None,
    numbers: int | None = None,
    source: str = "",
    example: object = None,
) -> Any:
    """Declare one key of a scene table: its default, meaning, unit and allowed range.

    `also` is a class whose objects are allowed as they are; `numbers` says that the value is a list
    of so many numbers, of any number of them where that is 0. `source` says where a default is
    from that decides results; `example` is shown where a key has none and is needed.
    """
    metadata = {
        "meaning": meaning,
        "unit": unit,
        "above": above,
        "at_least": at_least,
        "at_most": at_most,
        "choices": choices,
        "also": also,
        "numbers": numbers,
        "source": source,
        "example": example,
    }
    return dataclasses.field(default=default, metadata=metadata)


def _allowed(field: dataclasses.Field[Any]) -> str:
    meta = field.metadata
    if meta.get("choices"):
        also = f", or {meta['meaning']}" if meta.get("also") else ""
        return "one of " + ", ".join(repr(choice) for choice in meta["choices"]) + also
    if meta.get("numbers") is not None:
        count = f"{meta['numbers']} numbers" if meta["numbers"] else "numbers"
        return f"a list of {count} ({meta['meaning']}{', ' + meta['unit'] if meta['unit'] else ''})"
    kind = _kind(field)
    noun = {float: "a number", int: "a whole number", bool: "true or false", str: "a text"}[kind]
    bounds = [
        f"{sign} {meta[name]:g}"
        for name, sign in (("above", ">"), ("at_least", ">="), ("at_most", "<="))
        if meta.get(name) is not None
    ]
    text = " ".join([noun, " and ".join(bounds)]).strip()
    return f"{text} ({meta['meaning']}{', ' + meta['unit'] if meta['unit'] else ''})"


@dataclasses.dataclass(frozen=True)
class Table:
    """A table of the scene: frozen, and checked once, when it is made."""

    table: ClassVar[str] = ""

    uses: ClassVar[Uses] = {}
    """Key that is a choice -> the choice -> the keys that only some choices use."""

    instead: ClassVar[Mapping[str, str]] = {}
    """Key -> the key that it stands instead of; a table has one of the two at most."""

    required: ClassVar[tuple[str, ...]] = ()
    """Keys without a default."""

    def __new__(cls, *values: Any, **keys: Any) -> Self:
        """Remember which keys are given, so that a default gives way to a mechanism's own."""
        made = super().__new__(cls)
        names = [field.name for field in _fields(cls)][: len(values)]
        object.__setattr__(made, "_given", frozenset([*names, *keys]))
        return made

    @property
    def given(self) -> dict[str, Any]:
        """The keys that were given, with their values."""
        names: frozenset[str] = self._given  # type: ignore[attr-defined]
        values = {f.name: getattr(self, f.name) for f in _fields(type(self))}
        return {name: v for name, v in values.items() if name in names and v is not None}

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that this table does not use -> the reason.

        Args:
            instead: other choices than the table's own.
        """
        found = {}
        for choice, by_chosen in self.uses.items():
            chosen = instead.get(choice, getattr(self, choice))
            used = by_chosen[chosen]
            for key in itertools.chain(*by_chosen.values()):
                if key not in used:
                    shown = str(chosen).lower() if isinstance(chosen, bool) else repr(chosen)
                    found[key] = f"{self.table}.{choice} is {shown}"
        return found

    def without(self, unused: Iterable[str]) -> Self:
        """Return the table with None for keys that are not used."""
        other = copy.copy(self)
        for name in unused:
            object.__setattr__(other, name, None)
        return other

    def __post_init__(self) -> None:
        """Check every key; raise InputError for the first one that is not allowed."""
        for field in _fields(type(self)):
            if "inner" in field.metadata and (given := getattr(self, field.name)) is not None:
                name = f"{self.table}.{field.name}"
                object.__setattr__(self, field.name, _inner(_inner_table(field), name, given))
            if "meaning" in field.metadata:
                name = f"{self.table}.{field.name}" if self.table else field.name
                value = _checked(field, name, getattr(self, field.name))
                if value is None and field.name in self.required:
                    raise InputError(f"{name}: missing; allowed is {_allowed(field)}")
                object.__setattr__(self, field.name, value)
        for one, other in self.instead.items():
            if None not in (getattr(self, one), getattr(self, other)):
                place = f"{self.table}." if self.table else ""
                raise InputError(f"{place}{other} and {place}{one}: allowed is one of the two")


def _inner(kind: type[Any], name: str, given: Any) -> Any:
    """Return a table within a table, without the keys that it does not use."""
    table: Table = table_from(kind, name, given)
    idle = table.unused()
    for key, value in table.given.items():
        if key in idle:
            raise UnusedKeyError(f"{name}.{key}", f"{name}.{key} = {value!r}", idle[key])
    return table


def inner(home: str) -> Any:
    """Declare a table within a table, "module:Class", loaded where it is given; None elsewhere."""
    return dataclasses.field(default=None, metadata={"inner": home})


def _inner_table(field: dataclasses.Field[Any]) -> type[Any]:
    module, _, name = field.metadata["inner"].partition(":")
    table: type[Any] = getattr(importlib.import_module(module), name)
    return table


def _checked(field: dataclasses.Field[Any], name: str, value: Any) -> Any:
    """Return the value of one key in its declared type, or raise InputError.

    A whole number is taken for a number; nothing else is converted, clamped or defaulted.
    """
    if value is None and field.default is None:
        return None
    if field.metadata.get("also") and isinstance(value, field.metadata["also"]):
        return value
    if field.metadata.get("numbers") is not None:
        return _numbers(field, name, value)
    kind = _kind(field)
    if not isinstance(value, bool):
        if kind is float and isinstance(value, numbers.Real):
            value = as_float(value)
        elif kind is int and isinstance(value, numbers.Integral):
            value = int(value)
    meta = field.metadata
    right = (
        type(value) is kind
        and (kind is not float or _within(typing.cast(float, value)))
        and (meta["above"] is None or value > meta["above"])
        and (meta["at_least"] is None or value >= meta["at_least"])
        and (meta["at_most"] is None or value <= meta["at_most"])
        and (not meta["choices"] or value in meta["choices"])
    )
    if not right:
        raise InputError(
            f"{name} = {value!r:.200}: allowed is {_allowed(field)}{_magnitudes(value)}"
        )
    return value


def _numbers(field: dataclasses.Field[Any], name: str, value: Any) -> tuple[float, ...]:
    """Return a list of finite numbers as a tuple, or raise InputError."""
    count = field.metadata["numbers"]
    if isinstance(value, list | tuple) and (not count or len(value) == count):
        found = [
            as_float(each)
            if isinstance(each, numbers.Real) and not isinstance(each, bool)
            else math.nan
            for each in value
        ]
        if all(map(_within, found)):
            return tuple(found)
    raise InputError(f"{name} = {value!r:.80}: allowed is {_allowed(field)}{_magnitudes(value)}")


def demand_name(where: str, name: Any) -> None:
    """Raise InputError unless files, tables and commands can hold a name as it is."""
    if not isinstance(name, str) or not (name.isidentifier() and name.isascii()):
        raise InputError(
            f"{where}: {name!r:.80} is no name; allowed are digits, _ and letters from a to z, "
            "large or small"
        )


def demand_number(where: str, value: Any) -> None:
    """Raise InputError unless a value is a number of an allowed magnitude."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not _within(value):
        raise InputError(f"{where} = {value!r:.80}: allowed is a number{_magnitudes(value)}")


def _within(value: float) -> bool:
    return value == 0.0 or SMALLEST <= abs(value) <= LARGEST


def _magnitudes(value: Any) -> str:
    """Return which magnitudes are allowed, where a number, or one of a list, has none of them."""
    each = value if isinstance(value, list | tuple) else [value]
    if all(_within(one) for one in each if type(one) is float and math.isfinite(one)):
        return ""
    return f"; a number is 0, or its magnitude is within {SMALLEST:g} and {LARGEST:g}"


def as_float(value: Any) -> float:
    """Return a number as a float; infinite where it is larger than any."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def demand_keys(place: str, table: Table, keys: Collection[str], law: str, where: str) -> None:
    """Raise InputError for the first of some keys that a table does not have.

    Args:
        place: that needs them.
        table: with them.
        keys: that are needed, each with an example.
        law: name of the table in the message, if it has one.
        where: they may be given.
    """
    for field in dataclasses.fields(table):
        if field.name in keys and getattr(table, field.name) is None:
            example = field.metadata.get("example")
            if isinstance(example, float):
                example = f"{example:g}"
            shown = "" if example is None else f", as in {field.name} = {example}"
            meta, name = field.metadata, f"{law}.{field.name}".lstrip(".")
            raise InputError(
                f"{place} needs {name} ({meta['meaning']}, {meta['unit']}), which decides its "
                f"result and has no default; give it in {where}{shown}"
            )


def table_from(table: type[T], name: str, data: Any) -> T:
    """Return the table `name` of a scene from a mapping of its keys ("" is the scene itself)."""
    if isinstance(data, table):
        return data
    if not isinstance(data, Mapping):
        raise InputError(f"{name} = {data!r:.200}: allowed is a table of keys")
    known = [field.name for field in _fields(table)]
    for given in data:
        path = f"{name}.{given}" if name else given
        if given not in known and {path, given} & RENAMED.keys():
            now = RENAMED.get(path) or RENAMED[given]
            raise InputError(f"{path} = {data[given]!r:.200}: is {now} now")
    refuse_unknown(name, data, known)
    return table(**data)


def refuse_unknown(where: str, given: Mapping[str, Any], known: Collection[str]) -> None:
    """Raise InputError for the first key of a table that is not known."""
    for name, value in given.items():
        if name not in known:
            place = f"{where}.{name}" if where else name
            demand_known(f"{place} = {value!r:.200}: unknown key", name, known)


MOST_NAMES, LIKE = 24, 8
"""Names that a message lists; with more of them so many that are like the one in question."""


def demand_known(said: str, name: Any, known: Iterable[str]) -> None:
    """Raise InputError, with the nearest and all known names behind it, unless a name is known.

    Of many known names only some that are most like it.
    """
    if name not in (names := list(known)):
        shown, rest = names, ""
        if len(names) > MOST_NAMES:
            shown = difflib.get_close_matches(str(name), names, n=LIKE, cutoff=0.3) or names[:LIKE]
            rest = f" and {len(names) - len(shown)} others"
        raise InputError(f"{said}{nearest(name, names)}; allowed are {', '.join(shown)}{rest}")


def table_with(table: type[T], name: str, data: Any, usual: Mapping[str, Any]) -> T:
    """Return the table `name` of a scene; keys that `data` lacks are as in `usual`."""
    if isinstance(data, table):
        data = typing.cast(Table, data).given
    if isinstance(data, Mapping):
        data = changed_table(typing.cast(type[Table], table), usual, data)
    return table_from(table, name, data)


def changed_table(
    kind: type[Table], before: Mapping[str, Any], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a table's keys with others; a key whose place another one takes is dropped.

    Args:
        kind: of the table.
        before: its keys.
        changes: key -> value; "TABLE.key" of a table within it, too, and "KEY.PLACE.key" where a
            key has a table for each of several places.
    """
    found = dict(before)
    inners = {f.name: f for f in _fields(kind) if "inner" in f.metadata}
    by_place = {f.name for f in _fields(kind) if f.metadata.get("by_place")}
    for path, value in changes.items():
        name, dot, rest = path.partition(".")
        change: Any = {rest: value} if dot else value
        if name in inners and isinstance(change, Mapping | Table):
            table = _inner_table(inners[name])
            found[name] = changed_table(table, given_in(found.get(name)), given_in(change))
        elif dot and name in by_place:
            at, _, key_there = rest.partition(".")
            there = given_in(found.get(name))
            change = {**given_in(there.get(at)), key_there: value} if key_there else value
            found[name] = {**there, at: change}
        else:
            found[path] = value
    given = {path.partition(".")[0] for path, value in changes.items() if value is not None}
    for kept, dropped in kind.instead.items():
        if kept in given and dropped not in given:
            found.pop(dropped, None)
    return found


def plain(table: Table) -> dict[str, Any]:
    """Return the keys of a table that are not None as a nested mapping, as a file has them."""
    found: dict[str, Any] = {}
    for field in _fields(type(table)):
        value = getattr(table, field.name)
        if isinstance(value, Table):
            found[field.name] = plain(value)
        elif value is not None:
            found[field.name] = list(value) if isinstance(value, tuple) else value
    return found


def given_in(table: Any) -> dict[str, Any]:
    """Return the keys that a table gives, as a mapping or as its dataclass; none of None."""
    keys = table.given if isinstance(table, Table) else table or {}
    return dict(keys) if isinstance(keys, Mapping) else {}


def names_in(table: Any, place: str = "") -> Iterator[str]:
    """Yield the dotted names of the keys that a table gives, and of those of tables within it."""
    for name, value in given_in(table).items():
        if value is not None:
            yield place + name
            yield from names_in(value, f"{place}{name}.")


def check_columns(names: tuple[str, str], one: Sized, other: Sized) -> None:
    """Raise InputError unless two columns of a curve are of one length, two or more."""
    if len(one) < 2 or len(one) != len(other):
        raise InputError(
            f"{', '.join(names)}: {len(one)} and {len(other)} values; allowed are at least two, "
            "as many of both"
        )


def check_increasing(name: str, values: Iterable[float]) -> None:
    """Raise InputError for the first value that is not larger than the one before."""
    for before, after in itertools.pairwise(values):
        if not after > before:
            raise InputError(f"{name} = {after!r} after {before!r}: allowed is increasing")


def nearest(name: Any, known: Iterable[str]) -> str:
    """Return a question after the known name that is most like a misspelt one, or nothing.

    >>> nearest("viscocity", ["law", "viscosity"])
    " (did you mean 'viscosity'?)"
    """
    found = difflib.get_close_matches(str(name), list(known), n=1)
    return f" (did you mean {found[0]!r}?)" if found else ""


@functools.cache
def _kind(field: dataclasses.Field[Any]) -> type:
    kinds = typing.get_args(field.type) or (field.type,)
    return next(kind for kind in kinds if isinstance(kind, type) and kind is not types.NoneType)
