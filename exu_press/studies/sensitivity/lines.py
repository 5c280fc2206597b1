"""A sensitivity study as a person reads it in a terminal."""

import math

import numpy as np

from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant, uncertain
from exu_press.studies.sensitivity.run import Report
from exu_press.terminal.columns import columns

__all__ = ["report_lines"]

NO_EFFECT = 0.01
"""Part of the variance: a key whose total index surely lies below has no effect."""

NOISE = 0.1
"""Error of the runs over the deviation: a larger one is part of the result."""


def report_lines(report: Report) -> list[str]:
    """Return the effect of the tolerances, and the share of each."""
    lines = list(report.told)
    for place in range(len(report.study.sensitivity.quantities)):
        lines += ["", *_of_quantity(report, place)]
    return lines


def _of_quantity(report: Report, place: int) -> list[str]:
    study = report.study
    name = study.sensitivity.quantities[place]
    found, each = report.indices[place], report.spreads[place]
    quantity = quantity_of(study.scene, name).quantity.in_scaled_unit([each.middle])
    scale = quantity.scale
    unit = f" {quantity.display_unit}" if quantity.display_unit else ""
    if found is None:
        middle = significant(each.middle * scale, quantity.digits)
        return [f"{name}: does not move, {middle}{unit} in every run"]
    share = f"{100 * study.sensitivity.share:g} %"

    def shown(value: float) -> str:
        return to_resolution(value * scale, each.deviation * scale)

    half = uncertain(each.half, {"error": each.half_error, "determined": True}, scale)
    lines = [
        f"{name}: {shown(each.middle)}{unit}, and in {share} of the presses built no more than "
        f"{half.replace(' +- ', ' (+- ')}){unit} off",
        f"  5 % lie below {shown(each.low)}, 95 % below {shown(each.high)}{unit}; "
        f"standard deviation {significant(each.deviation * scale, 3)}{unit}",
    ]
    error = report.errors[place]
    if error is not None:
        part = error / each.deviation
        told = f"  a run's own error is {significant(error * scale, 2)}{unit}"
        lines.append(
            f"{told}: {significant(100 * part, 2)} % of the deviation"
            + (", and is part of it; the cure is a lower solver.tolerance" * (part > NOISE))
        )
    rows = [("key", "alone", "with others", f"5 to 95 % of the key alone,{unit}")]
    for n in np.argsort(-found.total):
        ends = [
            shown(x) if np.isfinite(x) else "failed" for x in map(float, report.bars[n, :, place])
        ]
        rows.append(
            (
                list(study.keys)[n],
                _index(found.first[n], found.first_bounds[n]),
                _index(found.total[n], found.total_bounds[n])
                + (", no effect" if found.total_bounds[n, 1] < NO_EFFECT else ""),
                f"{ends[0]} to {ends[1]}",
            )
        )
    return lines + columns(rows, 2)


def to_resolution(value: float, resolution: float) -> str:
    """Return a number with the digits that show a hundredth of a resolution.

    >>> to_resolution(469.94163, 0.005), to_resolution(169.37, 58.0)
    ('469.94163', '169.4')
    """
    places = max(2 - math.floor(math.log10(resolution)), 0) if resolution > 0.0 else 6
    return f"{value:.{places}f}"


def _index(value: float, bounds: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> str:
    told, low, high = (f"{round(float(x), 2) + 0.0:.2f}" for x in (value, *bounds))
    return f"{told} ({low} to {high})"
