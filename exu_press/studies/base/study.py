"""A study file: one scene, which of its keys vary and how, and the study's own tables."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import numpy as np

from exu_press.errors import InputError, error_prefix
from exu_press.numerics.arrays import Array
from exu_press.scene import Scene
from exu_press.schema.checks import key
from exu_press.schema.kinds import import_kinds
from exu_press.schema.table import Table, table_from, tables_from
from exu_press.schema.toml import read_toml
from exu_press.studies.base.keys import Key, Values, keys_from

__all__ = ["Study", "load_study", "names_in"]

S = TypeVar("S", bound="Study")


@dataclasses.dataclass(frozen=True)
class Study(Table):
    """The common part of study files; a kind of study adds its tables.

    Attributes:
        scene: common to all runs; a Scene or its mapping.
        keys: dotted key of the scene -> how it varies (`Values`, `Range` or `Normal`, or as a file
            has them).
        save_runs: whether every run keeps its run.nc.
        errors: whether every figure has its error, by refinement runs: twice the work.
        time_limit: of one run, s.

    Raises:
        InputError: not allowed, or not allowed in the scene with one key at one of its values.
    """

    with_keys: ClassVar[bool] = True
    """True where keys of the scene vary."""

    plain_runs: ClassVar[bool] = True
    """True where runs may have errors and may be kept."""

    tables: ClassVar[Mapping[str, type[Table]]] = {}
    """The kind's own tables by name; one whose field is () by default is a list of tables."""

    scene: Scene
    keys: Mapping[str, Key]
    save_runs: bool = key(False, "keep a run.nc for every run")
    errors: bool = key(False, "find the error of every figure")
    time_limit: float | None = key(None, "for one run", "s", above=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.errors or self.save_runs) and not self.plain_runs:
            command = next(iter(self.tables))
            raise InputError(f"errors, save_runs: not used by exu-press {command}; remove them")
        lists = {field.name for field in dataclasses.fields(self) if field.default == ()}
        for name, kind in self.tables.items():
            value = getattr(self, name)
            if name not in lists:
                read: Any = table_from(kind, name, {} if value is None else value)
            else:
                read = () if value in ((), []) else tables_from(kind, name, value)
            object.__setattr__(self, name, read)
        for name in ("scene", "keys"):
            if not isinstance(value := getattr(self, name), (Mapping, Scene)):
                raise InputError(f"{name} = {value!r:.200}: allowed is a table")
        if not self.keys and self.with_keys:
            raise InputError("[keys]: empty; allowed is at least one key of the scene")
        if not isinstance(self.scene, Scene):
            object.__setattr__(self, "scene", Scene.from_dict(self.scene))
        object.__setattr__(self, "keys", keys_from(self.keys))
        self.check_keys()

    @classmethod
    def locate_files(cls, data: dict[str, Any], directory: Path) -> dict[str, Any]:
        """Return a file's tables with paths of other files relative to its directory."""
        return data

    def check_keys(self) -> None:
        """Check the scene with each key at its ends, one at a time."""
        for name, variation in self.keys.items():
            for value in variation.ends:
                self.scene_at({name: value})

    def point_of(self, shares: Array) -> dict[str, float]:
        """Return the keys' quantiles at shares of their ranges or distributions, (keys,)."""
        pairs = zip(self.keys.items(), np.clip(shares, 0.0, 1.0), strict=True)
        return {
            name: float(variation.quantile(share))
            for (name, variation), share in pairs
            if not isinstance(variation, Values)
        }

    def scene_at(self, point: Mapping[str, Any]) -> Scene:
        """Return the scene at a point: with keys at these values.

        Raises:
            InputError: not allowed; it names the values.
        """
        try:
            return self.scene.replace(dict(point))
        except InputError as error:
            where = ", ".join(f"{name} = {value!r}" for name, value in point.items())
            raise InputError(f"run with {where}: {error}") from None

    def to_dict(self) -> dict[str, Any]:
        """Return the data that identify the study; the time limit is none of them."""
        data: dict[str, Any] = {}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if field.name == "keys":
                value = {name: variation.plain() for name, variation in value.items()}
            elif isinstance(value, Scene):
                value = value.to_dict()
            elif isinstance(value, Table):
                value = dataclasses.asdict(value)
            elif isinstance(value, tuple):
                value = [dataclasses.asdict(entry) for entry in value]
            if field.name != "time_limit" and value is not None:
                data[field.name] = value
        return data


def names_in(name: str, value: Any) -> tuple[str, ...]:
    """Return the value of a key that is a list of names of quantities."""
    if isinstance(value, list | tuple) and value and all(isinstance(text, str) for text in value):
        return tuple(value)
    raise InputError(f"{name} = {value or []!r:.200}: allowed is a list of names of quantities")


def load_study(path: str | Path, kind: type[S], *, allow_code: bool = False) -> S:
    """Return the study of a TOML file; a scene's path is relative to the study's directory.

    Args:
        allow_code: import the modules that kinds of joints name; they run with the user's rights.

    Raises:
        InputError: the file cannot be read or parsed, or the study or one of its scenes is not
            allowed.
    """
    path = Path(path)
    data = read_toml(path)
    forms = {"scene": 'scene = "FILE.toml" or a [scene] table'}
    forms |= {"keys": "a [keys] table"} if kind.with_keys else {}
    if missing := [name for name in forms if name not in data]:
        allowed = ", and ".join(forms[name] for name in missing)
        raise InputError(f"{path}: no {' and no '.join(missing)}; allowed is {allowed}")
    if allow_code:
        with error_prefix(f"{path}: "):
            import_kinds(data)
    if isinstance(data["scene"], str):
        data["scene"] = Scene.load(path.parent / data["scene"], allow_code=allow_code)
    with error_prefix(f"{path}: "):
        return table_from(kind, "", kind.locate_files(data, path.parent))
