"""The table [output] readings: windows and rates at which peaks are read beside the usual ones."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.schema.checks import key
from exu_press.schema.table import Table

__all__ = ["DEGREES", "SECONDS", "Readings"]

SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
DEGREES = {"deg": 1.0, "mdeg": 1e-3}
RATES = {"khz": 1e3, "hz": 1.0}

USUAL = ("1ms", "1khz")

ROUNDED = 1e-9
"""Relative difference from a whole number by which a decimal number is one."""


@dataclass(frozen=True)
class Readings(Table):
    """Windows of means and rates of samples, with which peaks are read beside 1 ms and 1 kHz.

    Raises:
        InputError: a value is not positive, no whole number of nanoseconds, thousandths of a degree
            or hertz, or the same as another one or as the usual one.
    """

    table: ClassVar[str] = "output.readings"
    average: tuple[float, ...] = key(None, "windows of means", "s", numbers=0)
    average_deg: tuple[float, ...] = key(
        None, "windows of means, by the crank's angle at constant speed", "deg", numbers=0
    )
    sampled: tuple[float, ...] = key(None, "rates of samples of the displacement", "Hz", numbers=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        labels = [*USUAL, *self.windows, *self.rates]
        twice = next((label for label in labels if labels.count(label) > 1), None)
        if twice is not None:
            raise InputError(f"{self.table}: {twice} is read already; allowed is each once")

    @property
    def windows(self) -> list[str]:
        """Windows of means by their names, as "500us"."""
        of_time = self._labels("average", SECONDS)
        return [*of_time, *self._labels("average_deg", DEGREES)]

    @property
    def rates(self) -> list[str]:
        """Rates of samples by their names, as "5khz"."""
        return list(self._labels("sampled", RATES))

    def too_long(self, turns: float, speed_rpm: float) -> Iterator[str]:
        """Yield in words the readings that a record of so many revolutions is too short for."""
        record = 60.0 * turns / speed_rpm
        spans = [("average", value, value, "s") for value in self.average or ()]
        spans += [("average_deg", v, v / (6.0 * speed_rpm), "deg") for v in self.average_deg or ()]
        spans += [("sampled", rate, 2.0 / rate, "Hz") for rate in self.sampled or ()]
        for name, value, span, unit in spans:
            if span > (1.0 + ROUNDED) * record:
                yield (
                    f"{self.table}.{name} has {value:g} {unit}, which reads {span:.3g} s at least; "
                    f"the record from which quantities are read has {record:.3g} s, so that it has "
                    "no value"
                )

    def _labels(self, name: str, units: Mapping[str, float]) -> Iterable[str]:
        """Return values as whole numbers of the largest of some units that makes them so."""
        for value in getattr(self, name) or ():
            for unit, size in units.items():
                count = round(value / size)
                if count >= 1 and abs(value / size - count) <= ROUNDED * count:
                    yield f"{count}{unit}"
                    break
            else:
                unit = {"average": "s", "average_deg": "deg", "sampled": "Hz"}[name]
                raise InputError(
                    f"{self.table}.{name} has {value!r} {unit}; allowed are whole multiples of "
                    f"{min(units.values()):g} {unit}, from that on"
                )
