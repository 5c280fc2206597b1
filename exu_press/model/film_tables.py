"""Tables of bearings with grooves: made when first needed, and kept in the cache."""

import hashlib
import json
import os
import warnings
from concurrent.futures import as_completed
from dataclasses import asdict
from functools import lru_cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from exu_press.laws.film import cavitation, grooved_table, grooves
from exu_press.laws.film.grooves import Groove, GroovedBearing
from exu_press.numerics.arrays import Array
from exu_press.parallel.task import COMPLETED, task_of
from exu_press.parallel.workers import Workers
from exu_press.terminal.progress import Progress
from fe_models.array_file import cache_folder, load_arrays, save_arrays

__all__ = ["film_table", "supply_table", "table_row"]

WORKERS = 2


@lru_cache(maxsize=8)
def film_table(bearing: GroovedBearing) -> Array:
    """Return a bearing's table, (eccentricities, angles, directions, 3), from the cache or made.

    Its grooves are at ambient pressure. Making it takes 50 to 180 s of processor time, as the
    grooves have their symmetries; its progress is shown.

    Raises:
        RuntimeError: a process that makes it failed.
    """
    return _table_of(bearing, grooved_table, "grooved")


@lru_cache(maxsize=8)
def supply_table(bearing: GroovedBearing) -> Array:
    """Return what pressure adds to it, (eccentricities, angles, directions, psi, 5), likewise."""
    from exu_press.laws.film import pressurized

    return _table_of(bearing, pressurized, "pressurized")


def table_row(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return the row of a table at an eccentricity, in a worker."""
    grooves_of = tuple(Groove(**groove) for groove in arguments["bearing"]["grooves"])
    bearing = GroovedBearing(arguments["bearing"]["length_to_diameter"], grooves_of)
    module = import_module(arguments["module"])
    return {"row": module.tabulated_row(bearing, arguments["x"]).tolist()}


def _table_of(bearing: GroovedBearing, module: ModuleType, name: str) -> Array:
    """Return the table that a module makes, from the cache or made."""
    file = cache_folder("films") / f"{name}-{_digest(bearing, module)}.npz"
    arrays = load_arrays(file)
    if arrays is not None:
        return arrays["table"]
    table = _made_table(bearing, module)
    try:
        save_arrays({"table": table}, file)
    except OSError as error:  # the cache is optional
        warnings.warn(
            f"{file}: cannot be written ({error.strerror}); the film's table is made again "
            "whenever it is needed",
            stacklevel=3,
        )
    return table


def _made_table(bearing: GroovedBearing, module: ModuleType) -> Array:
    """Return the table, made in processes beside each other."""
    levels = module.knots_of(bearing).x.tolist()
    rows: dict[int, Any] = {}
    where = f"{__name__}:{table_row.__name__}"
    label, unit = "film of a bearing with grooves", "eccentricities"
    if module is not grooved_table:
        label += " under pressure"
    count = min(WORKERS, os.cpu_count() or 1)
    with (
        Workers(count, None) as workers,
        Progress(label, len(levels), unit) as progress,
    ):
        shape = {"bearing": asdict(bearing), "module": module.__name__}
        tasks = (task_of(where, {**shape, "x": x}) for x in levels)
        futures = {workers.submit(task): k for k, task in enumerate(tasks)}
        for future in as_completed(futures):
            row = workers.row(future)
            if row["status"] != COMPLETED:
                raise RuntimeError(f"{label}: {row['reason']}")
            rows[futures[future]] = row["row"]
            progress.update(len(rows))
    return np.array([rows[k] for k in range(len(levels))])


def _digest(bearing: GroovedBearing, module: ModuleType) -> str:
    """Return a digest of all that determines a table."""
    digest = hashlib.sha256()
    for source in dict.fromkeys((cavitation, grooves, grooved_table, module)):
        digest.update(Path(str(source.__file__)).with_suffix(".py").read_bytes())
    versions = {package: version(package) for package in ("numpy", "scipy")}
    digest.update(json.dumps([asdict(bearing), versions], sort_keys=True).encode())
    return digest.hexdigest()[:32]
