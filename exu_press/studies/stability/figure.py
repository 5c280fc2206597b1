"""A map of the stability study: every axis a line, from end to end; pairs as a matrix."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from exu_press.plots.format import picture_format
from exu_press.plots.legends import legend_outside
from exu_press.plots.palette import COLOURS, GREY
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import PATH_COLOURS, points, with_style
from exu_press.studies.stability.cases import PAIRS
from exu_press.studies.stability.checks import RESIDUAL_LIMIT
from exu_press.studies.stability.report import Row, StabilityReport

__all__ = ["stability_figure"]

RESIDUALS = (1e-7, RESIDUAL_LIMIT)
"""Energy residuals at the ends of the colours."""

SQUARE = 7.0
"""Height of the matrix of pairs with its names, inch."""

MARKERS: Mapping[str, Mapping[str, Any]] = {
    "right": {"marker": "o", "s": 42, "linewidths": 0.0},
    "stopped": {"marker": "s", "s": 48, "color": "white", "edgecolors": "black", "linewidths": 1.4},
    "wrong": {"marker": "X", "s": 95, "color": COLOURS["vermilion"], "linewidths": 0.0},
}
"""A verdict has a shape of its own, so that it can be told without colours."""

IN_WORDS = {
    "right": "right, coloured by its energy residual",
    "stopped": "stopped, with a reason",
    "wrong": "wrong",
}


@with_style
def stability_figure(report: StabilityReport) -> Figure:
    """Return the map of a report."""
    single = [row for row in report.rows if row.axis != PAIRS]
    pairs = [row for row in report.rows if row.axis == PAIRS]
    lines = list(dict.fromkeys(map(_line, single)))
    sample = "a fixed sample of " if report.quick else ""
    text = f"{sample}{len(report.rows)} cases: {report.subtitle}"
    height = 1.0 + 0.23 * max(len(lines), 20)
    heights = [height, SQUARE] if pairs else [height]
    rows = grid_rows(len(heights), 1)
    figure, panels = figure_with_panels("Stiff and extreme cases", text, rows, 9.5, heights)
    upper, *lower = panels
    colours = ScalarMappable(LogNorm(*RESIDUALS, clip=True), PATH_COLOURS)
    if single:
        _draw_axes(upper, single, lines, colours)
    if pairs:
        _draw_pairs(lower[0], pairs, colours)
    bar = figure.colorbar(colours, ax=panels, location="bottom", shrink=0.5, aspect=40)
    bar.set_label("energy residual, relative to the\nlargest energy put in,\nstored or dissipated")
    handles: list[Artist] = [
        Line2D(
            [], [], linestyle="", label=IN_WORDS[verdict], marker=style["marker"], markersize=7.5,
            color=style.get("color", "0.5"),
            markeredgecolor=style.get("edgecolors", "none"),
        )
        for verdict, style in MARKERS.items()
    ]  # fmt: skip
    legend_outside(figure, handles, "upper right")
    return figure


def _line(row: Row) -> tuple[str, str]:
    """Return axis and base of a case, which stand on one line of the map."""
    return row.axis, row.name.rpartition(", ")[2]


def _draw_axes(
    axes: Axes, rows: Sequence[Row], lines: Sequence[tuple[str, str]], colours: ScalarMappable
) -> None:
    """Draw a line for every axis and base, its cases side by side in the table's order."""
    most = 0
    for height, line in enumerate(lines):
        along = [row for row in rows if _line(row) == line]
        most = max(most, len(along))
        for position, row in enumerate(along):
            _mark(axes, position, height, row, colours)
        ends = dict.fromkeys([along[0].value, along[-1].value])
        axes.annotate(
            " to ".join(filter(None, ends)), (len(along) - 0.4, height),
            fontsize=points(8.5), va="center", color=GREY,
        )  # fmt: skip
    axes.set_yticks(
        range(len(lines)), [f"{axis}: {base}" for axis, base in lines], fontsize=points(9.5)
    )
    room = 6.0 if picture_format().stacks else 4.0  # of the ends, in words
    axes.set(xlim=(-0.7, most + room), ylim=(len(lines) - 0.4, -0.6), xticks=[])
    axes.set_title("Along each axis")
    axes.grid(False)


def _draw_pairs(axes: Axes, rows: Sequence[Row], colours: ScalarMappable) -> None:
    names = list(dict.fromkeys(name for row in rows for name in row.value.split(" + ")))
    for row in rows:
        across, down = (names.index(name) for name in row.value.split(" + "))
        _mark(axes, min(across, down), max(across, down), row, colours)
    axes.set_xticks(range(len(names)), names, rotation=60, ha="right", fontsize=points(9.5))
    axes.set_yticks(range(len(names)), names, fontsize=points(9.5))
    axes.set(xlim=(-0.6, len(names) - 0.4), ylim=(len(names) - 0.4, -0.6))
    axes.set_title(f"Two extremes at once: {rows[0].name.rpartition(', ')[2]}")


def _mark(axes: Axes, x: float, y: float, row: Row, colours: ScalarMappable) -> None:
    style = dict(MARKERS[row.verdict])
    style["s"] *= points(1.0) ** 2  # an area
    if "color" not in style:
        style["color"] = colours.to_rgba(np.array([row.residual]))
    axes.scatter([x], [y], zorder=3, **style)
