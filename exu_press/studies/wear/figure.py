"""A wear study in one picture: shape of the gap, clearance, quantities."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.plots.palette import colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import with_style
from exu_press.plots.sweep_words import axis_label
from exu_press.plots.typesetting import typeset, wrap_text
from exu_press.plots.words import describe
from exu_press.quantities import quantity_of
from exu_press.quantities.uncertain import significant
from exu_press.studies.wear.report import WearReport
from exu_press.studies.wear.shape import ANGLES

__all__ = ["wear_figure"]

MOST_SHAPES = 6

LETTERS = 34
"""In a line beside a panel of this height."""

LEAST_SPREAD = 1e-8
"""Change of a quantity over its value: a smaller one is rounding."""


@with_style
def wear_figure(report: WearReport) -> Figure:
    """Return worn depths by angle, and clearances and quantities over the strokes."""
    study, points = report.study, report.course
    names, joints = study.names, study.joints
    text = f"{describe([study.scene], 130)}\n{significant(points[-1].strokes, 4)} strokes in "
    text += report.jumps
    rows = [[0, 0], *grid_rows(1 + len(names), 2, first=1)]
    figure, panels = figure_with_panels("Wear over strokes", text, rows, 4.75, 2.6)
    deepest = max(joints, key=lambda joint: report.clearances(joint)[-1])
    _shapes(panels[0], report, deepest)
    strokes = [point.strokes for point in points]
    for axes, name in zip(panels[1:], ["", *names], strict=True):
        if name:
            quantity = quantity_of(study.scene, name).quantity
            values = [np.nan if v is None else v * quantity.scale for v in report.values(name)]
            axes.plot(strokes, values, "o-", markersize=3, color=colour_of(0))
            axes.set_ylabel(wrap_text(axis_label(name), LETTERS))
        else:
            for number, joint in enumerate(joints):
                values = [1e6 * value for value in report.clearances(joint)]
                label = joint.replace("_", " ")
                axes.plot(strokes, values, "o-", markersize=3, color=colour_of(number), label=label)
            axes.set_ylabel(f"largest clearance, {typeset('um')}")
            axes.legend(loc="best")
        axes.set_xlabel("strokes")
        axes.margins(x=0.03)
        axes.ticklabel_format(axis="y", useOffset=False)
        low, high = axes.dataLim.intervaly
        if high - low < LEAST_SPREAD * abs(high):
            axes.set_ylim(low - 1e-3 * abs(high), high + 1e-3 * abs(high))
    return figure


def _shapes(axes: Axes, report: WearReport, joint: str) -> None:
    """Draw the depth worn off a bearing over the angle on it, at some of the points."""
    points = report.course[1:] or report.course
    picked = sorted({round(i) for i in np.linspace(0, len(points) - 1, MOST_SHAPES)})
    for number, i in enumerate(picked):
        shape = points[i].depths[joint]
        axes.plot(
            np.degrees(ANGLES), 1e6 * shape.bearing, color=colour_of(number),
            label=f"{significant(points[i].strokes, 3)} strokes",
        )  # fmt: skip
        if shape.journal.max() > 0.05 * shape.bearing.max():
            axes.plot(np.degrees(ANGLES), 1e6 * shape.journal, "--", color=colour_of(number))
    axes.set_xlabel("angle from the x axis of the body, deg\n(solid: bearing, dashed: journal)")
    axes.set_ylabel(f"{joint.replace('_', ' ')}: worn off, {typeset('um')}")
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(range(0, 361, 45))
    axes.legend(loc="best", ncols=2)
