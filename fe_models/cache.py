"""Cache of reduced parts on disk, which are read in milliseconds without NGSolve.

A file's name has the digest of everything that determines its content: geometry, material,
interfaces, mesh size, reduction, versions of NGSolve, Netgen, NumPy, SciPy, and our own code. It
is an .npz of plain arrays (nothing is unpickled), followed by the digest of its bytes; a damaged
file is written again. It is written under a temporary name and renamed, so that no half-written
file is read.
"""

import hashlib
import json
import warnings
from collections.abc import Mapping
from dataclasses import fields
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_models.array_file import cache_folder, load_arrays, save_arrays
from fe_models.reduced import ReducedInterface, ReducedPart
from fe_models.reduction import Reduction, Report, Solid, reduce_part
from fe_models.temporary import remove_abandoned

__all__ = ["cache_file", "default_folder", "load", "reduced_part", "save"]

SOURCES = (
    "shapes",
    "round_faces",
    "patches",
    "flexibility",
    "elasticity",
    "matrices",
    "matrix_model",
    "saddle",
    "reduction",
    "stress",
    "reduced",
    "cache",
    "array_file",
)
PACKAGES = ("ngsolve", "netgen-mesher", "numpy", "scipy")
NOT_PLAIN = {"name", "method", "mass", "couplings", "interfaces", "meta"}
PLAIN = [field.name for field in fields(ReducedPart) if field.name not in NOT_PLAIN]
"""Arrays of a reduced part, stored under their own names."""

PER_INTERFACE = ("centre", "axis", "translation", "rotation")


def reduced_part(
    solid: Solid,
    reduction: Reduction | None = None,
    *,
    folder: str | Path | None = None,
    report: Report | None = None,
) -> ReducedPart:
    """Return a reduced part, from the cache if it has a sound one; else reduce and store it.

    Args:
        solid: to be reduced.
        reduction: how; by default 20 Craig-Bampton modes.
        folder: of the cache; by default `default_folder()`.
        report: called with (text about the progress, share done) during the reduction.

    Raises:
        InputError: the solid cannot be meshed or lacks a face, or the reduction does not fit it.
    """
    reduction = reduction or Reduction()
    file = cache_file(solid, reduction, default_folder() if folder is None else Path(folder))
    remove_abandoned(file.parent)
    stored = load(file)
    if stored is not None:
        return stored
    if (reader := solid.reader) is not None:
        here = f"{__name__}:{reduce_here.__name__}"
        reduced: ReducedPart = reader.in_child(here, solid, reduction, report=report)
    else:
        reduced = reduce_part(solid, reduction, report)
    try:
        save(reduced, file)
    except OSError as error:  # the cache is optional
        warnings.warn(
            f"{file}: cannot be written ({error.strerror}); {solid.name} is reduced again whenever "
            "it is needed",
            stacklevel=2,
        )
    return reduced


def reduce_here(solid: Solid, reduction: Reduction, report: Report | None = None) -> ReducedPart:
    """Read and reduce a body of a STEP file or of matrices in this process, a child."""
    return reduce_part(solid.open_here(), reduction, report)


def default_folder() -> Path:
    """Return $EXU_PRESS_CACHE, else fe_models under $XDG_CACHE_HOME or ~/.cache."""
    return cache_folder("fe_models")


def cache_file(solid: Solid, reduction: Reduction, folder: Path) -> Path:
    """Return the file of a reduced part in a cache's folder."""
    determined_by = {
        "name": solid.name,
        "part": solid.key(),
        "reduction": reduction.key(),
        "versions": {package: version(package) for package in PACKAGES},
        "sources": _source_digest(),
    }
    digest = hashlib.sha256(json.dumps(determined_by, sort_keys=True).encode()).hexdigest()
    return folder / f"{_plain_name(solid.name)}-{digest[:32]}.npz"


def save(reduced: ReducedPart, file: Path) -> None:
    """Write a reduced part, the whole file at once."""
    arrays = {key: np.asarray(getattr(reduced, key)) for key in PLAIN}
    for i, interface in enumerate(reduced.interfaces):
        arrays |= {f"interface{i}.{key}": getattr(interface, key) for key in PER_INTERFACE}
    arrays |= {f"coupling.{key}": value for key, value in reduced.couplings.items()}
    text = {
        "file": file.stem,
        "name": reduced.name,
        "method": reduced.method,
        "mass": reduced.mass,
        "meta": dict(reduced.meta),
        "interfaces": [[i.face, i.area, i.arm] for i in reduced.interfaces],
    }
    arrays["text"] = np.frombuffer(json.dumps(text).encode(), dtype=np.uint8)
    save_arrays(arrays, file)


def load(file: Path) -> ReducedPart | None:
    """Return the part in a file of `save`, or None if it is missing, damaged or foreign."""
    try:
        arrays = load_arrays(file)
        if arrays is None:
            return None
        text = json.loads(bytes(arrays["text"]))
        return _from_arrays(arrays, text) if text["file"] == file.stem else None
    except Exception:  # whatever readers of archives and arrays raise of foreign bytes
        return None


def _from_arrays(arrays: Mapping[str, NDArray[Any]], text: Mapping[str, Any]) -> ReducedPart:
    """Return the reduced part that the arrays hold."""
    interfaces = tuple(
        ReducedInterface(
            face, area=area, arm=arm, **{k: arrays[f"interface{i}.{k}"] for k in PER_INTERFACE}
        )
        for i, (face, area, arm) in enumerate(text["interfaces"])
    )
    prefix = "coupling."
    return ReducedPart(
        name=text["name"],
        method=text["method"],
        mass=text["mass"],
        interfaces=interfaces,
        couplings={k.removeprefix(prefix): v for k, v in arrays.items() if k.startswith(prefix)},
        meta=text["meta"],
        **{key: arrays[key] for key in PLAIN},
    )


def _source_digest() -> str:
    """Return a digest of the modules that a reduced part's numbers come from."""
    folder = Path(__file__).parent
    digest = hashlib.sha256()
    for module in SOURCES:
        digest.update((folder / f"{module}.py").read_bytes())
    return digest.hexdigest()


def _plain_name(name: str) -> str:
    """Return a name as part of a file name."""
    return "".join(char if char.isalnum() else "_" for char in name)[:40]
