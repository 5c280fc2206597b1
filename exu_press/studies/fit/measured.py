"""Measured numbers, and measured curves beside computed ones, with fitted parameters of sensors."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.signal import butter, sosfilt, sosfilt_zi

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import eno_cubic, evaluate
from exu_press.schema.checks import key
from exu_press.schema.csv_table import flat
from exu_press.schema.table import Table
from exu_press.studies.curve_file import CurveFile, factor_to, line_over_rows, read_curve

__all__ = ["Curve", "MeasuredNumber", "RecordedCurve", "dotted_keys", "fit_sensor"]

PER_PERIOD = 20
"""Samples of the computed curve per period of a sensor's upper corner frequency."""

ROUNDS = 3
"""Rounds of fitting shift and corner frequencies, each in turn."""


@dataclasses.dataclass(frozen=True)
class MeasuredNumber(Table):
    """A table [[measured]]: the reading of an instrument.

    Attributes:
        quantity: full name, with its kind of observation, as a peak averaged over 1 ms.
        under: key of the scene that differs in the measurement -> its value.
    """

    table = "measured"

    required = ("quantity", "value", "uncertainty")

    quantity: str = key(None, "name of a quantity")
    value: float = key(None, "reading, SI")
    uncertainty: float = key(None, "its standard deviation, SI", above=0)
    weight: float = key(1.0, "how often it counts", above=0)
    under: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "under", dotted_keys("measured", self.under))

    @property
    def name(self) -> str:
        """Its name in tables."""
        return self.quantity + "".join(f", {k} = {v:g}" if isinstance(v, float) else f", {k} = {v}"
                                       for k, v in self.under.items())  # fmt: skip


def dotted_keys(table: str, data: Any) -> dict[str, Any]:
    """Return the keys of a nested table by dotted names: TOML's a.b is its "a.b"."""
    if not isinstance(data, Mapping):
        raise InputError(f"{table}.under = {data!r:.80}: allowed is a table of keys of the scene")
    return flat(data)


@dataclasses.dataclass(frozen=True)
class Curve(Table):
    """A table [[curve]]: a channel of a run as a sensor recorded it.

    Attributes:
        low_cut, high_cut: corner frequencies of the sensor's band, Hz: a number, or two between
            which it is unknown; both filters are of second order (Butterworth).
        under: key of the scene that differs in the measurement -> its value.
    """

    table = "curve"

    required = ("file", "uncertainty")

    file: str = key(None, "a CSV file, beside the study")
    uncertainty: float = key(None, "standard deviation of a sample, SI", above=0)
    correlation: float = key(0.0, "time or angle over which samples are one, SI or deg", at_least=0)
    weight: float = key(1.0, "how often it counts", above=0)
    offset: bool = key(False, "whether the sensor's zero is unknown")
    shift: tuple[float, ...] = key((0.0, 0.0), "added to its time or angle", "s or deg", numbers=2)
    low_cut: tuple[float, ...] = key((), "lower corner frequency of the sensor", "Hz", numbers=0)
    high_cut: tuple[float, ...] = key((), "upper corner frequency of the sensor", "Hz", numbers=0)
    under: Mapping[str, Any] = dataclasses.field(default_factory=dict, hash=False)
    measured: CurveFile | None = dataclasses.field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.shift[0] <= self.shift[1]:
            raise InputError(f"curve.shift = {list(self.shift)}: allowed is [low, high]")
        for name in ("low_cut", "high_cut"):
            cut = getattr(self, name)
            if len(cut) > 2 or any(c <= 0.0 for c in cut) or list(cut) != sorted(cut):
                raise InputError(
                    f"curve.{name} = {list(cut)}: allowed is [frequency] or [low, high], > 0 (Hz)"
                )
        if self.low_cut and self.high_cut and self.low_cut[0] >= self.high_cut[-1]:
            raise InputError(
                f"curve.low_cut = {list(self.low_cut)}, high_cut = {list(self.high_cut)}: nothing "
                "is left of the curve; allowed is a low_cut below the high_cut"
            )
        if (self.low_cut or self.high_cut) and self.read.over != "time":
            raise InputError(
                f"curve.low_cut and high_cut: {self.file} has {self.read.over}; allowed is time"
            )
        object.__setattr__(self, "under", dotted_keys("curve", self.under))

    @property
    def read(self) -> CurveFile:
        """Contents of the file; its path counts from the study's directory."""
        if self.measured is None:
            object.__setattr__(self, "measured", read_curve(Path(self.file)))
        assert self.measured is not None
        return self.measured

    @property
    def nuisances(self) -> int:
        """Number of the sensor's parameters that are fitted."""
        unknown = [self.shift, self.low_cut, self.high_cut]
        return int(self.offset) + sum(len(ends) == 2 and ends[0] < ends[1] for ends in unknown)

    @property
    def name(self) -> str:
        """Its name in tables."""
        return Path(self.file).stem

    def values(self, unit: str) -> Array:
        """Return the measured values in a channel's SI unit, (m,)."""
        factor = factor_to(f"{self.file}: {self.read.name}", self.read.unit, unit)
        return self.read.values * factor

    @property
    def count(self) -> float:
        """Number of independent samples: those closer than the correlation length count once."""
        at = self.read.at
        if self.correlation == 0.0:
            return float(len(at))
        return min(float(len(at)), 1.0 + float(at[-1] - at[0]) / self.correlation)


@dataclasses.dataclass(frozen=True)
class RecordedCurve:
    """A computed curve as the sensor would have recorded it.

    Attributes:
        values: at the measured samples, (m,).
        offset, shift, low_cut, high_cut: of the sensor; None of a filter that it lacks.
        at, polynomials: of the computed curve through the sensor's band, without its offset.
        unit: SI, of the values.
    """

    values: Array
    offset: float
    shift: float
    low_cut: float | None
    high_cut: float | None
    at: Array
    polynomials: Array
    unit: str = ""

    def line(self, samples: Array) -> tuple[Array, Array]:
        """Return places and values of its line over the measured curve, see `line_over_rows`."""
        places, values = line_over_rows(self.at, self.polynomials, samples, self.shift)
        return places, values + self.offset

    def plain(self) -> dict[str, float]:
        """Return name -> value of the sensor's parameters."""
        names = ("offset", "shift", "low_cut", "high_cut")
        return {n: getattr(self, n) for n in names if getattr(self, n) is not None}


def fit_sensor(
    curve: Curve, measured: Array, at: Array, polynomials: Array
) -> RecordedCurve | None:
    """Return the computed curve with the best sensor parameters; None if it is too short.

    The parameters of the sensor are fitted inside of each evaluation of the keys (variable
    projection: G. Golub, V. Pereyra, Inverse Problems 19 (2003) R1-R26).

    Args:
        measured: values, SI, (m,).
        at: times or angles of the run's values, (n,), increasing.
        polynomials: coefficients of the computed curve between them, (4, n - 1).
    """
    samples = curve.read.at
    if samples[0] + curve.shift[0] < at[0] - 1e-9 or samples[-1] + curve.shift[1] > at[-1] + 1e-9:
        return None
    unknown = (curve.shift, curve.low_cut, curve.high_cut)

    def record(shift: float, low: float | None, high: float | None) -> RecordedCurve:
        t, coefficients = at, polynomials
        if low is not None or high is not None:
            t, coefficients = _apply_band(at, polynomials, low, high)
        computed = evaluate(t, coefficients, samples + shift)
        offset = float((measured - computed).mean()) if curve.offset else 0.0
        return RecordedCurve(computed + offset, offset, shift, low, high, t, coefficients)

    def misfit(parameters: list[float | None]) -> float:
        shift, low, high = parameters
        return float(((measured - record(shift or 0.0, low, high).values) ** 2).sum())

    best: list[float | None] = [sum(ends) / len(ends) if ends else None for ends in unknown]
    free = [n for n, ends in enumerate(unknown) if len(ends) == 2 and ends[0] < ends[1]]
    for _ in range(ROUNDS if len(free) > 1 else len(free)):
        for n in free:
            low, high = unknown[n]

            def misfit_at(value: float, n: int = n) -> float:
                return misfit([*best[:n], value, *best[n + 1 :]])

            grid = np.linspace(low, high, 15)
            nearest = int(np.argmin([misfit_at(float(v)) for v in grid]))
            bounds = grid[max(nearest - 1, 0)], grid[min(nearest + 1, len(grid) - 1)]
            options = {"xatol": 1e-6 * (high - low)}
            best[n] = float(
                minimize_scalar(misfit_at, bounds=bounds, method="bounded", options=options).x
            )
    return record(best[0] or 0.0, best[1], best[2])


def _apply_band(
    at: Array, polynomials: Array, low: float | None, high: float | None
) -> tuple[Array, Array]:
    """Return even times and coefficients of a curve filtered by the sensor's band.

    The filter is at rest at the first value.
    """
    fastest = max(f for f in (low, high) if f is not None)
    number = max(int((at[-1] - at[0]) * fastest * PER_PERIOD), len(at)) + 1
    even = np.linspace(at[0], at[-1], number)
    values, rate = evaluate(at, polynomials, even), (number - 1) / (at[-1] - at[0])
    for corner, kind in ((low, "highpass"), (high, "lowpass")):
        if corner is not None:
            sections = butter(2, corner, kind, fs=rate, output="sos")
            values = sosfilt(sections, values, zi=sosfilt_zi(sections) * values[0])[0]
    return even, eno_cubic(even, values)
