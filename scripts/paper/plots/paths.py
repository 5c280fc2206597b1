"""Figs. 17 and 18: paths of journal and ball centres, with what they are made of."""

from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.plots.canvas import angle_range, new_figure
from exu_press.plots.clearance_circle import Path, draw_path
from exu_press.plots.scales import angle_ticks
from exu_press.plots.style import COLOURS, SHADE, styled
from exu_press.result import Result

__all__ = ["paths_figure"]

MODES = {
    "free_flight": ("apart: free flight, or on the film", COLOURS["sky blue"]),
    "impact": ("impact", COLOURS["orange"]),
    "permanent": ("permanent contact", COLOURS["vermilion"]),
}


@styled
def paths_figure(
    figure: str, joint: str, runs: Mapping[str, Result], readings: Mapping[str, Mapping[str, Any]]
) -> Figure:
    """Return the path of a centre in every run, and its shares of time below it.

    Args:
        figure: its name in the paper.
        joint: "crank_pin" or "ball_left".
        runs: by label.
        readings: rows of the same runs.
    """
    what = "journal centre" if joint == "crank_pin" else "ball centre"
    elastic = any(run.scene.guide is not None for run in runs.values())
    heading = f"{figure}: path of the {what}{', elastic guides' if elastic else ''}"
    unloaded = {label: run for label, run in runs.items() if not run.scene.load}
    drawing = new_figure(heading, unloaded or runs, (3.9 * len(runs) + 0.9, 6.4))
    grid = drawing.subplots(2, len(runs), height_ratios=(1.0, 0.13), squeeze=False)
    coloured = None
    for column, (label, run) in enumerate(runs.items()):
        lines = draw_path(grid[0, column], Path(label, run, joint))
        grid[0, column].set_title(label)
        ends = grid[0, column].get_legend_handles_labels()
        grid[0, column].get_legend().remove()
        if lines is not None:
            coloured = lines
        row = readings[label]["readings"]
        _shares(grid[1, column], row["joints"][joint])
    if coloured is not None:
        bar = drawing.colorbar(coloured, ax=grid[0, :].tolist(), label="crank angle, deg")
        bar.set_ticks(list(angle_ticks(*angle_range(runs))))
    handles, labels = (a + b for a, b in zip(ends, _legend(grid[1, 0]), strict=True))
    drawing.legend(handles, labels, loc="outside lower center", ncols=len(labels))
    return drawing


def _legend(axes: Axes) -> tuple[list[Any], list[str]]:
    return axes.get_legend_handles_labels()


def _shares(axes: Axes, joint: Mapping[str, float]) -> None:
    """Draw one bar of shares of time."""
    left = 0.0
    for mode, (label, colour) in MODES.items():
        share = joint[mode]
        axes.barh(0.0, share, left=left, color=colour, label=label, height=0.8)
        if share > 0.08:
            words = f"{100 * share:.0f} %"
            axes.text(left + share / 2, 0.0, words, ha="center", va="center", fontsize=9)
        left += share
    axes.set(xlim=(0.0, 1.0), yticks=[], facecolor=SHADE)
    axes.set_xticks([0.0, 0.5, 1.0], ["0", "50 %", "100 %"])
    axes.set_xlabel(f"share of time; {joint['impacts']} impacts")
    axes.grid(False)
