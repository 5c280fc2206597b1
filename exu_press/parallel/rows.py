"""File of finished rows, a JSON line each, on the disk before the next run begins."""

import json
import os
import stat
from contextlib import AbstractContextManager
from io import FileIO
from pathlib import Path
from typing import TypedDict

from exu_press.errors import InputError
from exu_press.files.digests import note_content
from exu_press.files.output_directory import refuse_link, writing
from exu_press.parallel.task import FAILED, TIME_LIMIT, WORKER_DIED, Row
from exu_press.schema.stored import from_json

__all__ = ["RowFile"]


SYSTEM_FLAGS = sum(getattr(os, f"O_{name}", 0) for name in ("NOFOLLOW", "NONBLOCK", "BINARY"))
"""Of opening a file, where a system has them: follow no link, wait for nobody, change no byte."""


class Record(TypedDict):
    """A line.

    Attributes:
        key: of the task.
        time_limit: that it had, s.
        row: with its status and reason, both texts.
    """

    key: str
    time_limit: float | None
    row: Row


class RowFile(AbstractContextManager["RowFile", None]):
    """runs.jsonl: every line is the record of a task.

    A line that a kill has left without its end is cut off. Used as a context manager, under the
    directory's lock.
    """

    def __init__(self, path: Path) -> None:
        """Read the rows that are there.

        Raises:
            InputError: the file cannot be read, or holds something else.
        """
        self._path = path
        self._rows: dict[str, tuple[Row, float | None]] = {}
        try:
            self._file = _open_own_file(path)
            text = self._file.read()
            if text:
                note_content(path, text)
            *lines, torn = text.split(b"\n")
            for number, line in enumerate(lines, start=1):
                self._read(number, line)
            if torn and not torn.startswith(b"{"):
                self._read(len(lines) + 1, torn)
            if torn:
                self._file.truncate(len(text) - len(torn))
        except OSError as error:
            raise InputError(f"{path}: cannot be opened ({error.strerror})") from None

    def _read(self, number: int, line: bytes) -> None:
        try:
            record = from_json(Record, line, "its text")
            for name in ("status", "reason"):
                if not isinstance(record["row"].get(name), str):
                    raise InputError(f"row.{name}: allowed is a text")
        except InputError as error:
            raise InputError(
                f"{self._path}, line {number}: not a row of a batch ({error}); delete the line, "
                "and its run is done again, or take another directory"
            ) from None
        self._rows[record["key"]] = record["row"], record["time_limit"]

    @property
    def count(self) -> int:
        """Number of the tasks with a row."""
        return len(self._rows)

    def finished_row(self, key: str, time_limit: float | None) -> Row | None:
        """Return a task's row, or None if the task is to be run.

        A run that raised an error or whose worker died is repeated, as both may lie in the machine;
        one over its time limit only if the limit is longer now.
        """
        row, limit = self._rows.get(key, (None, None))
        if row is None or row["status"] in (FAILED, WORKER_DIED):
            return None
        longer = limit is not None and (time_limit is None or time_limit > limit)
        return None if row["status"] == TIME_LIMIT and longer else row

    def append(self, key: str, time_limit: float | None, row: Row) -> None:
        """Write a row; on return it is on the disk.

        Raises:
            InputError: it cannot be written, as on a full disk.
        """
        record: Record = {"key": key, "time_limit": time_limit, "row": row}
        line = json.dumps(record, separators=(",", ":"), allow_nan=False) + "\n"
        with writing(self._path):
            unwritten = memoryview(line.encode())
            while unwritten:
                unwritten = unwritten[self._file.write(unwritten) :]
            os.fsync(self._file.fileno())
        self._rows[key] = row, time_limit

    def __exit__(self, *_: object) -> None:
        self._file.close()


def _open_own_file(path: Path) -> FileIO:
    """Return a file to read and to append to, made where there is none; no link is followed.

    Raises:
        InputError: it is a link, has a second name, or is no file.
        OSError: it cannot be opened.
    """
    refuse_link(path)
    number = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT | SYSTEM_FLAGS, 0o666)
    about = os.fstat(number)
    if not stat.S_ISREG(about.st_mode) or about.st_nlink > 1:
        os.close(number)
        raise InputError(
            f"{path}: is no file of its own (a device, or one of several names of a file); allowed "
            "is a copy of it, or another directory"
        )
    return os.fdopen(number, "r+b", buffering=0)  # what a full disk does not take is not kept
