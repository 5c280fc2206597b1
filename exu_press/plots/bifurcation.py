"""A bifurcation diagram: sections over a key, the period in colours, the exponent below."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from exu_press.plots.headed import headed_figure
from exu_press.plots.period_map import period_map_figure
from exu_press.plots.scales import log_axis
from exu_press.plots.style import COLOURS, GREY, colour_of, styled
from exu_press.plots.sweep_words import in_unit, words
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe
from exu_press.studies.bifurcation import Report

__all__ = ["bifurcation_figure", "bifurcation_figures"]

MARKERS = {"up": "^", "down": "v", "from the start": "o"}


@styled
def bifurcation_figure(report: Report) -> Figure:
    """Return the diagram of one key: eccentricity on the section, period, exponent over it."""
    study, values = report.study, report.study.values
    own = study.bifurcation
    text = f"{describe([study.scene_at({study.name: v}) for v in values], 110)}\n"
    text += f"{own.revolutions} revolutions after {own.skip} at each of {len(values)} values"
    figure = headed_figure("Bifurcation diagram", text, (9.5, 9.0))
    points, period, exponent = figure.subplots(3, 1, sharex=True, height_ratios=[3.0, 1.2, 1.5])
    handles = []
    shown, unit = in_unit(study.name, np.array(values))
    places = dict(zip(values, shown.tolist(), strict=True))
    for number, branch in enumerate(report.branches):
        colour, marker = colour_of(number), MARKERS[branch.name]
        handles.append(Line2D([], [], linestyle="", marker=marker, color=colour, label=branch.name))
        for key, row in branch:
            value = places[key]
            if row["status"] != "completed":
                points.axvline(value, color=GREY, linestyle=":")
                continue
            section = np.array(row["points"])
            points.plot(
                np.full(len(section), value), section[:, 0], marker, color=colour, markersize=3,
                linestyle="", alpha=0.7,
            )  # fmt: skip
            told = row["period"] if row["told"] else None
            at = told or study.bifurcation.longest + (1 if row["told"] else 2)
            period.plot(value, at, marker, color=colour if row["told"] else GREY)
            mean, low, high = row["exponent"]
            exponent.plot(value, mean, marker, color=colour, markersize=4)
            exponent.vlines(value, mean if low is None else low, high, color=colour, linewidth=1.0)
    last = own.longest
    ticks = list(range(1, last + 1))
    period.set_yticks([*ticks, last + 1, last + 2], [*map(str, ticks), "none", "not told"])
    period.set_ylim(0.5, last + 2.5)
    period.set_ylabel("period")
    exponent.axhline(0.0, color=COLOURS["vermilion"], linewidth=0.9)
    exponent.set_ylabel("exponent per\nrevolution")
    points.set_ylabel("eccentricity x / clearance, first joint")
    points.legend(handles=handles, loc="best")
    points.margins(y=0.1)
    label = words(study.name)
    exponent.set_xlabel(plain(f"{label}, {unit}" if unit else label))
    if len(values) > 2 and values[0] > 0.0 and values[-1] > 10.0 * values[0]:
        log_axis(exponent, "x", shown)
    else:
        beside = 0.03 * float(np.ptp(shown)) or 0.05 * abs(float(shown[0])) or 1.0
        exponent.set_xlim(shown[0] - beside, shown[-1] + beside)
    return figure


def bifurcation_figures(report: Report) -> dict[str, Figure]:
    """Return the diagram over one key, or the map over two, by its name."""
    figure = bifurcation_figure if report.study.second is None else period_map_figure
    return {"bifurcation": figure(report)}
