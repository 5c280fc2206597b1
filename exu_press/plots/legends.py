"""Legends beside the data, in as many columns as they have room for."""

import math
import textwrap
from collections.abc import Callable, Sequence
from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend

__all__ = ["fit_above", "legend_above", "legend_outside"]

MOST_COLUMNS = 6

SHORTEST_LINE = 10
"""Letters."""


def legend_above(axes: Axes, columns: int = 4, **legend: Any) -> Legend:
    """Put a panel's legend over its right end, where no data is; return it."""
    return axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=columns,
        columnspacing=1.3,
        handletextpad=0.5,
        borderpad=0.0,
        **legend,
    )


def fit_above(axes: Axes, legend: Legend, room: float) -> Legend:
    """Return a panel's legend with the columns that a width has room for, pixels."""
    handles, labels = legend.legend_handles, [text.get_text() for text in legend.get_texts()]

    def build(columns: int) -> Legend:
        return legend_above(axes, columns, handles=handles, labels=labels)

    return _fit(legend, build, room)


def legend_outside(figure: Figure, handles: Sequence[Artist], where: str = "lower center") -> None:
    """Put a figure's legend below or above all its panels."""
    outside: Any = f"outside {where}"

    def build(columns: int) -> Legend:
        return figure.legend(handles=handles, loc=outside, ncols=columns)

    _fit(build(MOST_COLUMNS), build, float(figure.bbox.width))


def _fit(legend: Legend, build: Callable[[int], Legend], room: float) -> Legend:
    """Build a legend anew in fewer columns until it fits; break the lines that are longer."""
    count = len(legend.get_texts())
    rows = math.ceil(count / MOST_COLUMNS)
    while (width := legend.get_window_extent().width) > room and rows < count:
        rows += 1
        legend.remove()
        legend = build(math.ceil(count / rows))
    for text in legend.get_texts() if width > room else ():
        taken = text.get_window_extent().width
        letters = int(len(text.get_text()) * (room - width + taken) / max(taken, 1.0))
        text.set_text(textwrap.fill(text.get_text(), max(SHORTEST_LINE, letters)))
    return legend
