"""The report of a fit: best values, intervals, and how well they are determined."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import chi2

from exu_press.numerics.arrays import Array
from exu_press.quantities.uncertain import significant
from exu_press.quantities.units import shown_unit, with_unit
from exu_press.scene import Scene
from exu_press.studies.base import Range
from exu_press.studies.base.report import Line, Panel, Report, Table
from exu_press.studies.fit.identifiability import Direction, Identifiability
from exu_press.studies.fit.measured import RecordedCurve
from exu_press.studies.fit.minimum import Minimum
from exu_press.studies.fit.profile import OPEN, interpolate_rise
from exu_press.studies.fit.study import Fit

__all__ = ["FitReport"]

UNLIKELY = 0.01
"""Probability of chi-square below which the scene does not explain the measurement."""

MOST_SHOWN = 0.995
"""Probability above which a share of measurements is not rounded, as it would be all of them."""

UNREACHED = (
    "no values of the keys within their ranges give the measured numbers: look at the largest "
    "residuals"
)
"""Line of a report where the minimum is larger than chi-square of the true values, of all numbers,
is with the probability UNLIKELY."""

UNEXPLAINED = (
    "the scene does not explain the measurement: intervals hold only if the uncertainties are "
    "right and the scene is; look at the largest residuals"
)

EXACT = 0.3
"""Error of a run over the uncertainty of a number, above which a line warns."""

NEARLY = 0.05
"""Relative difference of the two halves of an interval that counts as symmetric."""


@dataclass(frozen=True)
class FitReport(Report):
    """The result of a fit; keys in the study's order.

    Attributes:
        values: key -> best value.
        low, high: key -> ends of its interval.
        remarks: key -> remarks on the low and on the high end; mostly empty.
        minima: best first.
        diverged: number of starts that led to failing runs.
        effect: change of all residuals over a key's whole range, (keys,).
        profiles: key -> its values and chi-square above the least, (points, 2).
        count: independent numbers less the sensors' parameters.
        numbers: computed values of [[measured]].
        curves: (measured, computed) of [[curve]].
        errors: of runs over the uncertainties, of numbers and of samples of curves, (numbers,).
    """

    name = "fit"
    files = ("fit.json", "fitted.toml")
    heading, scene_file = "Fit", "fitted.toml"
    drawn = (("fit", "Measured and computed."), ("profiles", "Chi-square over each key."))

    study: Fit
    values: dict[str, float]
    low: dict[str, float]
    high: dict[str, float]
    remarks: dict[str, tuple[str, str]]
    minima: list[Minimum]
    diverged: int
    identifiability: Identifiability
    effect: Array
    profiles: dict[str, Array]
    count: float
    numbers: list[float]
    curves: list[tuple[Array, RecordedCurve]]
    errors: Array
    run_summary: list[str]

    @property
    def largest_error(self) -> float:
        """Largest error of a run in a number or a sample of a curve, over its uncertainty."""
        return float(self.errors.max(initial=0.0))

    @property
    def residuals(self) -> Array:
        """Computed less measured numbers, over their uncertainties."""
        pairs = zip(self.study.measured, self.numbers, strict=True)
        return np.array([(number - entry.value) / entry.uncertainty for entry, number in pairs])

    @property
    def chi_square(self) -> float:
        """Sum of squared residuals over their uncertainties."""
        return self.minima[0].chi_square

    @property
    def freedom(self) -> float:
        """Numbers less the combinations of keys that they determine."""
        return self.count - self.identifiability.rank

    @property
    def probability(self) -> float | None:
        """Probability that chance makes chi-square as large; None without a degree of
        freedom."""
        return float(chi2.sf(self.chi_square, self.freedom)) if self.freedom > 0.0 else None

    @property
    def subtitle(self) -> str:
        """Misfit."""
        return f"chi-square {self.chi_square:.4g} with {self.freedom:g} degrees of freedom"

    @property
    def scene(self) -> Scene:
        """The fitted scene."""
        return self.study.scene_at(self.values)

    def tables(self) -> list[Table]:
        """Return best values with intervals, undetermined keys, the misfit and residuals."""
        level = f"{100 * self.study.fit.level:g} %"
        open_keys = [self._not_determined(direction) for direction in self.identifiability.open]
        numbers = self._residual_rows()
        head = ("measured", "value", "uncertainty", "computed", "error of a run", "residual")
        return [
            Table("Runs", above=[*self.run_summary, *self._searches()]),
            Table(
                "Keys",
                ("key", "best", f"{level} interval", ""),
                self._key_rows(),
                below=[*open_keys, *self._correlation()],
            ),
            Table("Misfit", above=self._misfit()),
            Table(
                "Numbers and curves",
                head if numbers else (),
                numbers,
                below=self._curve_lines(),
            ),
        ]

    def panels(self) -> list[Panel]:
        """Return the curves, the numbers in uncertainties, and chi-square over each key."""
        panels = [
            Panel(
                f"Curve {curve.name}",
                curve.read.axis_label,
                f"{curve.read.name}, {model.unit}",
                [
                    Line("measured", curve.read.at.tolist(), measured.tolist(), points=True),
                    Line(
                        "computed, through the sensor",
                        curve.read.at.tolist(),
                        model.values.tolist(),
                    ),
                ],
            )
            for curve, (measured, model) in zip(self.study.curve, self.curves, strict=True)
        ]
        if self.study.measured:
            errors = self.errors[: len(self.residuals)]
            low, high = (self.residuals - errors).tolist(), (self.residuals + errors).tolist()
            title = "(computed - measured) / uncertainty"
            line = Line(title, list(range(len(low))), self.residuals.tolist(), True, low, high)
            panels.append(Panel("Numbers", "place in the table", "in uncertainties", [line]))
        for name, points in self.profiles.items():
            at, risen = points.T
            values, rises = interpolate_rise(
                points, self.values[name], float(points[:, 1].max()) or 1.0
            )
            line = Line("chi-square above its least", values.tolist(), rises.tolist())
            fits = Line("other keys fitted again", at.tolist(), risen.tolist(), points=True)
            title = f"How well {name} is determined"
            panels.append(Panel(title, with_unit(name), "chi-square", [line, fits]))
        return panels

    def to_dict(self) -> dict[str, Any]:
        """Return the contents of fit.json."""
        keys = {
            name: {
                "value": value,
                "low": self.low[name],
                "high": self.high[name],
                "low_remark": self.remarks[name][0],
                "high_remark": self.remarks[name][1],
            }
            for name, value in self.values.items()
        }
        return {
            "keys": keys,
            "level": self.study.fit.level,
            "chi_square": self.chi_square,
            "degrees_of_freedom": self.freedom,
            "probability": self.probability,
            "correlation": self.identifiability.correlation,
            "not_determined": [d.vector for d in self.identifiability.open],
            "singular_values": self.identifiability.singular,
            "minima": [[m.chi_square, m.times] for m in self.minima],
            "measured": [
                {"name": entry.name, "value": entry.value, "uncertainty": entry.uncertainty,
                 "computed": number, "error_over_uncertainty": error}
                for entry, number, error in zip(
                    self.study.measured, self.numbers, self.errors, strict=False
                )
            ],
            "sensors": {
                curve.name: model.plain()
                for curve, (_, model) in zip(self.study.curve, self.curves, strict=True)
            },
            "curves": {
                curve.name: {
                    "channel": curve.read.name,
                    "unit": model.unit,
                    "across": curve.read.axis_label,
                    "at": curve.read.at,
                    "measured": measured,
                    "computed": model.values,
                }
                for curve, (measured, model) in zip(self.study.curve, self.curves, strict=True)
            },
            "profiles": self.profiles,
            "largest_error_over_uncertainty": self.largest_error,
            "runs": self.run_summary,
        }  # fmt: skip

    def _searches(self) -> list[str]:
        minima = ", ".join(
            f"{significant(m.chi_square, 3)} ({m.times} start{'s' * (m.times > 1)})"
            for m in self.minima
        )
        diverged = f"; {self.diverged} starts led to runs that fail" if self.diverged else ""
        return [f"chi-square of the minima found: {minima}{diverged}"]

    def _key_rows(self) -> list[tuple[str, ...]]:
        rows: list[tuple[str, ...]] = []
        for name, best in self.values.items():
            low, high = self.low[name], self.high[name]
            digits = _digits(best, low, high)
            ends = [
                significant(end, digits) + (f" ({remark})" if remark else "")
                for end, remark in zip((low, high), self.remarks[name], strict=True)
            ]
            symmetric = abs((high - best) - (best - low)) < NEARLY * (high - low)
            word = "" if symmetric or any(self.remarks[name]) else "not symmetric"
            if self.remarks[name] == (OPEN, OPEN):
                word = "not determined"
            rows.append(
                (with_unit(name), significant(best, digits), f"{ends[0]} to {ends[1]}", word)
            )
        return rows

    def _not_determined(self, direction: Direction) -> str:
        """Return a key or a combination of keys that the measurement does not determine."""
        names = list(self.study.keys)
        keys = [names[k] for k in direction.keys]
        if len(keys) == 1:
            effect = significant(float(self.effect[direction.keys[0]]), 2)
            return (
                f"not determined: {keys[0]}; over its whole range the measured numbers change by "
                f"{effect} of their uncertainties"
            )
        parts = []
        for k, name in zip(direction.keys, keys, strict=True):
            varied, value = self.study.keys[name], self.values[name]
            assert isinstance(varied, Range)
            low, high = varied.low, varied.high
            width = math.log(high / low) if varied.log else (high - low) / value
            parts.append((name, float(direction.vector[k]) * width))
        scale = 10.0 / parts[0][1]
        text = " and ".join(f"{name} {change * scale:+.1f} %" for name, change in parts)
        return f"not determined: {text} together leave every measured number where it is"

    def _correlation(self) -> list[str]:
        names, table = list(self.study.keys), self.identifiability.correlation
        pairs = [
            (abs(table[i, j]), f"{names[i]} and {names[j]} {table[i, j]:+.2f}")
            for i in range(len(names))
            for j in range(i)
            if np.isfinite(table[i, j])
        ]
        texts = [text for _, text in sorted(pairs, reverse=True)[:6]]
        return [f"correlation: {', '.join(texts)}"] if texts else []

    def _misfit(self) -> list[str]:
        chance = self.probability
        text = f"chi-square {significant(self.chi_square, 3)}, degrees of freedom {self.freedom:g}"
        if chance is None:
            text += ": nothing is left to judge the scene by"
            reached = chi2.sf(self.chi_square, self.count) >= UNLIKELY
            return [text] if reached else [text, UNREACHED]
        share = "over 99" if chance > MOST_SHOWN else significant(100 * chance, 2)
        text += f": chance alone makes it as large in {share} % of measurements"
        return [text, UNEXPLAINED] if chance < UNLIKELY else [text]

    def _residual_rows(self) -> list[tuple[str, ...]]:
        rows: list[tuple[str, ...]] = []
        numbers = zip(self.numbers, self.residuals, self.errors, strict=False)
        for entry, (computed, residual, error) in zip(self.study.measured, numbers, strict=False):
            unit, scale = shown_unit(entry.quantity, [entry.value])
            rows.append(
                (
                    with_unit(entry.name, unit),
                    f"{scale * entry.value:.6g}",
                    significant(scale * entry.uncertainty, 2),
                    f"{scale * computed:.6g}",
                    f"{scale * error * entry.uncertainty / entry.weight**0.5:.1g}",
                    f"{residual:+.2f}",
                )
            )
        return rows

    def _curve_lines(self) -> list[str]:
        lines = []
        for curve, (measured, model) in zip(self.study.curve, self.curves, strict=True):
            size = float(np.sqrt(np.mean((model.values - measured) ** 2))) / curve.uncertainty
            sensor = ", ".join(f"{name} {value:.4g}" for name, value in model.plain().items())
            lines.append(
                f"curve {curve.name}: {len(measured)} samples, rms residual {size:.2f} "
                f"uncertainties; sensor: {sensor}"
            )
        if self.largest_error > EXACT:
            lines.append(
                f"a run's own error is up to {significant(self.largest_error, 2)} of an "
                "uncertainty; the cure is a lower solver.tolerance"
            )
        return lines


def _digits(best: float, low: float, high: float) -> int:
    """Return the number of digits that shows two digits of the interval's half-width."""
    half = (high - low) / 2.0
    if half <= 0.0 or best == 0.0:
        return 3
    return min(max(2, 2 + math.ceil(math.log10(abs(best) / half) - 1e-9)), 7)
