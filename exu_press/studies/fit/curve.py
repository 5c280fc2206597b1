"""A measured curve beside a computed one; the sensor's own parameters are fitted with it."""

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
from exu_press.schema.checks import Table, key
from exu_press.studies.curve_file import CurveFile, factor_to, read_curve
from exu_press.studies.fit.measured import under_of

__all__ = ["Curve", "Matched", "matched"]

PER_PERIOD = 20
"""Samples of the computed curve in a period of a sensor's upper corner frequency."""

ROUNDS = 3
"""Rounds of fitting shift and corner frequencies one after the other."""


@dataclasses.dataclass(frozen=True)
class Curve(Table):
    """A table [[curve]]: a channel of a run as a sensor recorded it.

    Attributes:
        low_cut, high_cut: corner frequencies of the sensor's band, Hz: a number, or two between
            which it is unknown; both filters are of second order (Butterworth).
        under: keys of the scene that differ where it was measured -> their values.
        measured: data of the file.

    Raises:
        InputError: not allowed.
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
        object.__setattr__(self, "under", under_of("curve", self.under))

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
        return int(self.offset) + sum(len(each) == 2 and each[0] < each[1] for each in unknown)

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
        """Independent numbers in it: samples closer than the correlation length are one."""
        at = self.read.at
        if self.correlation == 0.0:
            return float(len(at))
        return min(float(len(at)), 1.0 + float(at[-1] - at[0]) / self.correlation)


@dataclasses.dataclass(frozen=True)
class Matched:
    """A computed curve as the sensor would have recorded it.

    Attributes:
        values: at the measured places, (m,).
        offset, shift, low_cut, high_cut: of the sensor; None of a filter that it has not.
        unit: SI, of the values.
    """

    values: Array
    offset: float
    shift: float
    low_cut: float | None
    high_cut: float | None
    unit: str = ""

    def plain(self) -> dict[str, float]:
        """Return the sensor's parameters that there are."""
        names = ("offset", "shift", "low_cut", "high_cut")
        return {n: getattr(self, n) for n in names if getattr(self, n) is not None}


def matched(curve: Curve, wanted: Array, at: Array, polynomials: Array) -> Matched | None:
    """Return the computed curve with the sensor's parameters that fit best; None if too short.

    The parameters of the sensor are fitted inside of each evaluation of the keys (variable
    projection: G. Golub, V. Pereyra, Inverse Problems 19 (2003) R1-R26).

    Args:
        curve: measured data, and unknowns of the sensor.
        wanted: measured values, SI, (m,).
        at: where the run has values, (n,), increasing.
        polynomials: their coefficients between these, (4, n - 1).
    """
    places = curve.read.at
    if places[0] + curve.shift[0] < at[0] - 1e-9 or places[-1] + curve.shift[1] > at[-1] + 1e-9:
        return None
    unknown = (curve.shift, curve.low_cut, curve.high_cut)

    def recorded(shift: float, low: float | None, high: float | None) -> Matched:
        t, between = at, polynomials
        if low is not None or high is not None:
            t, between = _filtered(at, polynomials, low, high)
        found = evaluate(t, between, places + shift)
        offset = float((wanted - found).mean()) if curve.offset else 0.0
        return Matched(found + offset, offset, shift, low, high)

    def misfit(parts: list[float | None]) -> float:
        shift, low, high = parts
        found = recorded(shift or 0.0, low, high)
        return float(((wanted - found.values) ** 2).sum())

    best: list[float | None] = [sum(each) / len(each) if each else None for each in unknown]
    free = [n for n, each in enumerate(unknown) if len(each) == 2 and each[0] < each[1]]
    for _ in range(ROUNDS if len(free) > 1 else len(free)):
        for n in free:
            low, high = unknown[n]

            def along(value: float, n: int = n) -> float:
                return misfit([*best[:n], value, *best[n + 1 :]])

            grid = np.linspace(low, high, 15)
            place = int(np.argmin([along(float(v)) for v in grid]))
            ends = grid[max(place - 1, 0)], grid[min(place + 1, len(grid) - 1)]
            told = minimize_scalar(along, bounds=ends, method="bounded",
                                   options={"xatol": 1e-6 * (high - low)})  # fmt: skip
            best[n] = float(told.x)
    return recorded(best[0] or 0.0, best[1], best[2])


def _filtered(
    at: Array, polynomials: Array, low: float | None, high: float | None
) -> tuple[Array, Array]:
    """Return a curve through the sensor's band, at even times, from rest in its first value."""
    fastest = max(f for f in (low, high) if f is not None)
    number = max(int((at[-1] - at[0]) * fastest * PER_PERIOD), len(at)) + 1
    even = np.linspace(at[0], at[-1], number)
    found, rate = evaluate(at, polynomials, even), (number - 1) / (at[-1] - at[0])
    for corner, kind in ((low, "highpass"), (high, "lowpass")):
        if corner is not None:
            sections = butter(2, corner, kind, fs=rate, output="sos")
            found = sosfilt(sections, found, zi=sosfilt_zi(sections) * found[0])[0]
    return even, eno_cubic(even, found)
