"""Run a sweep: its runs, and the table of their quantities."""

from pathlib import Path
from typing import Any

from exu_press.errors import prefixed
from exu_press.parallel import FILE
from exu_press.studies.base import Runs
from exu_press.studies.sweep.study import Sweep
from exu_press.studies.sweep.table import Table, table_of

__all__ = ["sweep"]

TABLES = ("table.csv", "table.nc")


def sweep(study: Sweep, directory: str | Path, **how: Any) -> Table:
    """Run the points that are missing, write table.csv and table.nc, and return the table.

    Called again after a kill or Ctrl-C, it goes on; see `exu_press.parallel.Batch`.

    Args:
        study: to be run.
        directory: of this study alone.
        how: workers, dask, quiet of `exu_press.studies.base.Runs`.

    Raises:
        InputError: the directory cannot be used or belongs to another study, or no scheduler
            answers.
    """
    directory = Path(directory)
    with Runs(study, directory, written=TABLES, label="sweep", **how) as runs:
        digits = len(str(len(study.points)))
        numbers = range(1, len(study.points) + 1)
        files = [f"runs/{n:0{digits}}.nc" for n in numbers] if study.save_runs else []
        rows = runs.of(study.scenes, files)
        with prefixed(f"{directory / FILE}: not rows of a sweep: "):
            table = table_of(study, rows, files)
        table.save_csv(directory / "table.csv")
        table.save_netcdf(directory / "table.nc")
    return table
