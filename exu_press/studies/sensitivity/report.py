"""The report of a sensitivity study: spreads of quantities, and shares of the keys in them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant, uncertain
from exu_press.schema.csv_table import Value
from exu_press.studies.base.report import (
    Points,
    Report,
    Table,
    command_text,
    quantity_column,
)
from exu_press.studies.sensitivity.indices import Indices, Sample
from exu_press.studies.sensitivity.spread import Spread
from exu_press.studies.sensitivity.study import Sensitivity

__all__ = ["SensitivityReport", "to_resolution"]

NO_EFFECT = 0.01
"""Upper bound of the total index of a key without effect."""

NOISE = 0.1
"""Error of the runs over the deviation, above which it affects the result."""


@dataclass(frozen=True)
class SensitivityReport(Report):
    """The result of a sensitivity study; quantities and keys in the study's order.

    Attributes:
        indices: of each quantity; None of one that does not move.
        middle: values with all keys at their medians, (s,).
        bars: values with one key at the ends of its distribution, (k, 2, s).
        errors: of each quantity in the run with all keys at their medians; None where unknown.
    """

    name = "sensitivity"
    files = ("sensitivity.json", "samples.csv")
    heading = "Sensitivity"
    drawn = (("sensitivity", "Spreads, changes by one key, shares of the variance."),)

    study: Sensitivity
    sample: Sample
    indices: list[Indices | None]
    spreads: list[Spread]
    middle: Array
    bars: Array
    errors: list[float | None]
    run_summary: list[str]

    @property
    def subtitle(self) -> str:
        """Number of runs."""
        return self.run_summary[0]

    def tables(self) -> list[Table]:
        """Return the runs, and for each quantity its spread and its share by key."""
        names = self.study.sensitivity.quantities
        quantities = [self._table(index, name) for index, name in enumerate(names)]
        return [Table("Runs", above=self.run_summary), *quantities]

    def points(self) -> Points:
        """Return the presses of the sample, the first quantity over the key that decides it."""
        samples, keys = self.samples(), list(self.study.keys)
        names = self.study.sensitivity.quantities
        shares = self.indices[0]
        decisive = keys[0] if shares is None else keys[int(shares.total.argmax())]
        presses = zip(*(samples[key] for key in keys), strict=True)
        return Points(
            [quantity_column(key, samples[key]) for key in keys],
            [quantity_column(name, samples[name]) for name in names],
            [command_text(dict(zip(keys, press, strict=True))) for press in presses],
            decisive,
            names[0],
            title="Presses of the sample",
        )

    def csv_files(self) -> dict[str, Mapping[str, Sequence[Value]]]:
        """Return keys and quantities of the sample."""
        return {"samples.csv": self.samples()}

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of sensitivity.json."""
        names = self.study.sensitivity.quantities
        quantities = {name: self._entry(index) for index, name in enumerate(names)}
        return {"runs": self.run_summary, "drawn": self.sample.drawn, "quantities": quantities}

    def samples(self) -> dict[str, list[float]]:
        """Return keys and quantities of the two independent samples, the contents of samples.csv.

        These presses are drawn from the distributions, and no key is the same in two of them.
        """
        shares = np.concatenate(self.sample.shares)
        points = [self.study.point_of(share) for share in shares]
        keys = {name: [point[name] for point in points] for name in self.study.keys}
        names = self.study.sensitivity.quantities
        return keys | dict(zip(names, self.sample.values.tolist(), strict=True))

    def _entry(self, index: int) -> dict[str, Any]:
        shares, spread = self.indices[index], self.spreads[index]
        keys: dict[str, Any] = {}
        for n, key in enumerate(self.study.keys):
            keys[key] = {"alone": self.bars[n, :, index]}
            for order in ("first", "total") if shares is not None else ():
                low, high = getattr(shares, f"{order}_bounds")[n]
                entry = {"value": getattr(shares, order)[n], "low": low, "high": high}
                keys[key][f"{order}_order"] = entry
        return {
            "percentiles": {"5": spread.low, "50": spread.middle, "95": spread.high},
            "mean": spread.mean,
            "deviation": spread.deviation,
            "share": self.study.sensitivity.share,
            "half_width": spread.half,
            "half_width_standard_error": spread.half_error,
            "error_of_a_run": self.errors[index],
            "moves": shares is not None,
            "keys": keys,
        }

    def _table(self, index: int, name: str) -> Table:
        study, shares, spread = self.study, self.indices[index], self.spreads[index]
        quantity = quantity_of(study.scene, name).quantity.in_scaled_unit([spread.middle])
        scale = quantity.scale
        unit = f" {quantity.display_unit}" if quantity.display_unit else ""
        if shares is None:
            middle = significant(spread.middle * scale, quantity.digits)
            text = f"{name}: does not move, {middle}{unit} in every run"
            return Table(f"Shares: {name}", above=[text])
        share = f"{100 * study.sensitivity.share:g} %"

        def text_of(value: float) -> str:
            return to_resolution(value * scale, spread.deviation * scale)

        half = uncertain(spread.half, {"error": spread.half_error, "determined": True}, scale)
        lines = [
            f"{name}: {text_of(spread.middle)}{unit}, and in {share} of the presses built no more "
            f"than {half.replace(' +- ', ' (+- ')}){unit} off",
            f"  5 % lie below {text_of(spread.low)}, 95 % below {text_of(spread.high)}{unit}; "
            f"standard deviation {significant(spread.deviation * scale, 3)}{unit}",
        ]
        error = self.errors[index]
        if error is not None:
            ratio = error / spread.deviation
            text = f"  a run's own error is {significant(error * scale, 2)}{unit}"
            lines.append(
                f"{text}: {significant(100 * ratio, 2)} % of the deviation"
                + (", and is part of it; the cure is a lower solver.tolerance" * (ratio > NOISE))
            )
        rows = []
        for n in np.argsort(-shares.total):
            ends = [
                text_of(x) if np.isfinite(x) else "failed"
                for x in map(float, self.bars[n, :, index])
            ]
            rows.append(
                (
                    list(study.keys)[n],
                    _index_text(shares.first[n], shares.first_bounds[n]),
                    _index_text(shares.total[n], shares.total_bounds[n])
                    + (", no effect" if shares.total_bounds[n, 1] < NO_EFFECT else ""),
                    f"{ends[0]} to {ends[1]}",
                )
            )
        head = ("key", "alone", "with others", f"5 to 95 % of the key alone,{unit}")
        return Table(f"Shares: {name}", head, rows, above=lines, indent=2)


def to_resolution(value: float, resolution: float) -> str:
    """Return a number with the digits that show a hundredth of a resolution.

    >>> to_resolution(469.94163, 0.005), to_resolution(169.37, 58.0)
    ('469.94163', '169.4')
    """
    places = max(2 - math.floor(math.log10(resolution)), 0) if resolution > 0.0 else 6
    return f"{value:.{places}f}"


def _index_text(value: float, bounds: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> str:
    share, low, high = (f"{round(float(x), 2) + 0.0:.2f}" for x in (value, *bounds))
    return f"{share} ({low} to {high})"
