"""Tables of a scene: frozen dataclasses, made from the keys of a file and checked once."""

import dataclasses
import functools
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any, ClassVar, Self, TypeVar

from exu_press.errors import InputError, MissingKeysError, Need, UnusedKeyError, error_prefix
from exu_press.lazy import load_object
from exu_press.schema.checks import checked_value, demand_known, nearest
from exu_press.schema.kinds import UnresolvedName
from exu_press.schema.registry import Alternatives, Choice

__all__ = [
    "RENAMED",
    "Table",
    "changed_table",
    "changed_tables",
    "check_keys",
    "declared_keys",
    "dotted_name",
    "given_keys",
    "given_names",
    "key_values",
    "missing_keys",
    "need_text",
    "nested_table",
    "plain",
    "plain_value",
    "refuse_unknown_keys",
    "resolve",
    "set_key",
    "table_from",
    "tables_by_name",
    "tables_from",
    "unused_reason",
    "used_names",
]

T = TypeVar("T", bound="Table")
Field = dataclasses.Field[Any]

_fields: Callable[[Any], tuple[Field, ...]] = functools.cache(dataclasses.fields)

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


@dataclasses.dataclass(frozen=True)
class Table:
    """A table of the scene: frozen, and checked once, when it is made.

    A field declared by `choice` or `alternatives` is a part of it: a table of its own, whose keys
    stand beside the others in files.
    """

    table: ClassVar[str] = ""

    exclusive: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Pairs of keys, of each of which a table has one at most."""

    required: ClassVar[tuple[str, ...]] = ()
    """Keys without a default."""

    needed: ClassVar[tuple[str, ...]] = ()
    """Keys that decide the result and have no default; asked for where the table is used."""

    def __new__(cls, *values: Any, **keys: Any) -> Self:
        """Remember which keys are given, so that a default gives way to a mechanism's own."""
        table = super().__new__(cls)
        names = [field.name for field in _fields(cls)][: len(values)]
        object.__setattr__(table, "_given", frozenset([*names, *keys]))
        return table

    @property
    def given_values(self) -> dict[str, Any]:
        """The keys that were given, with their values."""
        names: frozenset[str] = self._given  # type: ignore[attr-defined]
        keys: dict[str, Any] = {}
        for field in _fields(type(self)):
            value = getattr(self, field.name)
            if "part" in field.metadata:
                if value is not None:
                    if field.name in names and _is_key(field):
                        keys[field.name] = value.kind
                    keys |= value.given_values
            elif "by_name" in field.metadata:
                keys |= value
            elif field.name in names and value is not None:
                keys[field.name] = value
        return keys

    def __post_init__(self) -> None:
        """Check every key; raise InputError for the first wrong one, or all that are missing."""
        missing: dict[str, Field] = {}
        for field in _fields(type(self)):
            name = dotted_name(self.table, field.name)
            value, meta = getattr(self, field.name), field.metadata
            if "part" in meta:
                if not isinstance(value, Table):
                    keys = {} if value is None else {field.name: value}
                    value = _resolve_part(type(self), field, self.table, keys)
            elif "nested" in meta and value is not None:
                value = table_from(load_object(meta["nested"]), name, value)
            elif "meaning" in meta:
                value = _value_of_key(field, name, value)
                if value is None and field.name in self.required:
                    missing[field.name] = field
            object.__setattr__(self, field.name, value)
        if missing:
            path = self.table or type(self).__name__
            raise MissingKeysError([(path, need_text(missing, "", "[{path}]"))])
        for pair in self.exclusive:
            if None not in (getattr(self, key, None) for key in pair):
                names = " and ".join(dotted_name(self.table, key) for key in pair)
                raise InputError(f"{names}: allowed is one of the two")

    def refuse_unused(self, keys: Collection[str], reason: str) -> None:
        """Raise UnusedKeyError for the first of some keys that is given, all without default."""
        for key in keys:
            if (value := getattr(self, key)) is not None:
                name = dotted_name(self.table, key)
                raise UnusedKeyError(name, f"{name} = {value!r}", reason)


def tables_by_name() -> Any:
    """Declare further tables within a table, which stand beside its keys: name -> their keys."""
    return dataclasses.field(default_factory=dict, hash=False, metadata={"by_name": True})


def nested_table(home: str) -> Any:
    """Declare a table within a table, "module:Class", loaded where it is given; None elsewhere."""
    return dataclasses.field(default=None, metadata={"nested": home})


def _is_key(field: Field) -> bool:
    """Return whether a field is a key of its table, also one that chooses a part of it."""
    meta = field.metadata
    return "meaning" in meta or not ("part" in meta or "by_name" in meta)


def _parts(kind: type["Table"]) -> list[tuple[Field, Choice | Alternatives]]:
    """Return the fields of a table that are parts of it, each with what chooses it."""
    return [(f, f.metadata["part"]) for f in _fields(kind) if "part" in f.metadata]


def _value_of_key(field: Field, name: str, value: Any) -> Any:
    """Return the value of a key in its declared type; raise InputError for one not allowed."""
    if value is not None and "list_of" in field.metadata:
        return tables_from(load_object(field.metadata["list_of"]), name, value)
    return checked_value(field, name, value)


def tables_from(kind: type[T], name: str, value: Any) -> tuple[T, ...]:
    """Return the tables of a list; the name of each has its number."""
    if not isinstance(value, list | tuple) or not value:
        raise InputError(f"{name} = {value!r:.200}: allowed is a list of tables, [[{name}]]")
    tables, needs = list[T](), list[Need]()
    for path, entry in ((f"{name}.{k}", entry) for k, entry in enumerate(value)):
        try:
            tables.append(table_from(kind, path, entry))
        except MissingKeysError as error:
            needs += [(path, text.replace("[{path}]", "[[{list}]]")) for _, text in error.needs]
    if needs:
        raise MissingKeysError(needs)
    return tuple(tables)


def dotted_name(path: str, key: str) -> str:
    """Return the name of a key in the table `place`, "" of the scene itself."""
    return f"{path}.{key}" if path else key


def table_from(kind: type[T], name: str, data: Any) -> T:
    """Return the table `name` of a scene from its keys, or as it is; "" is the scene itself.

    Raises:
        InputError: a key is unknown, not used by the others or not allowed.
    """
    if isinstance(data, kind):
        return data
    keys, tables = _split_tables_by_name(kind, name, _as_keys(name, data))
    used = used_names(kind, name, keys)
    refuse_unknown_keys([kind], name, keys, used)
    table = resolve(kind, name, {**keys, **tables})
    for key, value in keys.items():
        if key not in used and value is not None:
            path = dotted_name(name, key)
            reason = unused_reason(table, key, lambda key: dotted_name(table.table, key)) or ""
            if isinstance(value, list | tuple) and not value:
                reason = "an empty list is as good as none"
            raise UnusedKeyError(path, f"{path} = {value!r}", reason)
    return table


def _split_tables_by_name(
    kind: type[Table], name: str, keys: Mapping[str, Any]
) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """Return the keys of a table, and by their field the tables by name that stand beside them."""
    field = next((f for f in _fields(kind) if "by_name" in f.metadata), None)
    if field is None:
        return keys, {}
    tables = {key: value for key, value in keys.items() if isinstance(value, Mapping | Table)}
    for key in tables.keys() & declared_keys(kind).keys():
        raise InputError(
            f"{name}.{key}: is a key of [{name}], so that a {name} of this name has no table; "
            "allowed is another name in the drawing"
        )
    rest = {key: value for key, value in keys.items() if key not in tables}
    return rest, {field.name: {key: given_keys(value) for key, value in tables.items()}}


def used_names(kind: type[Table], name: str, keys: Mapping[str, Any]) -> set[str]:
    """Return the names of the keys that the table of some keys may have."""
    names = {field.name for field in _fields(kind) if _is_key(field)}
    for field, _ in _parts(kind):
        chosen = _kind_of_part(kind, field, name, keys)
        names |= set() if chosen is None else used_names(chosen, name, keys)
    return names


def resolve(kind: type[T], name: str, keys: Mapping[str, Any]) -> T:
    """Return the table `name` from those of some keys that it uses."""
    values: dict[str, Any] = {}
    for field in _fields(kind):
        if "part" in field.metadata:
            values[field.name] = _resolve_part(kind, field, name, keys)
        elif field.name in keys:
            values[field.name] = keys[field.name]
    table = kind(**values)
    object.__setattr__(table, "_given", frozenset(keys))
    return table


def _resolve_part(
    table: type[Table], field: Field, name: str, keys: Mapping[str, Any]
) -> Table | None:
    kind = _kind_of_part(table, field, name, keys)
    return None if kind is None else resolve(kind, name, keys)


def _kind_of_part(
    table: type[Table], field: Field, name: str, keys: Mapping[str, Any]
) -> type[Table] | None:
    """Return the dataclass that some keys choose for a part of a table."""
    if isinstance(keys.get(field.name), UnresolvedName):  # all other keys may be its own
        keys = {key: value for key, value in keys.items() if key not in _keys_beside(table, field)}
    path = dotted_name(name, field.name)
    kind: type[Table] | None = field.metadata["part"].select(field.name, path, keys, field.default)
    return kind


def _keys_beside(table: type[Table], chosen: Field) -> set[str]:
    """Return the keys of a table that are not of one of its parts."""
    names = {field.name for field in _fields(table)} - {chosen.name}
    kinds = (selector.classes() for field, selector in _parts(table) if field is not chosen)
    return names.union(*(declared_keys(kind) for classes in kinds for _, kind in classes))


def _as_keys(name: str, data: Any) -> Mapping[str, Any]:
    if not isinstance(data, Mapping):
        raise InputError(f"{name} = {data!r:.200}: allowed is a table of keys")
    return data


def refuse_unknown_keys(
    kinds: Collection[type[Table]], name: str, keys: Mapping[str, Any], used: Collection[str]
) -> None:
    """Raise InputError for the first key that is not used, and that no table of some kinds has."""
    for key, value in keys.items():
        if key in used:
            continue
        path = dotted_name(name, key)
        known = [*(name for kind in kinds for name in declared_keys(kind)), *sorted(used)]
        if key not in known and {path, key} & RENAMED.keys():
            now = RENAMED.get(path) or RENAMED[key]
            raise InputError(f"{path} = {value!r:.200}: is {now} now")
        allowed = {*used, *(name for kind in kinds for name in _choosing_keys(kind, used))}
        text = f"{path} = {value!r:.200}: unknown key"
        has_names = any("by_name" in field.metadata for kind in kinds for field in _fields(kind))
        if has_names and isinstance(value, str) and not nearest(key, known):
            own = f"{name}.NAME" if key == "kind" else path
            text += f" (one {name} has a table, as {own} = {{kind = {value!r:.200}}})"
        demand_known(text, key, dict.fromkeys(known), allowed)


def _choosing_keys(kind: type[Table], used: Collection[str]) -> Iterator[str]:
    """Yield the keys that choose parts of a table, and of those of its parts that are used."""
    for _, selector in _parts(kind):
        if isinstance(selector, Alternatives):
            yield from filter(None, selector.homes)
        for _, inner in selector.classes():
            own = {f.name for f in _fields(inner) if "part" not in f.metadata}
            if own <= {*used}:
                yield from _choosing_keys(inner, used)


def unused_reason(table: Table, key: str, place_of: Callable[[str], str]) -> str | None:
    """Return why a complete table does not use a key, or None where no choice has it."""
    for field, selector in _parts(type(table)):
        value = getattr(table, field.name)
        if value is not None and (reason := unused_reason(value, key, place_of)) is not None:
            return reason
        holders = [name for name, kind in selector.classes() if key in declared_keys(kind)]
        if holders:
            return selector.reason(field.name, place_of, value, holders)
    return None


def check_keys(
    kinds: Collection[type[Table]], name: str, data: Any, more_names: Collection[str] = ()
) -> dict[str, Any]:
    """Return the keys of a table which some of several kinds of tables may use, checked.

    Keys of more names are known beside those, and not checked.

    Raises:
        InputError: a key is none of theirs, or its value is not allowed.
    """
    keys = dict(_as_keys(name, data))
    names = {key for kind in kinds for key in used_names(kind, name, keys)}
    refuse_unknown_keys(kinds, name, keys, names | {*more_names})
    tables = [resolve(kind, name, keys) for kind in kinds]
    used = {key: value for table in tables for key, value, _ in key_values(table)}
    for key, value in keys.items():
        if key in used:
            keys[key] = used[key]
            continue
        field = next((f for k in kinds for n, f in declared_keys(k).items() if n == key), None)
        if field is not None and "meaning" in field.metadata:
            keys[key] = _value_of_key(field, dotted_name(name, key), value)
    return keys


def key_values(table: Table) -> Iterator[tuple[str, Any, Field]]:
    """Yield every key that a table uses with its value and declaration; of a part its own, too."""
    for field in _fields(type(table)):
        value, is_part = getattr(table, field.name), "part" in field.metadata
        if "by_name" in field.metadata:
            yield from ((name, keys, field) for name, keys in value.items())
        elif _is_key(field):
            yield field.name, value.kind if is_part else value, field
        if is_part and value is not None:
            yield from key_values(value)


def declared_keys(kind: type[Table]) -> Mapping[str, Field]:
    """Return every key that a table may have, of all kinds of its parts, with its declaration."""
    keys: dict[str, Field] = {}
    for field in _fields(kind):
        if _is_key(field):
            keys.setdefault(field.name, field)
        if "part" in field.metadata:
            for _, inner in field.metadata["part"].classes():
                keys |= {n: f for n, f in declared_keys(inner).items() if n not in keys}
    return keys


def missing_keys(
    path: str, table: Table, keys: Collection[str], law: str, where: str
) -> list[Need]:
    """Return what a place needs of those of some keys that a table, or lists in it, do not have.

    Args:
        path: dotted name of what needs them.
        table: with them.
        keys: that are needed, each with an example, beside those that the table itself needs.
        law: name of the table in the message, if it has one.
        where: they may be given; {path} stands for the name.
    """
    missing = _missing_keys(table, keys)
    return [(path, need_text(missing, law, where))] if missing else []


def _missing_keys(table: Table, keys: Collection[str]) -> dict[str, Field]:
    needed, missing = {*keys, *_needed_keys(table)}, dict[str, Field]()
    for name, value, field in key_values(table):
        if value is None and name in needed:
            missing[name] = field
        for number, entry in enumerate(value if value and "list_of" in field.metadata else ()):
            inner = _missing_keys(entry, ())
            missing |= {f"{name}.{number}.{key}": inner[key] for key in inner}
    return missing


def need_text(missing: Mapping[str, Field], law: str, where: str) -> str:
    """Return which keys are needed, and where they may be given."""
    names, examples = [], []
    for name, field in missing.items():
        meta = field.metadata
        unit, example = f"; in {meta['unit']}" if meta["unit"] else "", meta.get("example")
        names.append(f"{dotted_name(law, name)} ({meta['meaning']}{unit})")
        if example is not None:
            value = f"{example:g}" if isinstance(example, float) else example
            examples.append(f"{name} = {value}")
    decides, it = (
        ("decides the result and has", "it")
        if len(names) == 1
        else ("decide the result and have", "them")
    )
    example_text = f", as in {', '.join(examples)}" if examples else ""
    return f"{', '.join(names)}, which {decides} no default; give {it} in {where}{example_text}"


def _needed_keys(table: Table) -> set[str]:
    parts = [getattr(table, field.name) for field, _ in _parts(type(table))]
    return {*table.needed}.union(*(_needed_keys(inner) for inner in parts if inner is not None))


def changed_table(
    kind: type[Table], keys: Mapping[str, Any], changes: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a table's keys with others; a key whose place another one takes is dropped.

    Args:
        kind: of the table.
        keys: of the table.
        changes: key -> value; "TABLE.key" of a table within it, too, and "KEY.PLACE.key" where a
            key has a table for each of several places.
    """
    changed = dict(keys)
    inner_tables = {f.name: f for f in _fields(kind) if "nested" in f.metadata}
    by_place = {f.name for f in _fields(kind) if f.metadata.get("by_place")}
    has_names = any("by_name" in f.metadata for f in _fields(kind))
    for path, value in changes.items():
        name, dot, rest = path.partition(".")
        change: Any = {rest: value} if dot else value
        if name in inner_tables and isinstance(change, Mapping | Table):
            inner = load_object(inner_tables[name].metadata["nested"])
            changed[name] = changed_table(inner, given_keys(changed.get(name)), given_keys(change))
        elif dot and name in by_place:
            at, _, key_there = rest.partition(".")
            there = given_keys(changed.get(name))
            change = {**given_keys(there.get(at)), key_there: value} if key_there else value
            changed[name] = {**there, at: change}
        elif dot and has_names:
            changed[name] = changed_table(kind, given_keys(changed.get(name)), change)
        else:
            with error_prefix(f"{kind.table}." * bool(kind.table)):
                set_key(changed, path, value)
    names = {path.partition(".")[0] for path, value in changes.items() if value is not None}
    for first, second in kind.exclusive:
        if (first in names) != (second in names):
            changed.pop(second if first in names else first, None)
    for key in _replaced_keys(kind, names):
        changed.pop(key, None)
    return changed


def set_key(keys: dict[str, Any], path: str, value: Any) -> None:
    """Set a key of a table; "KEY.0" is the first entry of a list, "KEY.0.key" a key of that.

    Raises:
        InputError: the list has no such entry.
    """
    name, dot, rest = path.partition(".")
    entries = keys.get(name)
    if not dot or not isinstance(entries, list | tuple):
        keys[path] = value
        return
    number, dot, inner = rest.partition(".")
    if not number.isdecimal() or int(number) >= len(entries):
        raise InputError(
            f"{path} = {value!r:.200}: allowed behind {name} is a number below {len(entries)}"
        )
    keys[name] = [*entries]
    keys[name][int(number)] = {**given_keys(entries[int(number)]), inner: value} if dot else value


def changed_tables(
    table: str,
    tables: Mapping[str, Any],
    changes: Mapping[str, Any],
    change: Callable[[str, Any, Mapping[str, Any]], Any],
) -> dict[str, Any]:
    """Return tables by name with others, or with other keys.

    Args:
        table: that they stand in, for messages.
        tables: name -> its keys.
        changes: "NAME" -> all keys, None leaves the table out; "NAME.key" -> a value.
        change: function of a name, the keys or None, and other keys that returns the new ones.

    Raises:
        InputError: a table is to be left out that is not there.
    """
    changed, inner = dict(tables), dict[str, dict[str, Any]]()
    for path, value in changes.items():
        name, dot, key = path.partition(".")
        if dot:
            inner.setdefault(name, {})[key] = value
        elif value is None:
            if name not in tables:
                near = nearest(name, tables)
                raise InputError(f"{table}.{name} = None: there is none to leave out{near}")
            changed.pop(name, None)
        else:
            changed[name] = value
    return changed | {name: change(name, changed.get(name), keys) for name, keys in inner.items()}


def _replaced_keys(kind: type[Table], names: set[str]) -> set[str]:
    """Return the keys of alternatives of a table that give way to those that some keys choose."""
    replaced: set[str] = set()
    for _, selector in _parts(kind):
        kinds = dict(selector.classes())
        for inner in kinds.values():
            replaced |= _replaced_keys(inner, names)
        if isinstance(selector, Alternatives):
            for chosen, deciding in selector.deciding_keys().items():
                rest = set().union(*(declared_keys(k) for k in kinds.values() if k is not chosen))
                if deciding & names and not (rest - {*declared_keys(chosen)}) & names:
                    replaced |= rest - {*declared_keys(chosen)}
    return replaced


def plain(table: Table) -> dict[str, Any]:
    """Return the keys of a table that are not None as a nested mapping, as a file has them."""
    keys: dict[str, Any] = {}
    for name, value, _ in key_values(table):
        if value is not None:
            keys[name] = plain_value(value)
    return keys


def plain_value(value: Any) -> Any:
    """Return the value of a key as a file has it."""
    if isinstance(value, Table):
        return plain(value)
    return [plain_value(entry) for entry in value] if isinstance(value, tuple) else value


def given_keys(table: Any) -> dict[str, Any]:
    """Return the keys that a table gives, as a mapping or as its dataclass; none of None."""
    keys = table.given_values if isinstance(table, Table) else table
    return dict(keys) if isinstance(keys, Mapping) else {}


def given_names(table: Any, path: str = "") -> Iterator[str]:
    """Yield the dotted names of the keys that a table gives, and of those of tables within it."""
    for name, value in given_keys(table).items():
        if value is not None:
            yield path + name
            yield from given_names(value, f"{path}{name}.")
