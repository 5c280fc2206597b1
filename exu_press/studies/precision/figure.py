"""Work-precision pictures: error against run time, one picture a case, all solvers in it."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from exu_press.plots.palette import COLOURS, GREY, SHADE, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import points, with_style
from exu_press.studies.precision.report import PrecisionReport
from exu_press.studies.precision.rows import Row, series_of
from exu_press.studies.precision.stated import StatedErrors
from exu_press.studies.precision.table import horizon_text
from exu_press.studies.precision.timing import FIXED, TOLERANCE

__all__ = ["precision_figure"]

OWN = {
    TOLERANCE: {"color": COLOURS["vermilion"], "marker": "o", "linewidth": 2.2, "zorder": 4},
    FIXED: {"color": COLOURS["blue"], "marker": "s", "linewidth": 2.2, "zorder": 4},
}
PEERS = {
    "SciPy Radau": {"color": COLOURS["green"], "marker": "^"},
    "SciPy BDF": {"color": COLOURS["green"], "marker": "v", "linestyle": "--"},
    "SciPy LSODA": {"color": COLOURS["purple"], "marker": "D"},
    "CVODE": {"color": COLOURS["sky blue"], "marker": "P"},
    "IDA": {"color": COLOURS["sky blue"], "marker": "X", "linestyle": "--"},
    "numbalsoda LSODA": {"color": COLOURS["purple"], "marker": "d", "linestyle": "--"},
}
MARKERS = ("1", "2", "3", "4", "+", "x")
"""Markers of the package's own settings that are varied, in grey."""


@with_style
def precision_figure(report: PrecisionReport, name: str) -> Figure:
    """Return position and peak acceleration error of a case over run time, and stated over true.

    Where trajectories diverge before the end, the error of the whole run's peaks, as distributions.
    Errors that the reference cannot tell lie hollow on the shaded band's edge; failed runs are
    crosses above.
    """
    case = report.cases[name]
    series = {solver: rows for (of, solver), rows in series_of(report.rows).items() if of == name}
    panels = {"error_position": "angle, rad" if case["scene"] is None else "position, m"}
    everything = [row for rows in series.values() for row in rows]
    if case["horizon"] < case["duration"] and any(row.error_peaks for row in everything):
        panels["error_peaks"] = "peaks of the whole run: mean, 95 %"
    elif any(row.error_peak_acceleration is not None for row in everything):
        panels["error_peak_acceleration"] = "peak acceleration, relative"
    else:
        panels["error_velocity"] = "angular velocity, rad/s" if case["scene"] is None else "m/s"
    stated = [entry for entry in report.stated if entry.case == name and entry.errors]
    heading = f"{case['title']}: error against run time"
    widths = (*[5.5] * (len(panels) + bool(stated)), 1.9)
    rows = grid_rows(len(widths), len(widths))
    figure, (*axes, key) = figure_with_panels(heading, _words(report, case), rows, widths, 4.8)
    if stated:
        _draw_stated(axes[-1], stated)
    for panel, (error, label) in zip(axes, panels.items(), strict=False):
        _draw(panel, series, error, case)
        panel.set(title=f"Error of the {label}", xlabel="processor time of the integration, s")
    key.axis("off")
    handles: list[Artist] = [
        Line2D([], [], label=s, **_style(s, index)) for index, s in enumerate(_in_order(series))
    ]
    handles.append(Patch(color=SHADE, label="below the error\nof the reference"))
    key.legend(handles=handles, loc="upper left", handlelength=2.6, borderaxespad=0.0)
    return figure


def _draw(axes: Axes, series: Mapping[str, Sequence[Row]], error: str, case: Any) -> None:
    axes.set(xscale="log", yscale="log")
    axes.margins(0.06, 0.08)
    floor = case["reference"]["floor"].get(error.removeprefix("error_"))
    failed = []
    for index, solver in enumerate(_in_order(series)):
        style = _style(solver, index)
        done = [row for row in series[solver] if row.status == "completed"]
        failed += [(row, style["color"]) for row in series[solver] if row.status != "completed"]
        points = [(row.cpu_time, getattr(row, error), error in row.at_most) for row in done]
        points = [point for point in points if point[1] is not None and point[1] > 0.0]
        axes.plot([x for x, _, _ in points], [y for _, y, _ in points], **{**style, "marker": ""})
        for hollow in (False, True):
            some = [(x, y) for x, y, least in points if least is hollow]
            axes.plot(
                [x for x, _ in some],
                [y for _, y in some],
                **{**style, "linestyle": ""},
                markerfacecolor="white" if hollow else style["color"],
            )
    low, high = axes.get_ylim()
    if floor and floor > 0.03 * low:  # else so far below that it would only flatten the curves
        axes.set_ylim(min(low, 0.5 * floor), high)
        axes.axhspan(axes.get_ylim()[0], floor, color=SHADE, linewidth=0, zorder=0.5)
    _draw_failed(axes, failed)


def _draw_stated(axes: Axes, stated: Sequence[StatedErrors]) -> None:
    """Draw the stated error of every figure over its true one; below the diagonal is too small."""
    for index, entry in enumerate(stated):
        stated_errors, true_errors = zip(*entry.errors, strict=True)
        label = f"tolerance {entry.tolerance:g}"
        axes.plot(
            true_errors, stated_errors, ".", color=colour_of(index), markersize=5, label=label
        )
    axes.set(xscale="log", yscale="log")
    ends = np.array([*axes.get_xlim(), *axes.get_ylim()])
    line = float(ends.min()), float(ends.max())
    axes.plot(line, line, color=GREY, linewidth=1.0, zorder=1)
    axes.set(xlim=line, ylim=line, title="Stated errors of all figures, relative")
    axes.set(xlabel="true error", ylabel="stated error")
    axes.legend(loc="lower right")


def _draw_failed(axes: Axes, failed: Sequence[tuple[Row, str]]) -> None:
    """Mark failed runs along the upper edge, where they spent their time."""
    for row, colour in failed:
        axes.plot(
            row.cpu_time,
            0.975,
            transform=axes.get_xaxis_transform(),
            marker="x",
            markersize=8,
            markeredgewidth=2.0,
            color=colour,
        )
    if failed:
        axes.set_title(f"x: {len(failed)} failed", loc="right", fontsize=points(8.5), color=GREY)


def _in_order(series: Mapping[str, Sequence[Row]]) -> list[str]:
    """Return the solvers: ours, peers, then variations of ours."""
    known = [*OWN, *PEERS]
    return sorted(series, key=lambda s: known.index(s) if s in known else len(known))


def _style(solver: str, index: int) -> dict[str, Any]:
    style = {"linewidth": 1.3, "markersize": 6.0, "zorder": 3, "linestyle": "-"}
    if solver in OWN:
        return {**style, **OWN[solver]}
    if solver in PEERS:
        return {**style, **PEERS[solver]}
    varied = {"color": GREY, "marker": MARKERS[index % len(MARKERS)], "linewidth": 0.8}
    return {**style, **varied, "markersize": 9.0, "zorder": 2, "linestyle": ":"}


def _words(report: PrecisionReport, case: Mapping[str, Any]) -> str:
    reference = case["reference"]
    text = f"reference: {reference['method']}"
    if reference["status"] != "ok":
        text = f"NO REFERENCE ({reference['method']})"
    text += f"; {horizon_text(case)}, of {case['duration']:g} s"
    if report.quick:
        text += "; reduced form, times mean nothing"
    return f"{text}; {report.machine['processor']}"
