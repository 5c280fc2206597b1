"""Measured curves with the computed ones over them."""

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.numerics.arrays import Array
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import GREY, line_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import with_style
from exu_press.plots.typesetting import plain, typeset
from exu_press.studies.curve_comparison import CurveComparison
from exu_press.studies.curve_file import CurveFile

__all__ = ["curve_panel", "measured_figure"]

FEW = 100
"""Samples up to which a measured curve has points that are seen below a line."""


@with_style
def measured_figure(comparisons: Mapping[str, Mapping[str, CurveComparison]]) -> Figure:
    """Return a panel for each curve, by its name, with the runs by label."""
    text, rows = "Lines go through every step of the runs.", grid_rows(len(comparisons), 1)
    figure, panels = figure_with_panels("Measured and computed", text, rows, 9.5, 2.9)
    for panel, (name, runs) in zip(panels, comparisons.items(), strict=True):
        first = next(iter(runs.values()))
        computed = {label: comparison.line for label, comparison in runs.items()}
        curve_panel(panel, name, first.curve, first.measured, computed, first.unit)
    return figure


def curve_panel(
    axes: Axes,
    name: str,
    curve: CurveFile,
    measured: Array,
    computed: Mapping[str, tuple[Array, Array]],
    unit: str,
) -> None:
    """Draw a measured curve, (m,), and places and values of computed ones by label, in a unit."""
    size = 3 if len(measured) > FEW else 7
    axes.plot(curve.at, measured, ".", color=GREY, markersize=size, label="measured")
    for index, (label, line) in enumerate(computed.items()):
        axes.plot(*line, **line_of(index), label=plain(label))
    axes.set_title(plain(f"Curve {name}"))
    axes.set_xlabel(curve.axis_label)
    axes.set_ylabel(plain(typeset(f"{curve.name.replace('_', ' ')}, {unit}")))
    legend_above(axes)
