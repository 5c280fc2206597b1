"""One panel of a sweep's picture: curves, points or a map."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array
from exu_press.plots.style import GREY, PATH_COLOURS, colour_of
from exu_press.plots.sweep_words import in_unit, words
from exu_press.studies.sweep import Table

__all__ = ["draw_curves", "draw_map"]

LOGARITHMIC_FROM = 50.0
"""Ratio of an axis' ends."""


def draw_curves(
    panel: Axes, table: Table, axis: str, quantity: str, curves: Mapping[str, Sequence[int]]
) -> None:
    """Draw a quantity over one key: a line with its points for every group of runs.

    Scattered runs have no line; runs without a number are crosses along the edge.
    """
    x, across = in_unit(axis, table.numbers(axis))
    y, up = in_unit(quantity, table.numbers(quantity))
    for index, (label, runs) in enumerate(curves.items()):
        ordered = sorted(runs, key=lambda run: float(x[run]))
        colour: Any = colour_of(0) if len(curves) == 1 else PATH_COLOURS(index / (len(curves) - 1))
        one_each = table.study.way != "sample" and len(set(x[ordered])) == len(ordered)
        style = "o-" if one_each else "o"
        panel.plot(x[ordered], y[ordered], style, color=colour, markersize=4.5, label=label)
        _draw_errors(panel, table, quantity, ordered, x, y, colour)
    missing = np.isnan(y)
    if missing.any():
        edge = panel.get_xaxis_transform()
        panel.plot(x[missing], np.full(missing.sum(), 0.02), "x", transform=edge, color=GREY)
        _count(panel, missing)
    if x.min() > 0.0 and x.max() > LOGARITHMIC_FROM * x.min():
        panel.set_xscale("log")
    panel.margins(0.04, 0.08)
    panel.set(xlabel=_labelled(axis, across), title=_headed(quantity, up))


def _draw_errors(
    panel: Axes, table: Table, quantity: str, runs: Sequence[int], x: Array, y: Array, colour: Any
) -> None:
    """Draw the error bars of those runs that know their errors."""
    told = {run: error for run in runs if (error := table.error(quantity, run)) is not None}
    if not told:
        return
    known = list(told)
    ends = np.array([[told[run]["low"], told[run]["high"]] for run in known], dtype=float)
    largest = np.nanmax(np.abs(table.numbers(quantity)))
    scale = np.nanmax(np.abs(y)) / largest if largest else 1.0
    lengths = np.abs(scale * ends - y[known][:, None]).T
    panel.errorbar(x[known], y[known], lengths, fmt="none", ecolor=colour, capsize=2.5)


def draw_map(figure: Figure, panel: Axes, table: Table, axes: Sequence[str], quantity: str) -> None:
    """Draw a quantity over two keys as colour: cells of a grid, points of scattered runs."""
    (x, across), (y, up) = (in_unit(name, table.numbers(name)) for name in axes)
    values, unit = in_unit(quantity, table.numbers(quantity))
    missing = np.isnan(values)
    if table.study.way == "grid" and len(table) == len(set(x)) * len(set(y)):
        columns, rows = np.unique(x), np.unique(y)
        cells = np.full((len(rows), len(columns)), np.nan)
        cells[np.searchsorted(rows, y), np.searchsorted(columns, x)] = values
        shown: Any = panel.pcolormesh(columns, rows, cells, cmap=PATH_COLOURS, shading="nearest")
        panel.grid(False)
    else:
        shown = panel.scatter(x[~missing], y[~missing], c=values[~missing], cmap=PATH_COLOURS, s=34)
        panel.margins(0.04)
    if missing.any():
        panel.plot(x[missing], y[missing], "x", color=GREY)
        _count(panel, missing)
    panel.set(xlabel=_labelled(axes[0], across), ylabel=_labelled(axes[1], up))
    panel.set_title(_headed(quantity, unit))
    figure.colorbar(shown, ax=panel, pad=0.02).outline.set_visible(False)


def _labelled(name: str, unit: str) -> str:
    return f"{words(name)}, {unit}" if unit else words(name)


def _headed(name: str, unit: str) -> str:
    text = _labelled(name, unit)
    return text[0].upper() + text[1:]


def _count(panel: Axes, missing: "NDArray[np.bool_]") -> None:
    panel.set_title(f"x: {missing.sum()} without", loc="right", fontsize=8.5, color=GREY)
