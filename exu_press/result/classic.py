"""NetCDF files in the classic format, read so that no header can ask for more than the file has.

Source: Unidata, The NetCDF Classic Format Specification; variables without a record dimension.
"""

import json
import math
import stat
import struct
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.schema.stored import short_text

__all__ = ["CHECKSUM", "Classic", "Variable", "checksum", "header_checksum", "open_classic"]

T = TypeVar("T")
Number = TypeVar("Number", bound=np.generic)

DIMENSION, VARIABLE, ATTRIBUTE = 10, 11, 12
TEXT = 2
TYPES = {1: "i1", TEXT: "S1", 3: ">i2", 4: ">i4", 5: ">f4", 6: ">f8"}

CHECKSUM = "checksum"
"""Attribute of a variable, whose bytes it belongs to, and of a file, whose header it belongs to."""


def checksum(data: NDArray[Any], preceding: int = 0) -> int:
    """Return the CRC-32 of an array's bytes in order, behind bytes whose checksum is `before`."""
    return zlib.crc32(np.ascontiguousarray(data).data, preceding)


def header_checksum(
    attributes: Mapping[str, bytes],
    variables: Mapping[str, tuple[Mapping[str, int], Mapping[str, bytes], np.dtype[Any]]],
) -> str:
    """Return the CRC-32 of a header's texts, names, types and sizes, 8 hexadecimal digits.

    Args:
        attributes: of the file; its own checksum does not count.
        variables: dimensions, attributes and type in the file, by name.
    """

    def plain(texts: Mapping[str, bytes]) -> dict[str, str]:
        return {name: text.decode("latin-1") for name, text in texts.items()}

    whole = {name: text for name, text in attributes.items() if name != CHECKSUM}
    header = {
        name: ([*axes.items()], plain(texts), dtype.str)
        for name, (axes, texts, dtype) in variables.items()
    }
    text = json.dumps([plain(whole), header], sort_keys=True)
    return f"{zlib.crc32(text.encode()):08x}"


@dataclass(frozen=True)
class Variable:
    """A variable.

    Attributes:
        dimensions: name -> length.
        attributes: texts, not decoded; empty where an attribute is none.
        stored: its values in the file, in the dimensions' shape, not in memory.
    """

    dimensions: Mapping[str, int]
    attributes: Mapping[str, bytes]
    stored: NDArray[Any]

    def values(self, dtype: type[Number]) -> NDArray[Number]:
        """Return a copy in memory.

        Raises:
            InputError: the file has another type, or bytes that the variable's checksum is not of.
        """
        if self.attributes[CHECKSUM] != b"%08x" % checksum(self.stored):
            raise InputError("its values are damaged: they do not have the checksum of the file")
        if self.stored.dtype.newbyteorder("=") != dtype:
            raise InputError(f"type {self.stored.dtype.name}; allowed is {np.dtype(dtype).name}")
        return self.stored.astype(dtype)


@dataclass(frozen=True)
class Classic:
    """Contents of a file; attributes as of a `Variable`."""

    attributes: Mapping[str, bytes]
    variables: Mapping[str, Variable]

    def check_header(self) -> None:
        """Raise InputError where the header is not the one that its checksum was made of."""
        header = {
            name: (variable.dimensions, variable.attributes, variable.stored.dtype)
            for name, variable in self.variables.items()
        }
        bare = [
            name for name, variable in self.variables.items() if CHECKSUM not in variable.attributes
        ]
        expected = header_checksum(self.attributes, header).encode()
        if bare or self.attributes.get(CHECKSUM) != expected:
            raise InputError("its header is damaged: it does not have the checksum of the file")


def open_classic(path: Path) -> Classic:
    """Return the contents of a file; the values are read when they are used.

    Raises:
        InputError: this is no whole file of the classic format.
        OSError: it cannot be opened.
    """
    if not stat.S_ISREG(path.stat().st_mode):
        raise OSError("not a file")
    if path.stat().st_size < 4:
        raise InputError("not a NetCDF file of the classic format")
    return _Header(np.memmap(path, np.uint8, "r")).read()


class _Header:
    """Reads a header from its begin to its end."""

    def __init__(self, data: NDArray[np.uint8]) -> None:
        self._data, self._offset_read, self._unclaimed = data, 0, len(data)
        self._dimensions: list[tuple[str, int]] = []
        self._offset = ">i"

    def read(self) -> Classic:
        """Return everything in the file."""
        magic = self._take(4)
        if magic not in (b"CDF\1", b"CDF\2"):
            raise InputError("not a NetCDF file of the classic format")
        self._offset = ">i" if magic == b"CDF\1" else ">q"
        self._number()  # of records
        self._dimensions = self._list(DIMENSION, lambda: (self._name(), self._number()))
        attributes = dict(self._list(ATTRIBUTE, self._attribute))
        return Classic(attributes, dict(self._list(VARIABLE, self._variable)))

    def _take(self, size: int) -> bytes:
        begin, self._offset_read = self._offset_read, self._offset_read + size
        if size < 0 or self._offset_read > len(self._data):
            raise InputError("the file ends within its header")
        return self._data[begin : self._offset_read].tobytes()

    def _number(self, form: str = ">i") -> int:
        (number,) = struct.unpack(form, self._take(struct.calcsize(form)))
        return int(number)

    def _take_padded(self, size: int) -> bytes:
        taken = self._take(size)
        self._take(-size % 4)
        return taken

    def _name(self) -> str:
        name = self._take_padded(self._number())
        try:
            return name.decode()
        except UnicodeDecodeError:
            raise InputError(f"{short_text(name)}: allowed is a name in UTF-8") from None

    def _list(self, kind: int, read: Callable[[], T]) -> list[T]:
        """Return a list of the header; an empty one may be without its kind."""
        tag, count = self._number(), self._number()
        if tag != kind and (tag, count) != (0, 0):
            raise InputError("the header is damaged")
        return [read() for _ in range(count)]

    def _type(self) -> int:
        kind = self._number()
        if kind not in TYPES:
            raise InputError("the header is damaged")
        return kind

    def _attribute(self) -> tuple[str, bytes]:
        name, kind, count = self._name(), self._type(), self._number()
        values = self._take_padded(count * np.dtype(TYPES[kind]).itemsize)
        return name, values if kind == TEXT else b""

    def _variable(self) -> tuple[str, Variable]:
        name = self._name()
        try:
            axes = dict(self._dimensions[self._number()] for _ in range(self._number()))
        except IndexError:
            raise InputError(f"{short_text(name)}: has a dimension that is none") from None
        attributes = dict(self._list(ATTRIBUTE, self._attribute))
        dtype = np.dtype(TYPES[self._type()])
        self._number()  # size, which the dimensions tell
        begin = self._number(self._offset)
        size = math.prod(axes.values()) * dtype.itemsize
        self._unclaimed -= size
        inside = 0 <= begin <= len(self._data) - size and self._unclaimed >= 0
        if not inside or min(axes.values(), default=1) < 1:
            raise InputError(f"{short_text(name)}: does not lie within the file")
        stored = self._data[begin : begin + size].view(dtype).reshape(tuple(axes.values()))
        return name, Variable(axes, attributes, stored)
