"""Finished rows in a file: one JSON line each, on the disk before the next one is begun."""

import json
import os
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TypedDict

from exu_press.errors import InputError
from exu_press.parallel.task import FAILED, TIME_LIMIT, WORKER_DIED, Row
from exu_press.schema.stored import from_json

__all__ = ["RowFile"]


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

    A kill in the middle of a write leaves a line without its end; it is cut off. Used as a
    context manager, under the directory's lock.
    """

    def __init__(self, path: Path) -> None:
        """Read the rows that are there.

        Raises:
            InputError: the file cannot be read, or holds something else.
        """
        self._path = path
        self._found: dict[str, tuple[Row, float | None]] = {}
        try:
            text = path.read_bytes() if path.exists() else b""
            *lines, torn = text.split(b"\n")
            for number, line in enumerate(lines, start=1):
                self._read(number, line)
            if torn and not torn.startswith(b"{"):
                self._read(len(lines) + 1, torn)
            if torn:
                os.truncate(path, len(text) - len(torn))
            self._file = path.open("ab")
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
        self._found[record["key"]] = record["row"], record["time_limit"]

    def finished(self, key: str, time_limit: float | None) -> Row | None:
        """Return a task's row, or None if the task is to be run (again).

        A run that raised an error or took its worker along is tried again, since both may lie in
        the machine; one over its time limit only if it may take longer now.
        """
        row, limit = self._found.get(key, (None, None))
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
        try:
            self._file.write(line.encode())
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise InputError(f"{self._path}: cannot be written ({error.strerror})") from None
        self._found[key] = row, time_limit

    def __exit__(self, *_: object) -> None:
        self._file.close()
