"""Empty figures of Bokeh, which the script fills: curves over one axis, and their marks."""

from functools import cache
from typing import Any

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

__all__ = ["DASHES", "PANELS", "curve_panels"]

PANELS = 6
"""Panels of curves, one below the other; those that are not in use are hidden."""

HEIGHT = 150
"""Height of a panel, pixels."""

DASHES = ("solid", "dashed", "dotdash", "dotted")
"""Line styles of runs over each other, which are told apart without colours too."""

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
    strip.yaxis.major_label_overrides = {0: "impacts", 1: "TDC, BDC"}
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
    """Return an empty figure with its ways to zoom: drag to zoom or move, control and wheel."""
    made = figure(
        name=name,
        height=height,
        sizing_mode="stretch_width",
        x_range=across,
        y_range=up,
        tools=[],
        toolbar_location=None,
        min_border_left=74,
        min_border_right=12,
        min_border_top=4,
        min_border_bottom=4,
        stylesheets=[InlineStyleSheet(css=SCROLLING)],
    )
    pan = PanTool(dimensions="width", name=f"pan-{name}")
    zoom = BoxZoomTool(dimensions="width", name=f"zoom-{name}")
    wheel = WheelZoomTool(dimensions="width", modifiers={"ctrl": True})
    made.add_tools(pan, zoom, wheel)
    made.toolbar.active_drag = zoom
    made.toolbar.active_scroll = wheel
    made.xaxis.ticker = AdaptiveTicker(mantissas=[1, 2, 5], name=f"ticker-{name}")
    made.xaxis.name = f"x-axis-{name}"
    made.xaxis.major_label_standoff = 2
    return made
