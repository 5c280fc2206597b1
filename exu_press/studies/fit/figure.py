"""A fit in two pictures: measured against computed, and how chi-square rises with each key."""

import numpy as np
from matplotlib.figure import Figure
from scipy.stats import chi2

from exu_press.plots.format import picture_format
from exu_press.plots.palette import GREY, SHADE, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows, name_rows
from exu_press.plots.scales import log_axis
from exu_press.plots.style import with_style
from exu_press.plots.sweep_words import in_unit
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe
from exu_press.quantities.uncertain import significant
from exu_press.studies.base import Range
from exu_press.studies.fit.profile import interpolate_rise
from exu_press.studies.fit.report import FitReport
from exu_press.studies.measured_figure import curve_panel

__all__ = ["fit_figure", "profiles_figure"]

MOST_ACROSS = 3

ROW, ROW_ON_PAPER = 0.32, 0.6
"""inch of a number in its panel, whose name may take two lines on narrow paper."""

LOWEST = 1.7
"""inch of a panel, whose numbers have room beside title and labels on narrow paper, too."""


@with_style
def fit_figure(report: FitReport) -> Figure:
    """Return the residuals of numbers in uncertainties, and each curve beside the computed one."""
    study = report.study
    number, curves = len(study.measured), len(study.curve)
    row = ROW_ON_PAPER if picture_format().stacks else ROW
    heights = [max(LOWEST, 0.8 + row * number)] * (number > 0) + [2.8] * curves
    text = f"{describe([report.scene], 110)}\nchi-square {significant(report.chi_square, 3)} with "
    text += f"{report.freedom:g} degree{'s' * (report.freedom != 1)} of freedom"
    figure, axes = figure_with_panels(
        "Measured and computed", text, grid_rows(len(heights), 1), 9.5, heights
    )
    if number:
        first = axes.pop(0)
        rows = np.arange(number)[::-1]
        first.axvspan(-2.0, 2.0, color=SHADE, zorder=0)
        first.axvline(0.0, color="black", linewidth=0.8)
        first.errorbar(
            report.residuals, rows, xerr=report.errors[:number], fmt="o", color=colour_of(0),
            markersize=5, elinewidth=1.2,
        )  # fmt: skip
        name_rows(first, rows.tolist(), [entry.name for entry in study.measured])
        first.set_ylim(-0.6, number - 0.4)
        most = max(3.0, 1.15 * float(np.abs(report.residuals).max()))
        first.set_xlim(-most, most)
        first.set_title("Numbers")
        first.set_xlabel("(computed - measured) / uncertainty;\nbars: error of the run")
    for panel, entry, (measured, model) in zip(axes, study.curve, report.curves, strict=True):
        computed = {"computed, through the sensor": model.line(entry.read.at)}
        curve_panel(panel, entry.name, entry.read, measured, computed, model.unit)
    return figure


@with_style
def profiles_figure(report: FitReport) -> Figure:
    """Return the rise of chi-square over each key, with the free keys fitted at each value."""
    names = list(report.values)
    across = min(MOST_ACROSS, len(names))
    level = report.study.fit.level
    rise = float(chi2.ppf(level, 1))
    figure, panels = figure_with_panels(
        "How well the measurement determines each key",
        f"Between the dashed lines, the key agrees with the measurement ({100 * level:g} %).",
        grid_rows(len(names), across),
        4.2,
        2.9,
    )
    for name, panel in zip(names, panels, strict=True):
        points = report.profiles[name]
        values, unit = in_unit(name, points[:, 0])
        scale = values[-1] / points[-1, 0] if points[-1, 0] else 1.0
        best = report.values[name] * scale
        dense, rises = interpolate_rise(points, report.values[name], 2.2 * rise)
        dense = dense * scale
        panel.plot(dense, rises, color=colour_of(0))
        panel.plot(values, points[:, 1], "o", color=colour_of(0), markersize=4)
        panel.axhline(rise, color=GREY, linewidth=1.0)
        for end in (report.low[name], report.high[name]):
            panel.axvline(end * scale, color=GREY, linewidth=1.0, linestyle="--")
        panel.axvline(best, color="black", linewidth=0.8)
        varied = report.study.keys[name]
        if isinstance(varied, Range) and varied.log and dense[-1] > 4.0 * dense[0]:
            log_axis(panel, "x", dense)
        else:
            margin = 0.05 * (dense[-1] - dense[0])
            panel.set_xlim(dense[0] - margin, dense[-1] + margin)
        panel.set_ylim(0.0, 2.2 * rise)
        panel.set_xlabel(plain(f"{name}{f', {unit}' if unit else ''}"))
        panel.set_ylabel("chi-square above its least")
    return figure
