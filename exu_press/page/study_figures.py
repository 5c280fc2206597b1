"""Empty figures of Bokeh for studies, which the script fills."""

from functools import cache
from typing import Any

from bokeh.models import BoxZoomTool, ColumnDataSource, FixedTicker, PanTool, Range1d, WheelZoomTool
from bokeh.models.annotations import Whisker
from bokeh.plotting import figure

from exu_press.page.document import document_of

__all__ = ["points_and_lines"]

RUN, CHOSEN, FAINT = "#0072B2", "#D55E00", "#9aa3ab"


@cache
def points_and_lines() -> dict[str, Any]:
    """Return both figures of a study."""
    return document_of([_points(), _parallel()])


def _points() -> Any:
    """Return the figure with a point for every run."""
    made = figure(
        name="points",
        height=380,
        sizing_mode="stretch_width",
        x_range=Range1d(start=0.0, end=1.0, name="points-x"),
        y_range=Range1d(start=0.0, end=1.0, name="points-y"),
        tools=[],
        toolbar_location=None,
        min_border_left=84,
    )
    pan, zoom = PanTool(name="points-pan"), BoxZoomTool(name="points-zoom")
    wheel = WheelZoomTool(modifiers={"ctrl": True})
    made.add_tools(pan, zoom, wheel)
    made.toolbar.active_drag, made.toolbar.active_scroll = zoom, wheel
    for name, marker, size, colour in (
        ("others", "circle", 5, FAINT),
        ("runs", "circle", 7, RUN),
        ("chosen", "diamond", 15, CHOSEN),
    ):
        empty: dict[str, list[float]] = {n: [] for n in ("x", "y", "low", "high", "colour")}
        source = ColumnDataSource(empty, name=f"points-{name}")
        colour_of: Any = "colour" if name == "runs" else colour
        made.add_layout(
            Whisker(base="x", lower="low", upper="high", source=source, line_color=colour)
        )
        made.scatter(
            "x",
            "y",
            source=source,
            marker=marker,
            size=size,
            fill_color=colour_of if name == "runs" else None,
            line_color=colour_of,
            line_width=2 if name == "chosen" else 1,
            alpha=0.5 if name == "others" else 0.9,
            name=f"glyphs-{name}",
        )
    return made


def _parallel() -> Any:
    """Return the figure of parallel coordinates: a line for every run over an axis for each key."""
    made = figure(
        name="parallel",
        height=380,
        sizing_mode="stretch_width",
        x_range=Range1d(start=-0.4, end=1.4, name="parallel-x"),
        y_range=Range1d(start=-0.22, end=1.22, name="parallel-y"),
        tools=[],
        toolbar_location=None,
    )
    made.grid.visible = False
    made.yaxis.visible = False
    made.xaxis.ticker = FixedTicker(ticks=[], name="parallel-ticks")
    made.xaxis.visible = False
    for name, colour, width, alpha in (
        ("others", FAINT, 0.8, 0.3),
        ("runs", RUN, 1.1, 0.65),
        ("chosen", CHOSEN, 3.0, 1.0),
    ):
        source = ColumnDataSource({"xs": [], "ys": [], "colour": []}, name=f"lines-{name}")
        colour_of = "colour" if name == "runs" else colour
        made.multi_line(
            "xs", "ys", source=source, line_color=colour_of, line_width=width, line_alpha=alpha
        )
    axes = ColumnDataSource({"x": [], "low": [], "high": []}, name="parallel-axes")
    made.segment("x", "low", "x", "high", source=axes, line_color="#767676", line_width=1.2)
    kept = ColumnDataSource({"x": [], "low": [], "high": []}, name="parallel-kept")
    made.segment(
        "x", "low", "x", "high", source=kept, line_color=CHOSEN, line_width=7, line_alpha=0.55
    )
    words = ColumnDataSource({"x": [], "y": [], "text": [], "align": []}, name="parallel-words")
    made.text(
        "x",
        "y",
        "text",
        source=words,
        text_align="center",
        text_baseline="middle",
        text_font_size="11px",
        name="parallel-labels",
    )
    return made
