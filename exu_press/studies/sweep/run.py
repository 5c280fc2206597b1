"""Run a study: its batch, and the table of what came out."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from exu_press.batch import FILE, locked, run_batch
from exu_press.errors import InputError
from exu_press.output import output_directory, write_json
from exu_press.quantities import values_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.stored import from_json
from exu_press.studies.sweep.study import Study
from exu_press.studies.sweep.table import Table, table_of

__all__ = ["run_scene", "sweep"]

TABLES = ("table.csv", "table.nc")


def sweep(
    study: Study,
    directory: str | Path,
    *,
    workers: int | None = None,
    dask: str | None = None,
    quiet: bool = True,
) -> Table:
    """Run what is not run yet, write table.csv and table.nc, and return the table.

    Called again after a kill or Ctrl-C, it goes on; see `exu_press.batch.run_batch`.

    Args:
        study: what to run.
        directory: of this study alone.
        workers: number of processes; all cores unless told.
        dask: address of a Dask scheduler instead.
        quiet: False shows the progress on standard error.

    Raises:
        InputError: the directory cannot be used or belongs to another study, or no scheduler
            answers.
    """
    directory = output_directory(directory)
    with locked(directory):
        _claim(directory, study)
        digits = len(str(len(study.points)))
        numbers = range(1, len(study.points) + 1)
        files = [f"runs/{n:0{digits}}.nc" for n in numbers] if study.save_runs else []
        if files:
            output_directory(directory / "runs")
        rows = run_batch(
            run_scene,
            [
                {"scene": scene.to_dict()}
                | ({"errors": True} if study.errors else {})
                | ({"save": str((directory / files[index]).resolve())} if files else {})
                for index, scene in enumerate(study.scenes)
            ],
            directory,
            workers=workers,
            dask=dask,
            time_limit=study.time_limit,
            kept=_file_is_whole,
            quiet=quiet,
        )
        try:
            table = table_of(study, rows, files)
        except InputError as error:
            raise InputError(f"{directory / FILE}: not rows of a sweep: {error}") from None
        from exu_press.studies.sweep.netcdf import save_netcdf

        table.save_csv(directory / "table.csv")
        save_netcdf(table, directory / "table.nc")
    return table


def run_scene(arguments: dict[str, Any]) -> dict[str, Any]:
    """Run {"scene": ...}, with "save": file and "errors": True if wanted; return its row."""
    from exu_press.simulation import simulate
    from exu_press.verification import simulate_with_errors

    scene = Scene.from_dict(arguments["scene"])
    wanted = arguments.get("errors")
    result = simulate_with_errors(scene, beside=False) if wanted else simulate(scene)
    if "save" in arguments:
        result.save(arguments["save"])
    return row_of(result)


def row_of(result: Result) -> dict[str, Any]:
    """Return what a study keeps of a run: how it ended, its quantities and their errors."""
    info, values = result.info, values_of(result)
    row: dict[str, Any] = {name: info[name] for name in ("status", "reason", "end_time")}
    row |= {name: value.value for name, value in values.items()}
    if "errors" in info:
        row |= {name: info[name] for name in ("errors", "horizon", "lyapunov_exponent")}
    return row


def _file_is_whole(arguments: Mapping[str, Any]) -> bool:
    """Return whether the run.nc that a run was to keep can be read."""
    from exu_press.result.netcdf import is_whole

    return "save" not in arguments or is_whole(Path(arguments["save"]))


def _claim(directory: Path, study: Study) -> None:
    """Write down whose directory this is, or raise InputError if it is another's."""
    path = directory / "study.json"
    wanted = json.loads(json.dumps(study.to_dict()))
    if not path.exists():
        taken = [name for name in TABLES if (directory / name).exists()]
        if taken:
            raise InputError(
                f"{directory}: has {taken[0]} and no study.json, so that it may belong to another "
                f"study; allowed is a directory of the study's own, or to delete "
                f"{' and '.join(taken)}; runs of this study in {FILE} are kept"
            )
        write_json(path, wanted)
        return
    try:
        found = from_json(dict[str, Any], path.read_bytes(), path.name)
    except (OSError, InputError):
        found = None
    if found != wanted:
        raise InputError(
            f"{directory}: belongs to another study ({path.name} differs{_where(found, wanted)}); "
            "allowed is another directory, or to remove this one"
        )


def _where(found: Any, wanted: dict[str, Any]) -> str:
    """Return the first key in which two studies differ, in words."""
    if isinstance(found, dict):
        for name in {**wanted, **found}:
            if found.get(name) != wanted.get(name):
                return f" in {name}"
    return ""
