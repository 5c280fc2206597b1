"""Curves that zoom each by itself: measured beside computed, and how far keys are determined."""

from collections.abc import Sequence
from typing import Any

from exu_press.page.document import (
    Live,
    data_element,
    document_of,
    escape,
    has_library,
    scripts,
    styles,
)
from exu_press.plots.palette import colour_of
from exu_press.studies.base.report import Panel

__all__ = ["lines_viewer"]


def lines_viewer(panels: Sequence[Panel]) -> Live | None:
    """Return the live part of a page of curves; nothing without the extra `page`, or curves."""
    if not panels or not has_library():
        return None
    data = document_of([_figure(panel) for panel in panels])
    parts = [_head(panel, number) for number, panel in enumerate(panels)]
    body = (
        '<div id="viewer" class="live" hidden>\n'
        + "\n".join(parts)
        + '\n<p class="told">Drag to zoom; a double click shows everything.</p></div>\n'
        '<p id="failed" class="warnings" role="alert" hidden></p>\n'
        + data_element("page-data", data)
    )
    return Live(body, scripts("data", "theme", "lines"), styles())


def _head(panel: Panel, number: int) -> str:
    """Return a panel's place with its words; texts stand outside the library's canvas."""
    legend = "".join(
        f'<span class="value" style="--run: {colour_of(index)}">{escape(line.label)}</span> '
        for index, line in enumerate(panel.lines)
    )
    title = escape(panel.title)
    return (
        f"<h3>{title}</h3><p>{legend}</p>"
        f'<div id="lines-{number}" class="plot" role="img" aria-label="{title}"></div>'
        f'<p class="told">across: {escape(panel.across)}; up: {escape(panel.up)} '
        f'<output id="at-{number}"></output></p>'
    )


def _figure(panel: Panel) -> Any:
    from bokeh.models import ColumnDataSource, Range1d
    from bokeh.models.annotations import Whisker
    from bokeh.plotting import figure

    from exu_press.page.figures import let_zoom

    plot = figure(height=300, sizing_mode="stretch_width", tools=[], toolbar_location=None)
    let_zoom(plot)
    heights = [y for line in panel.lines for y in (*line.y, *(line.low or ()), *(line.high or ()))]
    if heights:
        margin = 0.08 * (max(heights) - min(heights)) or 0.08 * abs(heights[0]) or 1.0
        plot.y_range = Range1d(start=min(heights) - margin, end=max(heights) + margin)
    for number, line in enumerate(panel.lines):
        colour = colour_of(number)
        if line.points:
            plot.scatter([*line.x], [*line.y], size=5, color=colour, alpha=0.8)
        else:
            plot.line([*line.x], [*line.y], line_color=colour, line_width=1.5)
        if line.low is not None and line.high is not None:
            bars = {"x": [*line.x], "low": [*line.low], "high": [*line.high]}
            source = ColumnDataSource(bars)
            plot.add_layout(
                Whisker(base="x", lower="low", upper="high", source=source, line_color=colour)
            )
    return plot
