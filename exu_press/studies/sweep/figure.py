"""A sweep in one picture: quantities of its runs over one or two of the keys that vary."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.plots.palette import GREY, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import PATH_COLOURS, points, with_style
from exu_press.plots.sweep_words import in_unit, label_with_unit, setting, words
from exu_press.plots.typesetting import plain, wrap_text
from exu_press.plots.words import describe
from exu_press.studies.sweep.report import SweepReport

__all__ = ["axes_of", "sweep_figure", "sweep_picture"]

MOST_CURVES = 6

LOGARITHMIC_FROM = 50.0
"""Ratio of an axis' ends."""


def axes_of(report: SweepReport, chosen: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the one or two keys to draw over: those wanted, or the first numbers that vary."""
    study = report.study
    possible = [
        name for name in study.keys if report.is_numeric(name) and len(set(report[name])) > 1
    ]
    for name in chosen:
        if name not in possible:
            raise InputError(
                f"--over {name}: allowed are the numbers that vary, "
                f"{', '.join(possible) or 'none here'}"
            )
    if len(chosen) > 2:
        raise InputError(f"--over {' --over '.join(chosen)}: allowed are one or two keys")
    return tuple(chosen or possible[:2])


@with_style
def sweep_figure(report: SweepReport, axes: Sequence[str], quantities: Sequence[str]) -> Figure:
    """Return one panel a quantity.

    A curve for every combination of the other keys, where a grid has few of them; else a map over
    two keys, or points. Runs without a number are crosses.

    Args:
        axes: one or two numeric columns.
        quantities: numeric columns.
    """
    columns = min(2, len(quantities))
    heading = f"{len(report)} runs over {' and '.join(map(words, axes))}"
    text = f"{describe(report.study.scenes, 80 * columns)}\n{report.ends}"
    rows = grid_rows(len(quantities), columns)
    figure, panels = figure_with_panels(heading, text, rows, 6.4, 3.6)
    curves = _curves(report, axes)
    for panel, quantity in zip(panels, quantities, strict=True):
        if curves is None:
            _draw_map(figure, panel, report, axes, quantity)
        else:
            _draw_curves(panel, report, axes[0], quantity, curves)
    if curves is not None and len(curves) > 1:
        panels[0].legend(loc="best")
    return figure


def sweep_picture(report: SweepReport) -> Figure | None:
    """Return the picture of a sweep; None where no number varies or none came out."""
    axes, quantities = axes_of(report, report.axes), report.quantities()
    return sweep_figure(report, axes, quantities) if axes and quantities else None


def _curves(report: SweepReport, axes: Sequence[str]) -> dict[str, list[int]] | None:
    """Return the runs of every curve by label, or None for a map.

    A grid has a curve for every combination of its other keys, if they are few; else a map shows
    two keys, and of more than two every run is a point.
    """
    everything = list(range(len(report)))
    if report.study.way != "grid":
        return {"": everything} if len(axes) == 1 else None
    more_keys = [
        name for name in report.study.keys if name != axes[0] and len(set(report[name])) > 1
    ]
    runs_of_curve: dict[str, list[int]] = {}
    for run in everything:
        label = plain(", ".join(setting(name, report[name][run]) for name in more_keys))
        runs_of_curve.setdefault(label, []).append(run)
    if len(runs_of_curve) <= MOST_CURVES:
        return runs_of_curve
    return None if len(axes) == 2 and len(more_keys) == 1 else {"": everything}


def _draw_curves(
    panel: Axes, report: SweepReport, axis: str, quantity: str, curves: Mapping[str, Sequence[int]]
) -> None:
    """Draw a quantity over one key: a line with its points for every group of runs.

    Scattered runs have no line; runs without a number are crosses along the edge.
    """
    x, across = in_unit(axis, report.numbers(axis))
    y, up = in_unit(quantity, report.numbers(quantity))
    for index, (label, runs) in enumerate(curves.items()):
        ordered = sorted(runs, key=lambda run: float(x[run]))
        colour: Any = colour_of(0) if len(curves) == 1 else PATH_COLOURS(index / (len(curves) - 1))
        one_each = report.study.way != "sample" and len(set(x[ordered])) == len(ordered)
        style = "o-" if one_each else "o"
        panel.plot(x[ordered], y[ordered], style, color=colour, markersize=4.5, label=label)
        _draw_errors(panel, report, quantity, ordered, x, y, colour)
    missing = np.isnan(y)
    if missing.any():
        edge = panel.get_xaxis_transform()
        panel.plot(x[missing], np.full(missing.sum(), 0.02), "x", transform=edge, color=GREY)
        _count(panel, missing)
    if x.min() > 0.0 and x.max() > LOGARITHMIC_FROM * x.min():
        panel.set_xscale("log")
    panel.margins(0.04, 0.08)
    panel.set(xlabel=wrap_text(label_with_unit(axis, across)), title=_title(quantity, up))


def _draw_errors(
    panel: Axes,
    report: SweepReport,
    quantity: str,
    runs: Sequence[int],
    x: Array,
    y: Array,
    colour: Any,
) -> None:
    """Draw the error bars of those runs that know their errors."""
    stated = {run: error for run in runs if (error := report.error(quantity, run)) is not None}
    if not stated:
        return
    known = list(stated)
    ends = np.array([[stated[run]["low"], stated[run]["high"]] for run in known], dtype=float)
    largest = np.nanmax(np.abs(report.numbers(quantity)))
    scale = np.nanmax(np.abs(y)) / largest if largest else 1.0
    lengths = np.abs(scale * ends - y[known][:, None]).T
    panel.errorbar(x[known], y[known], lengths, fmt="none", ecolor=colour, capsize=2.5)


def _draw_map(
    figure: Figure, panel: Axes, report: SweepReport, axes: Sequence[str], quantity: str
) -> None:
    """Draw a quantity over two keys as colour: cells of a grid, points of scattered runs."""
    (x, across), (y, up) = (in_unit(name, report.numbers(name)) for name in axes)
    values, unit = in_unit(quantity, report.numbers(quantity))
    missing = np.isnan(values)
    if report.study.way == "grid" and len(report) == len(set(x)) * len(set(y)):
        columns, rows = np.unique(x), np.unique(y)
        cells = np.full((len(rows), len(columns)), np.nan)
        cells[np.searchsorted(rows, y), np.searchsorted(columns, x)] = values
        drawn: Any = panel.pcolormesh(columns, rows, cells, cmap=PATH_COLOURS, shading="nearest")
        panel.grid(False)
    else:
        drawn = panel.scatter(x[~missing], y[~missing], c=values[~missing], cmap=PATH_COLOURS, s=34)
        panel.margins(0.04)
    if missing.any():
        panel.plot(x[missing], y[missing], "x", color=GREY)
        _count(panel, missing)
    panel.set(xlabel=label_with_unit(axes[0], across), ylabel=label_with_unit(axes[1], up))
    panel.set_title(_title(quantity, unit))
    figure.colorbar(drawn, ax=panel, pad=0.02).outline.set_visible(False)


def _title(name: str, unit: str) -> str:
    text = label_with_unit(name, unit)
    return wrap_text(text[0].upper() + text[1:])


def _count(panel: Axes, missing: "NDArray[np.bool_]") -> None:
    panel.set_title(f"x: {missing.sum()} without", loc="right", fontsize=points(8.5), color=GREY)
