"""An optimum in one picture: objectives against each other, and the keys along the front."""

from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.numerics.arrays import Array
from exu_press.plots.legends import legend_outside
from exu_press.plots.palette import COLOURS, GREY, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.scales import log_axis
from exu_press.plots.style import with_style
from exu_press.plots.sweep_words import axis_label, in_unit, label_with_unit
from exu_press.plots.typesetting import wrap_text
from exu_press.plots.words import describe
from exu_press.quantities import quantity_of
from exu_press.studies.base import Range
from exu_press.studies.optimise.report import OptimiseReport

__all__ = ["front_figure"]

ACROSS = 3

WIDE = 3.0
"""Largest over least value from which an axis is logarithmic."""


@with_style
def front_figure(report: OptimiseReport) -> Figure:
    """Return a panel for each pair of objectives, and one for each key over the first objective.

    Of one objective: all points over each key.
    """
    study = report.study
    objectives = [objective.quantity for objective in study.objective]
    pairs = list(combinations(objectives, 2))
    ranged = [name for name, study_key in study.keys.items() if isinstance(study_key, Range)]
    count = len(pairs) + len(ranged)
    across = min(ACROSS, count)
    heading = "Objectives against each other" if pairs else "The objective over each key"
    text = f"{describe([study.scene], 110)}\n{report.run_summary[0]}; {report.method}"
    figure, panels = figure_with_panels(heading, text, grid_rows(count, across), 4.4, 3.3)
    for (first, second), panel in zip(pairs, panels, strict=False):
        _points(panel, report, _all(report, first), _all(report, second), (first, second))
        panel.set_xlabel(wrap_text(axis_label(first)))
    for name, panel in zip(ranged, panels[len(pairs) :], strict=True):
        values = np.array([float(point[name]) for point in report.trials.points])
        values_in_unit, unit = in_unit(name, values)
        _points(panel, report, values_in_unit, _all(report, objectives[0]), ("", objectives[0]))
        panel.set_xlabel(wrap_text(label_with_unit(name, unit)))
        study_key = study.keys[name]
        if isinstance(study_key, Range) and study_key.log:
            log_axis(panel, "x", values_in_unit)
    legend_outside(figure, panels[0].get_legend_handles_labels()[0], "upper right")
    return figure


def _all(report: OptimiseReport, quantity: str) -> Array:
    column = report.study.quantities.index(quantity)
    scale = quantity_of(report.study.scene, quantity).quantity.scale
    return np.asarray(report.trials.numbers[:, column] * scale)


def _points(
    panel: Axes, report: OptimiseReport, across: Array, up: Array, names: tuple[str, str]
) -> None:
    panel.plot(across, up, ".", color="0.75", markersize=4, label="tried")
    bars: dict[str, Any] = {}
    for side, name in zip(("xerr", "yerr"), names, strict=True):
        if name in report.errors:
            scale = quantity_of(report.study.scene, name).quantity.scale
            bars[side] = np.nan_to_num(report.errors[name]) * scale
    several = len(report.study.objective) > 1
    panel.errorbar(
        across[report.places], up[report.places], **bars, fmt="o", color=colour_of(0),
        markersize=4.5, ecolor=GREY, elinewidth=1.0,
        label="not worse in everything" if several else "best",
    )  # fmt: skip
    chosen_run = report.places[report.chosen]
    panel.plot(
        across[chosen_run], up[chosen_run], "D", color=COLOURS["vermilion"], markersize=7, zorder=5,
        label="chosen",
    )  # fmt: skip
    panel.margins(x=0.05, y=0.05)
    panel.set_ylabel(wrap_text(axis_label(names[1])))
    for which, values in (("x", across), ("y", up)):
        if (which == "y" or names[0]) and _wide(values):
            log_axis(panel, which, values)


def _wide(values: Array) -> bool:
    """Return whether positive values differ by more than WIDE."""
    finite = values[np.isfinite(values)]
    return len(finite) > 0 and finite.min() > 0.0 and finite.max() > WIDE * finite.min()
