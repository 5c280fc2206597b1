"""The blocks of a long run on disk, which stay there if its process is killed."""

import shutil
import warnings
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from exu_press.errors import InputError
from exu_press.result import netcdf
from exu_press.result.channels import OnDisk
from exu_press.result.contents import Contents

__all__ = ["begin", "keep", "read", "remove", "unfinished_of"]

Kind = TypeVar("Kind", bound=Contents)

HEAD = "head.nc"
"""The last instant, with scene, state and whatever else is no channel."""


def unfinished_of(path: Path) -> Path:
    """Return the directory beside a run's file in which the run is while it goes on."""
    return path.with_name(f"{path.name}.unfinished")


def begin(directory: Path | None) -> OnDisk:
    """Return channels that go to a directory, made anew, or to a temporary one."""
    if directory is not None:
        remove(directory)
        try:
            directory.mkdir(parents=True)
        except OSError as error:
            raise InputError(f"{directory}: cannot be made ({error.strerror})") from None
    return OnDisk(directory)


def keep(directory: Path, run: Contents, revolutions: float) -> None:
    """Write the head that makes a run of the channels in a directory."""
    settle = run.scene.settle
    if settle is not None and settle >= revolutions:
        settle = 0.0
    scene = run.scene.replace({"revolutions": revolutions, "settle": settle})
    ends = {name: replace(one, values=one.values[-1:]) for name, one in run.channels.items()}
    netcdf.write(replace(run, scene=scene, channels=ends), directory / HEAD)


def read(path: Path, kind: type[Kind]) -> Kind:
    """Return the run of a file or, with a warning, of the directory that a killed one has left.

    Raises:
        InputError: it cannot be read.
    """
    if (path / HEAD).is_file():
        return _left(path, kind)
    beside = unfinished_of(path)
    if not (beside / HEAD).is_file():
        return netcdf.read(path, kind)
    if not path.is_file():
        return _left(beside, kind)
    warnings.warn(
        f"{path}: an earlier run's; what the last one left, whose process was killed, is {beside}",
        stacklevel=3,
    )
    return netcdf.read(path, kind)


def _left(directory: Path, kind: type[Kind]) -> Kind:
    """Return the run in a directory, as one of the revolutions that it has made."""
    run = netcdf.read(directory / HEAD, kind)
    warnings.warn(
        f"{directory}: the process of this run was killed; it has {run.scene.revolutions:g} "
        "revolutions, from whose end --from goes on",
        stacklevel=4,
    )
    begun = {name: replace(one, values=one.values[:0]) for name, one in run.channels.items()}
    return replace(
        run, channels=OnDisk.found(directory, begun, float(run.channels["time"].values[-1]))
    )


def remove(directory: Path) -> None:
    """Remove a directory of such a run, if there is one; no other."""
    if (directory / HEAD).is_file() or not any(directory.glob("*")):
        shutil.rmtree(directory, ignore_errors=True)
