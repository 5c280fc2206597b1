"""Empty figures of Bokeh, which the scripts fill: curves and their marks, points of a study."""

from functools import cache
from typing import Any, Literal

from bokeh.models import (
    AdaptiveTicker,
    BoxZoomTool,
    ColumnDataSource,
    FixedTicker,
    InlineStyleSheet,
    LogAxis,
    LogScale,
    PanTool,
    Range1d,
    TapTool,
    WheelZoomTool,
)
from bokeh.models.annotations import BoxAnnotation, Whisker
from bokeh.plotting import figure

from exu_press.page.document import document_of

__all__ = ["DASHES", "PANELS", "curve_panels", "let_zoom", "points_and_lines"]

PANELS = 6
"""Panels of curves, one below the other; those that are not in use are hidden."""

HEIGHT = 150
"""Height of a panel, pixels."""

DASHES = ("solid", "dashed", "dotdash", "dotted")
"""Line styles of runs over each other, which are told apart without colours too."""

RUN, CHOSEN, FAINT = "#0072B2", "#D55E00", "#9aa3ab"

SCROLLING = ".bk-events { touch-action: pan-y !important; }"
"""A finger that moves up or down scrolls the page."""


@cache
def curve_panels(runs: tuple[str, ...]) -> dict[str, Any]:
    """Return the panels for runs of these colours, which share the range of their x axis.

    The models that the script looks for are called KIND-PANEL-RUN.
    """
    shared = Range1d(start=0.0, end=1.0, name="x-range")
    panels = [_panel(number, runs, shared) for number in range(PANELS)]
    return document_of([*panels, _marks_strip(shared)])


def _panel(number: int, colours: tuple[str, ...], shared: Range1d) -> Any:
    linear = Range1d(start=0.0, end=1.0, name=f"linear-{number}")
    log = Range1d(start=1.0, end=10.0, name=f"log-{number}")
    panel = _figure(f"panel-{number}", shared, linear, HEIGHT)
    panel.extra_y_ranges = {"log": log}
    panel.extra_y_scales = {"log": LogScale()}
    panel.yaxis[0].name = f"linear-axis-{number}"
    panel.add_layout(LogAxis(y_range_name="log", visible=False, name=f"log-axis-{number}"), "left")
    for name, hatch in (("horizon", "/"), ("start", " ")):
        panel.add_layout(
            BoxAnnotation(
                name=f"{name}-{number}",
                visible=False,
                fill_color="#888888",
                fill_alpha=0.12,
                hatch_pattern=hatch,
                hatch_color="#888888",
                hatch_alpha=0.35,
                line_color=None,
            )
        )
    for run, colour in enumerate(colours):
        dash = DASHES[run // 6 % len(DASHES)] if len(colours) > 6 else DASHES[run % len(DASHES)]
        source = ColumnDataSource({"x": [], "y": []}, name=f"curve-{number}-{run}")
        peak = ColumnDataSource(
            {name: [] for name in ("x", "y", "low", "high", "left", "right")},
            name=f"peak-{number}-{run}",
        )
        for kind in ("linear", "log"):
            on: dict[str, Any] = {"y_range_name": "log"} if kind == "log" else {}
            tagged = {**on, "visible": kind == "linear", "tags": [kind, number, run]}
            panel.quad(
                left="left",
                right="right",
                bottom="low",
                top="high",
                source=peak,
                fill_color=colour,
                fill_alpha=0.16,
                line_color=None,
                **tagged,
            )
            panel.line(
                "x",
                "y",
                source=source,
                line_color=colour,
                line_width=1.4,
                line_dash=dash if len(colours) > 1 else "solid",
                line_join="round",
                **tagged,
            )
            panel.scatter(
                "x", "y", source=peak, size=6, fill_color=None, line_color=colour, **tagged
            )
            bar = Whisker(
                base="x", upper="high", lower="low", source=peak, line_color=colour, **tagged
            )
            panel.add_layout(bar)
    return panel


def _marks_strip(shared: Range1d) -> Any:
    """Return the strip with the marks that can be clicked, in the same x range."""
    strip = _figure("marks", shared, Range1d(start=-0.7, end=1.7, name="marks-y"), 64)
    strip.add_tools(TapTool())
    strip.yaxis.ticker = FixedTicker(ticks=[0, 1])
    strip.yaxis.major_label_overrides = {0: "impacts", 1: "dead centres"}
    strip.ygrid.visible = False
    for name, marker, colour, level in (
        ("impacts", "triangle", "#D55E00", 0.0),
        ("ends", "diamond", "#0072B2", 1.0),
    ):
        source = ColumnDataSource({"x": [], "y": [], "mark": []}, name=f"marks-{name}")
        strip.scatter(
            "x",
            "y",
            source=source,
            marker=marker,
            size=9,
            fill_color=colour,
            line_color=colour,
            fill_alpha=0.75,
            nonselection_fill_alpha=0.75,
            name=f"glyphs-{name}",
            tags=[level],
        )
    return strip


def _figure(name: str, across: Range1d, up: Range1d, height: int) -> Any:
    """Return an empty figure of which the x axis alone can be zoomed."""
    borders = {"min_border_left": 74, "min_border_right": 12}
    borders |= {"min_border_top": 4, "min_border_bottom": 4}
    sheets = [InlineStyleSheet(css=SCROLLING)]
    plot = _empty(name, across, up, height, **borders, stylesheets=sheets)
    let_zoom(plot, "width")
    plot.xaxis.ticker = AdaptiveTicker(mantissas=[1, 2, 5], name=f"ticker-{name}")
    plot.xaxis.name = f"x-axis-{name}"
    plot.xaxis.major_label_standoff = 2
    return plot


def _empty(name: str, across: Range1d, up: Range1d, height: int, **more: Any) -> Any:
    bare: dict[str, Any] = {"sizing_mode": "stretch_width", "tools": [], "toolbar_location": None}
    return figure(name=name, height=height, x_range=across, y_range=up, **bare, **more)


def let_zoom(plot: Any, dimensions: Literal["width", "both"] = "both") -> None:
    """Let a drag zoom a figure, or move it if the page says so, and the wheel with control."""
    pan = PanTool(dimensions=dimensions, name=f"pan-{plot.name}")
    zoom = BoxZoomTool(dimensions=dimensions, name=f"zoom-{plot.name}")
    wheel = WheelZoomTool(dimensions=dimensions, modifiers={"ctrl": True})
    plot.add_tools(pan, zoom, wheel)
    plot.toolbar.active_drag, plot.toolbar.active_scroll = zoom, wheel


@cache
def points_and_lines() -> dict[str, Any]:
    """Return both figures of a study."""
    return document_of([_points(), _parallel()])


def _points() -> Any:
    """Return the figure with a point for every run."""
    across, up = (Range1d(start=0.0, end=1.0, name=f"points-{axis}") for axis in "xy")
    plot = _empty("points", across, up, 380, min_border_left=84)
    let_zoom(plot)
    for name, marker, size, colour in (
        ("others", "circle", 5, FAINT),
        ("runs", "circle", 7, RUN),
        ("chosen", "diamond", 15, CHOSEN),
    ):
        empty: dict[str, list[float]] = {n: [] for n in ("x", "y", "low", "high", "colour")}
        source = ColumnDataSource(empty, name=f"points-{name}")
        colour_of: Any = "colour" if name == "runs" else colour
        plot.add_layout(
            Whisker(base="x", lower="low", upper="high", source=source, line_color=colour)
        )
        plot.scatter(
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
    return plot


def _parallel() -> Any:
    """Return the figure of parallel coordinates: a line for every run over an axis for each key."""
    across = Range1d(start=-0.4, end=1.4, name="parallel-x")
    plot = _empty("parallel", across, Range1d(start=-0.22, end=1.22, name="parallel-y"), 380)
    plot.grid.visible = False
    plot.yaxis.visible = False
    plot.xaxis.ticker = FixedTicker(ticks=[], name="parallel-ticks")
    plot.xaxis.visible = False
    for name, colour, width, alpha in (
        ("others", FAINT, 0.8, 0.3),
        ("runs", RUN, 1.1, 0.65),
        ("chosen", CHOSEN, 3.0, 1.0),
    ):
        source = ColumnDataSource({"xs": [], "ys": [], "colour": []}, name=f"lines-{name}")
        colour_of = "colour" if name == "runs" else colour
        plot.multi_line(
            "xs", "ys", source=source, line_color=colour_of, line_width=width, line_alpha=alpha
        )
    axes = ColumnDataSource({"x": [], "low": [], "high": []}, name="parallel-axes")
    plot.segment("x", "low", "x", "high", source=axes, line_color="#767676", line_width=1.2)
    selected_range = ColumnDataSource({"x": [], "low": [], "high": []}, name="parallel-kept")
    plot.segment(
        "x",
        "low",
        "x",
        "high",
        source=selected_range,
        line_color=CHOSEN,
        line_width=7,
        line_alpha=0.55,
    )
    texts = ColumnDataSource({"x": [], "y": [], "text": [], "align": []}, name="parallel-words")
    plot.text(
        "x",
        "y",
        "text",
        source=texts,
        text_align="align",
        text_baseline="middle",
        text_font_size="11px",
        name="parallel-labels",
    )
    return plot
