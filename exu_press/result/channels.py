"""The channels of a run where memory does not hold them all: on disk, or worked out when asked."""

import copy
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel

if TYPE_CHECKING:
    from fe_models.temporary import TemporaryFolder

__all__ = ["Changed", "OnDisk", "at_rows", "described", "on_disk", "part_of"]


AT_ONCE = 100_000
"""Instants."""


class OnDisk(Mapping[str, Channel]):
    """Channels on disk, read by pages.

    Attributes:
        count: number of instants.
        begun: channels without a value.
        checksums: CRC-32 of the values of each channel, one instant after the other.
    """

    def __init__(self, directory: Path | None = None) -> None:
        """Start without a channel, in an empty directory, or in one that goes with this object."""
        self.count = 0
        self._temporary = None if directory is not None else _temporary_folder()
        self._directory = directory or (self._temporary.path if self._temporary else Path())
        self.begun: dict[str, Channel] = {}
        self.checksums: dict[str, int] = {}
        self._last: dict[str, Array] = {}  # value of each channel
        self._unchecked: set[str] = set()

    @classmethod
    def found(
        cls, directory: Path, begun: Mapping[str, Channel], count: int, checksums: Mapping[str, int]
    ) -> "OnDisk":
        """Return the channels in a directory; each is checked when it is first read.

        Args:
            directory: in which they are.
            begun: channels without a value.
            count: number of instants; what lies behind them was never finished.
            checksums: of the channels until there.
        """
        channels = cls(directory)
        channels.begun, channels.count, channels.checksums = dict(begun), count, dict(checksums)
        channels._unchecked = set(begun)
        return channels

    def append(self, channels: Mapping[str, Channel]) -> None:
        """Take the next instants of every channel, the first of which is the last one before.

        Energies there count from it; here they count on.
        """
        from exu_press.files.output_directory import writing
        from exu_press.result.classic import checksum

        first = 1 if self.count else 0
        for name, channel in channels.items():
            values = channel.values[first:]
            if not first:
                self.begun[name] = replace(channel, values=values[:0])
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
        begun = self.begun[name]
        shape = self.count, *begun.values.shape[1:]
        try:  # pages are read when they are used; a path of its own type takes as long as the map
            values = np.memmap(str(self._file(name)), np.float64, "r", shape=shape)
        except (OSError, ValueError):  # missing, or too short
            raise InputError(f"{self._file(name)}: not a whole channel of a run") from None
        if name in self._unchecked:
            self._check(name, values)
        found = copy.copy(begun)
        object.__setattr__(found, "values", values.view(np.ndarray))  # checked block by block
        return found

    def _check(self, name: str, values: Array) -> None:
        """Raise InputError unless the values of a channel have its checksum."""
        from exu_press.result.classic import checksum

        made_of = 0
        for first in range(0, self.count, AT_ONCE):
            made_of = checksum(values[first : first + AT_ONCE], made_of)
        if made_of != self.checksums.get(name):
            raise InputError(f"{self._file(name)}: damaged: its values do not have their checksum")
        self._unchecked.remove(name)

    def parts(self, name: str) -> Iterator[Array]:
        """Yield the values of a channel AT_ONCE by AT_ONCE.

        The pages of a map stay in memory as long as the map does.
        """
        for first in range(0, self.count, AT_ONCE):
            yield self[name].values[first : first + AT_ONCE]

    def in_memory(self) -> dict[str, Channel]:
        """Return all channels with their values in memory."""
        return {name: replace(one, values=np.array(one.values)) for name, one in self.items()}

    def __contains__(self, name: object) -> bool:
        return name in self.begun

    def __iter__(self) -> Iterator[str]:
        return iter(self.begun)

    def __len__(self) -> int:
        return len(self.begun)

    def __reduce__(self) -> Any:
        """Go to another process as they are in memory."""
        return dict, (dict(self),)

    def _file(self, name: str) -> Path:
        return self._directory / name


def _temporary_folder() -> "TemporaryFolder":
    """Return a folder that goes with the channels, which a run in memory does not need."""
    from fe_models.temporary import TemporaryFolder

    return TemporaryFolder()


class Changed(Mapping[str, Channel]):
    """Other channels with changed values, each worked out when it is asked for.

    Changed channels in memory stay there; those on disk are worked out each time.

    Attributes:
        channels: that are changed.
        change: name and values of a channel -> its other values.
    """

    def __init__(
        self, channels: Mapping[str, Channel], change: Callable[[str, Array], Array]
    ) -> None:
        """Change channels by a function of their name and their values."""
        self.channels, self.change = channels, change
        self._found: dict[str, Channel] | None = None if on_disk(channels) else {}

    def __getitem__(self, name: str) -> Channel:
        if self._found is not None and name in self._found:
            return self._found[name]
        channel = self.channels[name]
        channel = replace(channel, values=self.change(name, channel.values))
        if self._found is not None:
            self._found[name] = channel
        return channel

    def __contains__(self, name: object) -> bool:
        return name in self.channels

    def __iter__(self) -> Iterator[str]:
        return iter(self.channels)

    def __len__(self) -> int:
        return len(self.channels)

    def __reduce__(self) -> Any:
        """Go to another process with all of them worked out."""
        return dict, (dict(self),)

    @property
    def on_disk(self) -> bool:
        """Return whether the channels that are changed are on disk."""
        return self._found is None


def described(channels: Mapping[str, Channel]) -> Mapping[str, Channel]:
    """Return channels with their units and words, whatever values they have: none is read."""
    if isinstance(channels, OnDisk):
        return channels.begun
    return described(channels.channels) if isinstance(channels, Changed) else channels


def part_of(channels: Mapping[str, Channel], name: str, pick: Callable[[Array], Array]) -> Array:
    """Return some columns of a channel, as pick(values (n, ...)) of those on disk or in memory.

    A change along the time applies to a part alone.
    """
    if isinstance(channels, Changed) and channels.on_disk:
        return channels.change(name, part_of(channels.channels, name, pick))
    if isinstance(channels, OnDisk):
        return np.concatenate([np.array(pick(values)) for values in channels.parts(name)])
    return pick(channels[name].values)


def at_rows(channels: Mapping[str, Channel], name: str, rows: NDArray[np.intp]) -> Array:
    """Return the values of a channel at some instants, (m, ...), in their order."""
    if not isinstance(channels, OnDisk):
        return np.array(channels[name].values[rows])
    bounds = np.searchsorted(rows, range(0, channels.count + AT_ONCE, AT_ONCE))
    found = [
        np.array(values[rows[begin:end] - number * AT_ONCE])
        for number, (values, (begin, end)) in enumerate(
            zip(channels.parts(name), pairwise(bounds), strict=True)
        )
    ]
    return np.concatenate(found)


def on_disk(channels: Mapping[str, Channel]) -> bool:
    """Return whether channels, or those of which they are worked out, are on disk."""
    return isinstance(channels, OnDisk) or (isinstance(channels, Changed) and channels.on_disk)
