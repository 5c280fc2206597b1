"""A measured curve beside the runs that are compared with it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import evaluate
from exu_press.quantities.uncertain import significant
from exu_press.result import Result
from exu_press.studies.curve_file import (
    OVER,
    CurveFile,
    channel_polynomials,
    factor_to,
    line_over_rows,
)

__all__ = ["MEASURED", "MEASURED_PICTURE", "CurveComparison", "compare_curve", "comparison_rows"]

DIGITS = 3

MEASURED, MEASURED_PICTURE = "measured.json", "compare_measured"
"""Differences of runs from curves, in the directory of results, and their picture."""


@dataclass(frozen=True)
class CurveComparison:
    """A measured curve, and what a run has at its places, SI.

    Attributes:
        measured: (m,).
        values: computed ones there, (m,).
        line: places and values of the computed curve, also at the run's own rows between them.
        unit: of both.
    """

    curve: CurveFile
    measured: Array
    values: Array
    line: tuple[Array, Array]
    unit: str

    def plain(self) -> dict[str, float | str]:
        """Return the differences between the two, by name."""
        differences = self.values - self.measured
        worst = int(np.abs(differences).argmax())
        return {
            "over": self.curve.over,
            "unit": self.unit,
            "rms_difference": float(np.sqrt(np.mean(differences**2))),
            "rms_measured": float(np.sqrt(np.mean(self.measured**2))),
            "largest_difference": float(differences[worst]),
            "at": float(self.curve.at[worst]),
            "largest_measured": float(np.abs(self.measured).max()),
            "largest_computed": float(np.abs(self.values).max()),
        }


def compare_curve(file: Path, curve: CurveFile, result: Result) -> CurveComparison:
    """Return a measured curve beside a run.

    Raises:
        InputError: the run has no such channel, or not over all of the curve.
    """
    at, polynomials, unit = channel_polynomials(str(file), curve, result)
    measured = factor_to(f"{file}: {curve.name}", curve.unit, unit) * curve.values
    begin, end = float(at[0]), float(at[-1])
    if curve.at[0] < begin - 1e-9 or curve.at[-1] > end + 1e-9:
        raise InputError(
            f"{file}: {curve.over} from {curve.at[0]:g} to {curve.at[-1]:g}; allowed is a part of "
            f"the run, from {begin:g} to {end:g} (--set revolutions=... makes it longer)"
        )
    values = evaluate(at, polynomials, curve.at)
    line = line_over_rows(at, polynomials, curve.at)
    return CurveComparison(curve, measured, values, line, unit)


def comparison_rows(name: str, runs: Mapping[str, Mapping[str, Any]]) -> list[list[str]]:
    """Return a table: the head, then a curve's differences from the runs, a column each.

    Args:
        runs: label of the run -> as `CurveComparison.plain` tells it.
    """
    first = next(iter(runs.values()))
    rows = [[f"measured: {name}, {first['unit']}", *runs]]
    for key, label in (
        ("rms_difference", "rms of the difference"),
        ("rms_measured", "rms measured"),
        ("largest_difference", "largest difference, computed - measured"),
        ("at", f"at, {OVER[first['over']]}"),
        ("largest_measured", "largest value measured"),
        ("largest_computed", "largest value computed there"),
    ):
        rows.append(
            [f"  {label}", *(significant(difference[key], DIGITS) for difference in runs.values())]
        )
    return rows
