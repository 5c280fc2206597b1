"""Checkpoints of long runs: blocks on the disk, which a killed process leaves."""

import json
import shutil
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TypedDict, TypeVar

from exu_press.errors import InputError, error_prefix
from exu_press.files.digests import note_file
from exu_press.files.lock import LOCK, lock_directory
from exu_press.files.output_directory import checkpoint_directory, refuse_link, writing
from exu_press.result import netcdf
from exu_press.result.channels import MemmapChannels
from exu_press.result.contents import Contents
from exu_press.schema.stored import from_json

__all__ = [
    "has_blocks",
    "open_checkpoint",
    "read",
    "refuse_blocks",
    "remove",
    "set_aside",
    "write_checkpoint",
]

Kind = TypeVar("Kind", bound=Contents)

HEAD = "head.nc"
"""The last instant, with scene, state and whatever else is no channel."""

MARK, WORDS = (
    "README.txt",
    "Blocks of a run of exu-press that goes on, or whose process was killed.\n"
    "exu-press report shows what is there; exu-press run SCENE --from goes on from its end.\n",
)
"""File that tells such a directory from others, and what it says."""


class Blocks(TypedDict):
    """Entries of a head about the channels beside it.

    Attributes:
        count: instants of finished blocks.
        checksums: of the channels until there.
    """

    count: int
    checksums: dict[str, int]


def has_blocks(directory: Path) -> bool:
    """Return whether a directory has finished blocks of a run."""
    return (directory / HEAD).is_file()


def refuse_blocks(directory: Path) -> None:
    """Refuse to begin a run where another one has left finished blocks.

    Raises:
        InputError: it has.
    """
    if has_blocks(directory):
        raise InputError(
            f"{directory}: has the finished blocks of a run that did not get to its end; "
            f"`--from {directory.parent}` goes on from them, `--overwrite` deletes them and begins "
            "anew"
        )


@contextmanager
def open_checkpoint(directory: Path | None) -> Iterator[MemmapChannels]:
    """Yield channels that go to a directory, made anew and locked, or to a temporary one.

    Raises:
        InputError: the directory is in use, has finished blocks or files that are no run's, or
            cannot be made.
    """
    if directory is None:
        yield MemmapChannels()
        return
    refuse_link(directory)
    _refuse_others(directory)
    with writing(directory):
        directory.mkdir(parents=True, exist_ok=True)
    with lock_directory(directory):
        refuse_blocks(directory)
        _refuse_others(directory)
        with writing(directory):
            for file in directory.iterdir():  # of a run that was stopped in its first block
                if file.name != LOCK:
                    file.unlink()
            (directory / MARK).write_text(WORDS, encoding="utf-8")
        yield MemmapChannels(directory)


def _refuse_others(directory: Path) -> None:
    """Refuse a directory with files of somebody else."""
    names = [file.name for file in directory.glob("*")] if directory.is_dir() else []
    if MARK not in names and (names not in ([], [LOCK]) or directory.is_file()):
        raise InputError(f"{directory}: has other files; allowed is one that does not exist yet")


def write_checkpoint(
    directory: Path, run: Contents, revolutions: float, channels: MemmapChannels
) -> None:
    """Write last block and revolutions, which make a run of the channels in a directory."""
    settle = run.scene.settle
    if settle is not None and settle >= revolutions:
        settle = 0.0
    scene = run.scene.replace({"revolutions": revolutions, "settle": settle})
    ends = {
        name: replace(channel, values=channel.values[-1:]) for name, channel in run.channels.items()
    }
    blocks: Blocks = {"count": channels.count, "checksums": channels.checksums}
    head = replace(run, scene=scene, channels=ends)
    netcdf.write(head, directory / HEAD, blocks=json.dumps(blocks))


def read(path: Path, kind: type[Kind]) -> Kind:
    """Return the run of a file or, with a warning, of the directory that a killed one has left.

    Raises:
        InputError: it cannot be read.
    """
    if has_blocks(path):
        return _read_checkpoint(path, kind)
    beside = checkpoint_directory(path)
    if has_blocks(beside):
        if not path.is_file():
            return _read_checkpoint(beside, kind)
        warnings.warn(
            f"{path}: an earlier run's; what the last one left, which goes on or was killed, is "
            f"{beside}",
            stacklevel=3,
        )
    return _read_file(path, kind)


def _read_file(path: Path, kind: type[Kind]) -> Kind:
    """Return the result in a file, which is recorded as read; of blocks their checksums are."""
    run = netcdf.read(path, kind)
    note_file(path)
    return run


def _read_checkpoint(directory: Path, kind: type[Kind]) -> Kind:
    """Return the run in a directory, as one of the revolutions that it has made."""
    run = _read_file(directory / HEAD, kind)
    with error_prefix(f"{directory / HEAD}: damaged: "):
        blocks = from_json(Blocks, netcdf.read_text(directory / HEAD, "blocks"), "blocks")
    warnings.warn(
        f"{directory}: this run goes on, or its process was killed; it has "
        f"{run.scene.revolutions:g} revolutions, from whose end --from goes on",
        stacklevel=4,
    )
    headers = {
        name: replace(channel, values=channel.values[:0]) for name, channel in run.channels.items()
    }
    return replace(run, channels=MemmapChannels.reopen(directory, headers, **blocks))


def set_aside(directory: Path) -> Path:
    """Give a directory with finished blocks another name, with a number, and return it."""
    number = 1
    while (aside := directory.with_name(f"{directory.name}.{number}")).exists():
        number += 1
    with writing(aside):
        directory.rename(aside)
    return aside


def remove(directory: Path) -> None:
    """Remove a directory of such a run, if there is one; no other."""
    if (directory / MARK).is_file():
        shutil.rmtree(directory, ignore_errors=True)
