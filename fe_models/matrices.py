"""A body given by the matrices of another finite-element code: its description, and its writer.

A TOML file names Matrix Market files beside it, states the units, and lists the nodes of each
interface. The files are opened by a child process alone (`matrix_model`).
"""

import hashlib
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
import scipy.io
import scipy.sparse as sp
from numpy.typing import ArrayLike

from fe_models.errors import InputError
from fe_models.file_reader import read_in_child
from fe_models.part import MOTIONS, Interface

__all__ = ["Description", "MatrixPart", "NodeSet", "write_matrices"]

LENGTHS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "in": 0.0254}
MASSES = {"kg": 1.0, "t": 1e3, "g": 1e-3, "lb": 0.45359237}
FORCES = {"N": 1.0, "kN": 1e3, "lbf": 4.4482216152605}
UNITS = {"length": LENGTHS, "mass": MASSES, "force": FORCES}
"""Name of a unit -> its size in SI."""

FILES = ("stiffness", "mass", "nodes")
OPTIONAL = ("triangles",)
MOST_LETTERS = 20_000_000
"""Largest description, bytes: a million nodes in interfaces."""

MOST_WEIGHT = 1e30
"""Largest weight of a node, whose square is a number, too."""

ENDING = ".mtx"


@dataclass(frozen=True)
class NodeSet:
    """The nodes of an interface, by number from 0, and their weights in its mean motion."""

    nodes: tuple[int, ...]
    weights: tuple[float, ...]


@dataclass(frozen=True)
class Description:
    """The content of a description.

    Attributes:
        files: "stiffness" and the like -> a Matrix Market file.
        units: "length", "mass" and "force" -> the unit's size in SI.
        interfaces: name -> its nodes.
    """

    files: Mapping[str, Path]
    units: Mapping[str, float]
    interfaces: Mapping[str, NodeSet]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a description.

        Raises:
            InputError: it cannot be read, has no units, or a key is not allowed; the name of a file
                leads out of its folder; an interface has no node.
        """
        try:
            if not path.is_file() or path.stat().st_size > MOST_LETTERS:
                what = f"a regular file of at most {MOST_LETTERS / 1e6:g} MB"
                raise InputError(f"matrices {path}: allowed is {what}")
            data = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"matrices {path}: cannot be read ({error})") from None
        known = (*FILES, *OPTIONAL, "units", "interfaces")
        for key in data:
            if key not in known:
                raise InputError(f"matrices {path}: {key}: allowed are {', '.join(known)}")
        units, interfaces = (data.get(key) for key in ("units", "interfaces"))
        names = [name for name in (*FILES, *OPTIONAL) if name in data or name in FILES]
        return cls(
            {name: _file(path, name, data.get(name)) for name in names},
            _units(path, units),
            _interfaces(path, interfaces),
        )


@dataclass(frozen=True)
class MatrixPart:
    """A body to be reduced, from stiffness and mass matrices over the nodes of a free body.

    A child process reads and reduces them. `time_limit` (s) and `memory_limit` (bytes) are those of
    the child.

    Attributes:
        path: of the description.
        interfaces: node sets that joints and loads hold on to.
    """

    path: Path
    interfaces: tuple[Interface, ...]
    time_limit: float = 600.0
    memory_limit: float = 8e9

    @property
    def name(self) -> str:
        """Return its name in messages and in the cache."""
        return self.path.stem

    @property
    def bearings(self) -> tuple[str, ...]:
        """Return the interfaces held in all six motions."""
        return tuple(i.face for i in self.interfaces if len(i.motions) == len(MOTIONS))

    @property
    def reader(self) -> Self:
        """Return what opens its files in a child."""
        return self

    def open_here(self) -> Self:
        """Return the body whose files this process, a child, reads itself."""
        return self

    def key(self) -> dict[str, Any]:
        """Return everything that determines the finite-element model, as plain data."""
        description = Description.read(self.path)
        digests = {}
        for name, path in {"description": self.path, **description.files}.items():
            with path.open("rb") as file:
                digests[name] = hashlib.file_digest(file, "sha256").hexdigest()
        return {"matrices": digests, "interfaces": [[i.face, *i.motions] for i in self.interfaces]}

    def in_child(
        self, function: str, *arguments: Any, report: Callable[..., None] | None = None
    ) -> Any:
        """Return what a function that opens the files returns; arguments as of `read_in_child`."""
        return read_in_child(
            function,
            *arguments,
            file=f"matrices {self.path}",
            smaller="smaller matrices",
            time_limit=self.time_limit,
            memory_limit=self.memory_limit,
            report=report,
        )


def write_matrices(
    path: str | Path,
    nodes: ArrayLike,
    stiffness: Any,
    mass: Any,
    interfaces: Mapping[str, Any],
    *,
    units: Mapping[str, str],
    triangles: ArrayLike | None = None,
) -> None:
    """Write matrices and their description, as `[bodies.NAME] matrices = "rod.toml"` reads them.

    Args:
        path: of the description; the Matrix Market files get its name and lie beside it.
        nodes: positions (n, 3).
        stiffness: of the free body (3n, 3n), sparse or dense; x0 y0 z0 x1 ...
        mass: likewise.
        interfaces: name -> numbers of its nodes from 0, or a pair of these and their weights.
        units: of "length", "mass" and "force".
        triangles: corners of the surface (t, 3) by node from 0, for pictures.

    Raises:
        InputError: a unit is unknown, or a set has no node.
    """
    path = Path(path)
    arrays: dict[str, Any] = {
        "stiffness": sp.coo_matrix(stiffness),
        "mass": sp.coo_matrix(mass),
        "nodes": np.asarray(nodes, dtype=float),
    }
    if triangles is not None:
        arrays["triangles"] = np.asarray(triangles) + 1
    files = {name: f"{path.stem}_{name}{ENDING}" for name in arrays}
    sets: dict[str, dict[str, Any]] = {}
    for name, given_set in interfaces.items():
        numbers, weights = given_set if isinstance(given_set, tuple) else (given_set, None)
        sets[name] = {"nodes": [int(number) + 1 for number in numbers]}
        if weights is not None:
            sets[name]["weights"] = [float(weight) for weight in weights]
    _units(path, units)
    _interfaces(path, sets)
    lines = [f'{name} = "{file}"' for name, file in files.items()]
    lines += ["", "[units]", *(f'{name} = "{unit}"' for name, unit in units.items())]
    for name, keys in sets.items():
        quoted = name.replace("\\", "\\\\").replace('"', '\\"')
        lines += ["", f'[interfaces."{quoted}"]', *(f"{key} = {v!r}" for key, v in keys.items())]
    for name, array in arrays.items():
        scipy.io.mmwrite(path.parent / files[name], array, precision=17)
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")


def _units(path: Path, table: Any) -> dict[str, float]:
    example = 'units = {length = "mm", mass = "t", force = "N"}'
    if not isinstance(table, Mapping) or set(table) != set(UNITS):
        what = "has no units" if table is None else f"units = {table!r:.200}"
        raise InputError(f"matrices {path}: {what}; allowed are all three, as {example}")
    for name, unit in table.items():
        if unit not in UNITS[name]:
            raise InputError(
                f"matrices {path}: units.{name} = {unit!r:.200}: allowed is one of "
                f"{', '.join(UNITS[name])}"
            )
    return {name: UNITS[name][unit] for name, unit in table.items()}


def _file(path: Path, name: str, file: Any) -> Path:
    """Return the path of a Matrix Market file, which lies beside the description."""
    if not (
        isinstance(file, str)
        and Path(file).name == file
        and "\\" not in file
        and file.endswith(ENDING)
    ):
        raise InputError(
            f"matrices {path}: {name} = {file!r:.200}: allowed is the name of a file that ends "
            f"with {ENDING} and lies beside this one, without a folder"
        )
    if not (path.parent / file).is_file():
        raise InputError(f"matrices {path}: {name} = {file!r:.200}: there is no such file")
    return path.parent / file


def _interfaces(path: Path, table: Any) -> dict[str, NodeSet]:
    if not isinstance(table, Mapping):
        raise InputError(
            f"matrices {path}: interfaces = {table!r:.200}: allowed is a table of node sets"
        )
    sets = {}
    for name, value in table.items():
        keys = value if isinstance(value, Mapping) else {"nodes": value}
        where = f"matrices {path}: interfaces.{name}"
        numbers, weights = keys.get("nodes"), keys.get("weights")
        is_list = isinstance(numbers, list) and all(
            type(n) is int and 0 < n < 2**63 for n in numbers
        )
        if not is_list or not keys.keys() <= {"nodes", "weights"}:
            raise InputError(f"{where}: allowed are nodes, a list of numbers from 1, and weights")
        if not numbers or len(set(numbers)) < len(numbers):
            what = "no node is in it" if not numbers else "a node is in it twice"
            raise InputError(f"{where}: {what}; allowed is a set of different nodes")
        weights = [1.0] * len(numbers) if weights is None else weights
        if (
            not isinstance(weights, list)
            or len(weights) != len(numbers)
            or not all(type(w) in (int, float) and 0.0 <= w <= MOST_WEIGHT for w in weights)
            or not sum(weights) > 0.0
        ):
            raise InputError(
                f"{where}.weights: allowed are numbers from 0 to {MOST_WEIGHT:g}, one a node, "
                "not all 0"
            )
        sets[name] = NodeSet(tuple(n - 1 for n in numbers), tuple(map(float, weights)))
    return sets
