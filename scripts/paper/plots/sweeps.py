"""Figs. 19-27: the slider over clearance, speed and blanking force."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.plots.canvas import angle_axis, crank_degrees, curve, legend_above, new_figure
from exu_press.plots.scales import note
from exu_press.plots.style import COLOURS, GREY, RUN, colour_of, styled
from exu_press.result import Result
from paper.comparison import observed
from paper.plots.drawing import plain_logarithm
from paper.plots.revolution import ideal_motion, mean_acceleration
from paper.published import stated

__all__ = ["curves_figure", "peaks_figure"]

Array = NDArray[np.float64]
Readings = Mapping[str, Mapping[str, Any]]

MODEL_LOOKS: dict[str, tuple[str, dict[str, Any]]] = {
    "mean_1ms": ("mean over 1 ms", {"color": RUN, "marker": "o"}),
    "differentiated_1khz": ("1 kHz, differentiated", {"color": COLOURS["sky blue"], "marker": "s"}),
    "resolved": ("as resolved", {"color": GREY, "marker": "^", "linestyle": ":"}),
}
PAPER: dict[str, Any] = {
    "color": COLOURS["vermilion"],
    "marker": "D",
    "markersize": 8,
    "linestyle": "none",
    "label": "paper",
    "zorder": 5,
}


@styled
def curves_figure(
    figure: str, kind: str, runs: Mapping[str, Result], readings: Readings, said: str
) -> Figure:
    """Return displacement or velocity of a sweep, its deviation from ideal, and what it comes to.

    Args:
        figure: its name in the paper.
        kind: "displacement" or "velocity".
        runs: by name, in the sweep's order.
        readings: rows of the same runs.
        said: what the paper says of it.
    """
    displacement = kind == "displacement"
    drawing = new_figure(f"{figure}: {kind} of the slider", runs, (13.0, 7.4))
    grid = drawing.add_gridspec(2, 2, width_ratios=(1.9, 1.0))
    whole, apart = (drawing.add_subplot(grid[row, 0]) for row in (0, 1))
    summary = drawing.add_subplot(grid[:, 1])
    level, unit, scale = ("position", "mm", 1e3) if displacement else ("velocity", "m/s", 1.0)
    for index, (name, run) in enumerate(runs.items()):
        look = {"color": colour_of(index), "linewidth": 1.2, "label": name}
        values, ideal = run[f"slider_{level}"], ideal_motion(run)[0 if displacement else 1]
        curve(whole, run, scale * values, **look)
        curve(
            apart, run, 1e6 * (ideal - values) if displacement else 1e3 * (values - ideal), **look
        )
    whole.set_title(f"{level.capitalize()}")
    whole.set_ylabel(f"{level}, {unit}")
    apart.set_title("How far below the ideal" if displacement else "Deviation from the ideal")
    apart.set_ylabel("µm" if displacement else "mm/s")
    apart.set_xlabel("crank angle from top dead centre, deg")
    legend_above(whole)
    angle_axis([whole, apart], runs)
    measure = "bottom_dead_centre" if displacement else "peak_velocity"
    _summary(summary, measure, list(runs), readings)
    summary.set_title("Bottom dead centre below the ideal" if displacement else "Peak velocity")
    summary.set_ylabel("µm" if displacement else "m/s")
    summary.set_xlabel(f"the paper: {said}")
    return drawing


@styled
def peaks_figure(figure: str, runs: Mapping[str, Result], readings: Readings, said: str) -> Figure:
    """Return the acceleration of every run of a sweep, and the peaks beside the paper's.

    Args:
        figure: its name in the paper.
        runs: by name, in the sweep's order.
        readings: rows of the same runs.
        said: what the paper says of it.
    """
    drawing = new_figure(f"{figure}: acceleration of the slider, mean over 1 ms", runs, (13.0, 7.4))
    grid = drawing.add_gridspec(2, 3, width_ratios=(1.0, 1.0, 1.0))
    panels = [drawing.add_subplot(grid[place // 2, place % 2]) for place in range(len(runs))]
    low = min(float(np.nanmin(mean_acceleration(run))) for run in runs.values())
    high = max(float(np.nanmax(mean_acceleration(run))) for run in runs.values())
    for axes, letter, (index, (name, run)) in zip(
        panels, "abcd", enumerate(runs.items()), strict=False
    ):
        curve(axes, run, mean_acceleration(run), color=colour_of(index), linewidth=1.0)
        ideal: dict[str, Any] = {"color": "black", "linewidth": 0.9, "linestyle": (0, (4, 2))}
        axes.plot(crank_degrees(run), ideal_motion(run)[2], **ideal)
        axes.set_title(f"{letter}  {name}")
        axes.set_ylim(1.1 * low, 1.1 * high)
        peak = stated(name, "peak_acceleration")
        if peak is not None:
            note(axes, f"paper's peak: {peak:g} m/s²")
        if letter in "ac":
            axes.set_ylabel("m/s²")
        if letter in "cd":
            axes.set_xlabel("crank angle, deg")
    angle_axis(panels, runs)
    summary = drawing.add_subplot(grid[:, 2])
    _summary(summary, "peak_acceleration", list(runs), readings)
    summary.set_title("Peak acceleration")
    summary.set_ylabel("m/s²")
    summary.set_yscale("log")
    low, high = summary.get_ylim()
    plain_logarithm(summary.yaxis, np.log10(high / low))
    summary.set_xlabel(f"the paper: {said}")
    return drawing


def _summary(axes: Axes, measure: str, names: Sequence[str], readings: Readings) -> None:
    """Draw a measure of every run under each model of observation, and the paper's values."""
    scale = 1e6 if measure == "bottom_dead_centre" else 1.0
    places = list(range(len(names)))
    for model, (label, look) in MODEL_LOOKS.items():
        values = [observed(readings[name], measure, model) for name in names]
        known = [np.nan if value is None else scale * value for value in values]
        axes.plot(places, known, **look, label=label)
    paper = {place: stated(name, measure) for place, name in enumerate(names)}
    known_paper = {place: value for place, value in paper.items() if value is not None}
    if known_paper:
        axes.plot(list(known_paper), list(known_paper.values()), **PAPER)
    axes.set_xticks(places, [" ".join(name.split()[-2:]) for name in names])
    axes.set_xlim(-0.3, len(names) - 0.7)
    axes.legend(loc="best")
