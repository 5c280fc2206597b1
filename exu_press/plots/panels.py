"""A figure with a heading and panels; on narrow paper these stand below each other."""

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from exu_press.plots.format import picture_format
from exu_press.plots.style import points
from exu_press.plots.typesetting import plain, wrap_name

__all__ = [
    "Rows",
    "figure_with_panels",
    "grid_rows",
    "lowest_panels",
    "name_rows",
]

Rows = Sequence[Sequence[int | None]]
"""Number of the panel in each cell, row by row; one may fill several cells, None leaves one empty.
"""

LETTERS = 13.5
"""Of the text, in an inch."""

NARROWEST = 7.5
"""inch, in which a heading has room beside a legend."""

ROW_LETTERS = 28
"""In a line of a row's name."""

HEADING = 1.2
"""inch, of heading and text."""

STACKED, TALLER = 0.6, 1.2
"""Height of a panel on paper over that on a screen, where panels stand below each other; and over
that in proportion to the width, where they do not, as letters are large against it."""


def grid_rows(count: int, across: int, first: int = 0) -> Rows:
    """Return rows of so many panels, numbered from the first on.

    >>> grid_rows(5, 3)
    [[0, 1, 2], [3, 4, None]]
    """
    cells = [*range(first, first + count), *[None] * (-count % across)]
    return [cells[begin : begin + across] for begin in range(0, len(cells), across)]


def figure_with_panels(
    heading: str,
    text: str,
    rows: Rows,
    widths: float | Sequence[float],
    heights: float | Sequence[float],
    *,
    sharex: bool = False,
) -> tuple[Figure, list[Axes]]:
    """Return a figure without pyplot, and its panels by their numbers.

    Args:
        heading: of the picture.
        text: below it, in lines. On paper there is neither: the caption has both.
        rows: the panels, which begin with 0.
        widths: of the columns on a screen, inch; one number of all.
        heights: of the rows, likewise.
        sharex: whether panels have a common x axis, with numbers below the lowest ones alone.
    """
    form, table = picture_format(), np.array(rows, dtype=object)
    down, across = table.shape
    high, wide = np.broadcast_to(heights, down), np.broadcast_to(widths, across)
    count = 1 + max(number for row in rows for number in row if number is not None)
    places = [np.nonzero(table == number) for number in range(count)]
    spans = [(slice(y.min(), y.max() + 1), slice(x.min(), x.max() + 1)) for y, x in places]
    if form.stacks:
        high, wide = np.array([high[of_rows].sum() for of_rows, _ in spans]), wide[:1]
        spans = [(slice(number, number + 1), slice(None)) for number in range(count)]
    figure = _figure(heading, text, float(wide.sum()), float(high.sum()))
    grid = figure.add_gridspec(len(high), len(wide), height_ratios=high, width_ratios=wide)
    panels: list[Axes] = []
    for span in spans:
        panels.append(
            figure.add_subplot(grid[span], sharex=panels[0] if sharex and panels else None)
        )
    for axes in set(panels).difference(lowest_panels(panels)) if sharex else ():
        axes.tick_params(labelbottom=False)
    return figure, panels


def lowest_panels(panels: Sequence[Axes]) -> list[Axes]:
    """Return those of some panels below which none of them is as wide, at the same place."""
    specs = [axes.get_subplotspec() for axes in panels]
    spans = [(spec.colspan, spec.rowspan) for spec in specs if spec is not None]
    return [
        axes
        for axes, (columns, rows) in zip(panels, spans, strict=True)
        if not any(columns == x and y.start >= rows.stop for x, y in spans)
    ]


def name_rows(axes: Axes, rows: Sequence[float], names: Sequence[str]) -> None:
    """Name rows of a panel at its left; on narrow paper in lines of at most ROW_LETTERS."""
    narrow = picture_format().stacks
    texts = [wrap_name(name, ROW_LETTERS, ".") if narrow else plain(name) for name in names]
    axes.set_yticks(rows, texts)


def _figure(heading: str, text: str, width: float, height: float) -> Figure:
    """Return an empty figure for panels of this size on a screen, inch."""
    form = picture_format()
    if form.width is not None:
        scale = STACKED if form.stacks else TALLER * form.width / width
        size = form.width, scale * height
    else:
        size = max(width, NARROWEST), HEADING + height
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)  # else each text is measured on a canvas of its own
    if form.width is not None:
        return figure
    most = int(LETTERS * figure.get_figwidth() / points(1.0))
    lines = [piece for line in text.splitlines() for piece in textwrap.wrap(line, most)]
    text = plain("\n".join(["", *lines]))  # an empty line, where the heading goes
    below = figure.suptitle(text, x=0.012, ha="left", fontsize=points(9.5), linespacing=1.45)
    figure.add_artist(
        Annotation(
            heading, (0, 1), xycoords=below, va="top", fontsize=points(13), fontweight="bold"
        )
    ).set_in_layout(False)
    return figure
