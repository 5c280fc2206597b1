"""A fit as a person reads it in a terminal."""

import math

import numpy as np
from scipy.stats import chi2

from exu_press.quantities.uncertain import significant
from exu_press.studies.base import Range
from exu_press.studies.fit.determined import Direction
from exu_press.studies.fit.profile import OPEN
from exu_press.studies.fit.run import Report
from exu_press.studies.sweep.units import shown_unit, with_unit
from exu_press.terminal.columns import columns

__all__ = ["inexact", "report_lines"]

UNLIKELY = 0.01
"""Probability of chi-square below which the scene does not explain the measurement."""

UNREACHED = (
    "no values of the keys within their ranges give the measured numbers: look at the largest "
    "residuals"
)
"""Told where even the true values would leave so large a chi-square less often than UNLIKELY: at
them it is that of all numbers, and the minimum is not larger."""

EXACT = 0.3
"""Largest error of evaluations over the uncertainty of a number."""

NEARLY = 0.05
"""Relative, between the two halves of an interval that is called symmetric."""


def report_lines(report: Report) -> list[str]:
    """Return best values with intervals, undetermined keys, the misfit and residuals."""
    lines = [*report.told, *_searches(report), "", *_keys(report)]
    lines += [_not_determined(report, one) for one in report.determined.open]
    return [*lines, *_correlation(report), "", *_misfit(report), "", *_residuals(report)]


def _searches(report: Report) -> list[str]:
    found = ", ".join(
        f"{significant(one.chi_square, 3)} ({one.times} start{'s' * (one.times > 1)})"
        for one in report.minima
    )
    lost = f"; {report.lost} starts led to runs that fail" if report.lost else ""
    return [f"chi-square of the minima found: {found}{lost}"]


def _keys(report: Report) -> list[str]:
    level = f"{100 * report.study.fit.level:g} %"
    rows = [("key", "best", f"{level} interval", "")]
    for name, best in report.values.items():
        low, high = report.low[name], report.high[name]
        digits = _digits(best, low, high)
        ends = [
            significant(end, digits) + (f" ({remark})" if remark else "")
            for end, remark in zip((low, high), report.remarks[name], strict=True)
        ]
        symmetric = abs((high - best) - (best - low)) < NEARLY * (high - low)
        word = "" if symmetric or any(report.remarks[name]) else "not symmetric"
        if report.remarks[name] == (OPEN, OPEN):
            word = "not determined"
        rows.append((with_unit(name), significant(best, digits), f"{ends[0]} to {ends[1]}", word))
    return columns(rows)


def _digits(best: float, low: float, high: float) -> int:
    """Return the digits that show two of the interval's half."""
    half = (high - low) / 2.0
    if half <= 0.0 or best == 0.0:
        return 3
    return min(max(2, 2 + math.ceil(math.log10(abs(best) / half) - 1e-9)), 7)


def _not_determined(report: Report, one: Direction) -> str:
    """Return a key or a combination of keys that the measurement does not determine."""
    names = list(report.study.keys)
    keys = [names[k] for k in one.keys]
    if len(keys) == 1:
        effect = significant(float(report.effect[one.keys[0]]), 2)
        return (
            f"not determined: {keys[0]}; over its whole range the measured numbers change by "
            f"{effect} of their uncertainties"
        )
    parts = []
    for k, name in zip(one.keys, keys, strict=True):
        each = report.study.keys[name]
        assert isinstance(each, Range)
        value = report.values[name]
        width = math.log(each.high / each.low) if each.log else (each.high - each.low) / value
        parts.append((name, float(one.vector[k]) * width))
    scale = 10.0 / parts[0][1]
    told = " and ".join(f"{name} {change * scale:+.1f} %" for name, change in parts)
    return f"not determined: {told} together leave every measured number where it is"


def _correlation(report: Report) -> list[str]:
    names, table = list(report.study.keys), report.determined.correlation
    pairs = [
        (abs(table[i, j]), f"{names[i]} and {names[j]} {table[i, j]:+.2f}")
        for i in range(len(names))
        for j in range(i)
        if np.isfinite(table[i, j])
    ]
    return [f"correlation: {', '.join(text for _, text in sorted(pairs, reverse=True)[:6])}"] * (
        len(pairs) > 0
    )


def _misfit(report: Report) -> list[str]:
    chance = report.probability
    text = f"chi-square {significant(report.chi_square, 3)}, degrees of freedom {report.freedom:g}"
    if chance is None:
        text += ": nothing is left to judge the scene by"
        reached = chi2.sf(report.chi_square, report.count) >= UNLIKELY
        return [text] if reached else [text, UNREACHED]
    text += f": chance alone makes it as large in {significant(100 * chance, 2)} % of measurements"
    if chance < UNLIKELY:
        return [
            text,
            "the scene does not explain the measurement: intervals hold only if the uncertainties "
            "are right and the scene is; look at the largest residuals",
        ]
    return [text]


def _residuals(report: Report) -> list[str]:
    rows = [("measured", "value", "uncertainty", "computed", "error of a run", "residual")]
    number = len(report.study.measured)
    for one, computed, error in zip(
        report.study.measured, report.numbers, report.errors[:number], strict=True
    ):
        unit, scale = shown_unit(one.quantity, [one.value])
        rows.append(
            (
                with_unit(one.name, unit),
                f"{scale * one.value:.6g}",
                significant(scale * one.uncertainty, 2),
                f"{scale * computed:.6g}",
                f"{scale * error * one.uncertainty / one.weight**0.5:.1g}",
                f"{(computed - one.value) / one.uncertainty:+.2f}",
            )
        )
    lines = columns(rows) if number else []
    for curve, (wanted, told) in zip(report.study.curve, report.curves, strict=True):
        size = float(np.sqrt(np.mean((told.values - wanted) ** 2))) / curve.uncertainty
        sensor = ", ".join(f"{name} {value:.4g}" for name, value in told.plain().items())
        lines.append(
            f"curve {curve.name}: {len(wanted)} samples, rms residual {size:.2f} uncertainties; "
            f"sensor: {sensor}"
        )
    return [*lines, *inexact(report.largest_error)]


def inexact(largest_error: float) -> list[str]:
    """Return a line where errors of runs, the largest over its uncertainty, touch the fit."""
    if largest_error <= EXACT:
        return []
    return [
        f"a run's own error is up to {significant(largest_error, 2)} of an uncertainty; the cure "
        "is a lower solver.tolerance"
    ]
