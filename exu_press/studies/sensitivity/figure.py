"""A sensitivity study in one picture: the spread of each quantity, and its share by key."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from exu_press.numerics.arrays import Array
from exu_press.plots.format import picture_format
from exu_press.plots.legends import legend_outside
from exu_press.plots.palette import COLOURS, GREY
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import with_style
from exu_press.plots.sweep_words import axis_label, words
from exu_press.plots.typesetting import typeset, wrap_text
from exu_press.plots.words import describe
from exu_press.quantities import quantity_of
from exu_press.studies.sensitivity.indices import Indices
from exu_press.studies.sensitivity.report import SensitivityReport

__all__ = ["sensitivity_figure"]

BINS = 30
BARS = COLOURS["sky blue"], COLOURS["blue"]


@with_style
def sensitivity_figure(report: SensitivityReport) -> Figure:
    """Return a row a quantity: its distribution, the tornado, and the indices."""
    study = report.study
    names, keys = study.sensitivity.quantities, list(study.keys)
    lines = [describe([study.scene], 130), report.run_summary[0]]
    rows, height = grid_rows(3 * len(names), 3), 1.6 + 0.32 * len(keys)
    figure, panels = figure_with_panels("Effect of tolerances", "\n".join(lines), rows, 3.8, height)
    for number, name in enumerate(names):
        row = panels[3 * number : 3 * number + 3]
        quantity = quantity_of(study.scene, name).quantity
        unit = typeset(quantity.display_unit)
        indices = report.indices[number]
        if indices is None:
            for axes in row:
                axes.axis("off")
            row[0].text(0.0, 0.5, f"{wrap_text(words(name))}: does not move")
            continue
        _spread(row[0], report.sample.values[number] * quantity.scale, report, number)
        order = np.argsort(indices.total)
        key_labels = [wrap_text(words(keys[n])) for n in order]
        bars = report.bars[order, :, number] * quantity.scale
        middle = report.middle[number] * quantity.scale
        places = np.arange(len(order))
        for end, colour in enumerate(BARS):
            row[1].barh(places, bars[:, end] - middle, color=colour, height=0.62)
        row[1].axvline(0.0, color="black", linewidth=0.8)
        row[1].margins(x=0.05)
        row[1].set_yticks(places, key_labels)
        row[1].set_title("One key at its 5 % and 95 %")
        row[1].set_xlabel(f"change{f', {unit}' if unit else ''}")
        _indices(row[2], indices, order)
        row[2].set_yticks(places, key_labels if picture_format().stacks else [])
    ends = [
        Patch(color=colour, label=f"at its {end} %")
        for end, colour in zip((5, 95), BARS, strict=True)
    ]
    handles = [*ends, *(line for line in panels[2].lines if line.get_marker() == "o")]
    legend_outside(figure, handles, "upper right")
    return figure


def _spread(axes: Axes, values: Array, report: SensitivityReport, number: int) -> None:
    axes.hist(values, BINS, color=COLOURS["sky blue"], edgecolor="white", linewidth=0.5)
    name = report.study.sensitivity.quantities[number]
    quantity = quantity_of(report.study.scene, name).quantity
    distribution = report.spreads[number]
    for value in (distribution.low, distribution.middle, distribution.high):
        axes.axvline(value * quantity.scale, color=GREY, linewidth=1.0, linestyle="--")
    axes.margins(x=0.03)
    axes.locator_params(axis="x", nbins=5)
    axes.set(xlabel=wrap_text(axis_label(name)), ylabel="runs")
    axes.set_title("Distribution; lines at 5, 50, 95 %")


def _indices(
    axes: Axes, indices: Indices, order: "np.ndarray[tuple[int], np.dtype[np.intp]]"
) -> None:
    for shift, values, bounds, colour, label in (
        (-0.13, indices.first, indices.first_bounds, COLOURS["green"], "alone"),
        (0.13, indices.total, indices.total_bounds, COLOURS["vermilion"], "with others"),
    ):
        places = np.arange(len(order)) + shift
        axes.hlines(places, bounds[order, 0], bounds[order, 1], color=colour, linewidth=1.5)
        axes.plot(values[order], places, "o", color=colour, markersize=5, label=label)
    axes.update_datalim([(-0.05, 0.0), (1.05, 0.0)])
    axes.margins(x=0.05)
    axes.set_ylim(-0.6, len(order) - 0.4)
    axes.set_title("Share of the variance")
    axes.set_xlabel("Sobol index, with its 95 % interval")
