"""Channels of a run that are on disk, or computed when they are asked for."""

import copy
from abc import ABC
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array, checksum
from exu_press.result.channel import Channel

if TYPE_CHECKING:
    from fe_models.temporary import TemporaryFolder

__all__ = [
    "LazyChannels",
    "MemmapChannels",
    "channel_headers",
    "is_on_disk",
    "read_columns",
    "read_rows",
]


AT_ONCE = 100_000
"""Instants."""


class _StoredChannels(Mapping[str, Channel], ABC):
    """Channels whose values are read or computed when they are asked for.

    Attributes:
        headers: channels whose values do not count.
        is_on_disk: whether the values are read from the disk.
    """

    headers: Mapping[str, Channel]
    is_on_disk: bool

    def __contains__(self, name: object) -> bool:
        return name in self.headers

    def __iter__(self) -> Iterator[str]:
        return iter(self.headers)

    def __len__(self) -> int:
        return len(self.headers)

    def __reduce__(self) -> Any:
        """Go to another process with all values in memory."""
        return dict, (dict(self),)


class MemmapChannels(_StoredChannels):
    """Channels on disk, read by pages.

    Attributes:
        count: number of instants.
        headers: channels without a value.
        checksums: CRC-32 of the values of each channel, one instant after the other.
    """

    headers: dict[str, Channel]
    is_on_disk = True

    def __init__(self, directory: Path | None = None) -> None:
        """Start without a channel, in an empty directory, or in one that goes with this object."""
        self.count = 0
        self._temporary = None if directory is not None else _temporary_folder()
        self._directory = directory or (self._temporary.path if self._temporary else Path())
        self.headers = {}
        self.checksums: dict[str, int] = {}
        self._last: dict[str, Array] = {}  # value of each channel
        self._unchecked: set[str] = set()

    @classmethod
    def reopen(
        cls,
        directory: Path,
        headers: Mapping[str, Channel],
        count: int,
        checksums: Mapping[str, int],
    ) -> "MemmapChannels":
        """Return the first `count` instants of channels in a directory, checked when first read."""
        channels = cls(directory)
        channels.headers, channels.count, channels.checksums = dict(headers), count, dict(checksums)
        channels._unchecked = set(headers)
        return channels

    def append(self, channels: Mapping[str, Channel]) -> None:
        """Append the next instants of every channel; the first repeats the last one.

        Energies count from it in `channels`, and from the start here.
        """
        from exu_press.files.output_directory import writing

        first = 1 if self.count else 0
        for name, channel in channels.items():
            values = channel.values[first:]
            if not first:
                self.headers[name] = replace(channel, values=values[:0])
            elif channel.unit == "J":
                values = values + self._last[name]
            stored = np.ascontiguousarray(values, np.float64)
            with writing(self._file(name)), self._file(name).open("ab") as file:
                file.write(stored.data)
            self.checksums[name] = checksum(stored, self.checksums.get(name, 0))
            if len(values):
                self._last[name] = values[-1].copy()
        self.count += len(channels["time"].values) - first

    def __getitem__(self, name: str) -> Channel:
        headers = self.headers[name]
        shape = self.count, *headers.values.shape[1:]
        try:  # pages are read when they are used; a path of its own type takes as long as the map
            values = np.memmap(str(self._file(name)), np.float64, "r", shape=shape)
        except (OSError, ValueError):  # missing, or too short
            raise InputError(f"{self._file(name)}: not a whole channel of a run") from None
        if name in self._unchecked:
            self._check(name, values)
        channel = copy.copy(headers)
        object.__setattr__(channel, "values", values.view(np.ndarray))  # checked block by block
        return channel

    def _check(self, name: str, values: Array) -> None:
        """Raise InputError unless the values of a channel have its checksum."""
        checksum_read = 0
        for first in range(0, self.count, AT_ONCE):
            checksum_read = checksum(values[first : first + AT_ONCE], checksum_read)
        if checksum_read != self.checksums.get(name):
            raise InputError(f"{self._file(name)}: damaged: its values do not have their checksum")
        self._unchecked.remove(name)

    def blocks(self, name: str) -> Iterator[Array]:
        """Yield the values of a channel AT_ONCE by AT_ONCE.

        The pages of a map stay in memory as long as the map does.
        """
        for first in range(0, self.count, AT_ONCE):
            yield self[name].values[first : first + AT_ONCE]

    def in_memory(self) -> dict[str, Channel]:
        """Return all channels with their values in memory."""
        return {
            name: replace(channel, values=np.array(channel.values))
            for name, channel in self.items()
        }

    def _file(self, name: str) -> Path:
        return self._directory / name


def _temporary_folder() -> "TemporaryFolder":
    """Return a folder that goes with the channels, which a run in memory does not need."""
    from fe_models.temporary import TemporaryFolder

    return TemporaryFolder()


class LazyChannels(_StoredChannels):
    """Channels with changed values, each computed when it is asked for.

    Values in memory stay there; those of channels on disk are computed each time.

    Attributes:
        channels: that are changed.
        change: name and values of a channel -> its changed values.
    """

    def __init__(
        self, channels: Mapping[str, Channel], change: Callable[[str, Array], Array]
    ) -> None:
        """Change channels by a function of their name and their values."""
        self.channels, self.change = channels, change
        self.headers, self.is_on_disk = channel_headers(channels), is_on_disk(channels)
        self._computed: dict[str, Channel] = {}

    def __getitem__(self, name: str) -> Channel:
        if name in self._computed:
            return self._computed[name]
        channel = self.channels[name]
        channel = replace(channel, values=self.change(name, channel.values))
        if not self.is_on_disk:
            self._computed[name] = channel
        return channel


def channel_headers(channels: Mapping[str, Channel]) -> Mapping[str, Channel]:
    """Return channels with their units and meanings, whatever values they have: none is read."""
    return channels.headers if isinstance(channels, _StoredChannels) else channels


def read_columns(
    channels: Mapping[str, Channel], name: str, pick: Callable[[Array], Array]
) -> Array:
    """Return some columns of a channel, as pick(values (n, ...)) of those on disk or in memory.

    A change along the time applies to a part alone.
    """
    if isinstance(channels, LazyChannels) and channels.is_on_disk:
        return channels.change(name, read_columns(channels.channels, name, pick))
    if isinstance(channels, MemmapChannels):
        return np.concatenate([np.array(pick(values)) for values in channels.blocks(name)])
    return pick(channels[name].values)


def read_rows(channels: Mapping[str, Channel], name: str, rows: NDArray[np.intp]) -> Array:
    """Return the values of a channel at some instants, (m, ...), in their order."""
    if not isinstance(channels, MemmapChannels):
        return np.array(channels[name].values[rows])
    bounds = np.searchsorted(rows, range(0, channels.count + AT_ONCE, AT_ONCE))
    blocks = [
        np.array(values[rows[begin:end] - number * AT_ONCE])
        for number, (values, (begin, end)) in enumerate(
            zip(channels.blocks(name), pairwise(bounds), strict=True)
        )
    ]
    return np.concatenate(blocks)


def is_on_disk(channels: Mapping[str, Channel]) -> bool:
    """Return whether channels, or those of which they are computed, are on disk."""
    return isinstance(channels, _StoredChannels) and channels.is_on_disk
