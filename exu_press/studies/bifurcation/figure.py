"""A bifurcation diagram over one key, or a map of periods and exponents over two."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from exu_press.numerics.arrays import Array
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import COLOURS, GREY, SHADE, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.scales import log_axis
from exu_press.plots.style import PATH_COLOURS, with_style
from exu_press.plots.sweep_words import in_unit, label_with_unit
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe
from exu_press.studies.base import Row
from exu_press.studies.bifurcation.report import BifurcationReport

__all__ = ["bifurcation_figure", "period_map_figure"]

MARKERS = {"up": "^", "down": "v", "from the start": "o"}

MOST_TICKS = 9


@with_style
def _diagram(report: BifurcationReport) -> Figure:
    """Return the diagram of one key: eccentricity on the section, period, exponent over it."""
    study, values = report.study, report.study.values
    own = study.bifurcation
    text = f"{describe([study.scene_at({study.name: v}) for v in values], 110)}\n"
    text += f"{own.revolutions} revolutions after {own.skip} at each of {len(values)} values"
    figure, (points, period, exponent) = figure_with_panels(
        "Bifurcation diagram", text, grid_rows(3, 1), 9.5, (4.1, 1.7, 2.0), sharex=True
    )
    handles = []
    positions, unit = in_unit(study.name, np.array(values))
    places = dict(zip(values, positions.tolist(), strict=True))
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
            known = row["period"] if row["decided"] else None
            at = known or study.bifurcation.longest + (1 if row["decided"] else 2)
            period.plot(value, at, marker, color=colour if row["decided"] else GREY)
            mean, low, high = row["exponent"]
            exponent.plot(value, mean, marker, color=colour, markersize=4)
            exponent.vlines(value, mean if low is None else low, high, color=colour, linewidth=1.0)
    last = own.longest
    ticks = list(range(1, last + 1))
    period.set_yticks([*ticks, last + 1, last + 2], [*map(str, ticks), "none", "undecided"])
    period.set_ylim(0.5, last + 2.5)
    period.set_ylabel("period")
    exponent.axhline(0.0, color=COLOURS["vermilion"], linewidth=0.9)
    exponent.set_ylabel("exponent per\nrevolution")
    points.set_ylabel("eccentricity x / clearance, first joint")
    points.legend(handles=handles, loc="best")
    points.margins(y=0.1)
    exponent.set_xlabel(plain(label_with_unit(study.name, unit)))
    if len(values) > 2 and values[0] > 0.0 and values[-1] > 10.0 * values[0]:
        log_axis(exponent, "x", positions)
    else:
        beside = 0.03 * float(np.ptp(positions)) or 0.05 * abs(float(positions[0])) or 1.0
        exponent.set_xlim(positions[0] - beside, positions[-1] + beside)
    return figure


def bifurcation_figure(report: BifurcationReport) -> Figure:
    """Return the diagram over one key, or the map over two."""
    return (_diagram if report.study.second is None else period_map_figure)(report)


@with_style
def period_map_figure(report: BifurcationReport) -> Figure:
    """Return a row of two maps for each way: the period, and the upper end of the exponent."""
    study = report.study
    assert study.second is not None
    points = [study.point_at(x, y) for y in study.seconds for x in study.values]
    text = f"{describe([study.scene_at(point) for point in points], 110)}\n"
    own = study.bifurcation
    text += f"{own.revolutions} revolutions after {own.skip} at each of {len(points)}"
    text += " points; the exponent is the upper end of its interval"
    ends = [row["exponent"][2] for branch in report.branches for row in branch.rows
            if row["status"] == "completed"]  # fmt: skip
    most = max(map(abs, ends), default=0.0) or 1.0
    figure, panels = figure_with_panels(
        "Map of periods", text, grid_rows(2 * len(report.ways), 2), 5.75, 4.5
    )
    for direction, periods, exponents in zip(report.ways, panels[::2], panels[1::2], strict=True):
        rows = [branch for branch in report.branches if branch.name == direction]
        ordered = [
            [point for _, point in sorted(branch, key=lambda item: item[0])] for branch in rows
        ]
        _periods(periods, ordered, study.bifurcation.longest)
        exponents_shown = _exponents(exponents, ordered, most)
        figure.colorbar(exponents_shown, ax=exponents, label="exponent per revolution")
        for panel, title in ((periods, "period"), (exponents, "largest exponent")):
            panel.set_title(f"{title}, {direction}")
            panel.grid(visible=False)
            _axis(panel, "x", study.name, np.array(study.values))
            _axis(panel, "y", study.second, np.array(study.seconds, dtype=float))
    return figure


def _periods(panel: Axes, rows: list[list[Row]], longest: int) -> None:
    """Draw each period in its colour, with its number; "-" is none, "?" undecided, "x" failed."""
    colours = [*PATH_COLOURS(np.linspace(0.25, 1.0, longest)), COLOURS["vermilion"], "w", SHADE]
    signs = [*map(str, range(1, longest + 1)), "-", "?", "x"]
    numbers = np.array([[_colour_index(row, longest) for row in line] for line in rows])
    panel.imshow(
        numbers, origin="lower", aspect="auto", cmap=ListedColormap(colours),
        vmin=-0.5, vmax=len(colours) - 0.5,
    )  # fmt: skip
    if numbers.size <= 400:
        for (y, x), number in np.ndenumerate(numbers):
            panel.text(
                x, y, signs[number], ha="center", va="center",
                bbox={"facecolor": "w", "edgecolor": "none", "alpha": 0.7, "pad": 2.0},
            )  # fmt: skip
    meanings = [
        *(f"{n + 1}" for n in range(longest)),
        f"none up to {longest}",
        "undecided",
        "failed",
    ]
    there = sorted(set(numbers.ravel().tolist()))
    handles = [
        Patch(facecolor=colours[n], edgecolor="k", label=f"{signs[n]}: {meanings[n]}"
              if n >= longest else meanings[n], linewidth=0.4)
        for n in there
    ]  # fmt: skip
    legend_above(panel, handles=handles)


def _colour_index(row: Row, longest: int) -> int:
    if row["status"] != "completed":
        return longest + 2
    if not row["decided"]:
        return longest + 1
    return int(row["period"] or longest + 1) - 1


def _exponents(panel: Axes, rows: list[list[Row]], most: float) -> AxesImage:
    """Draw the upper end of each exponent: red is chaos."""
    exponents: Array = np.array(
        [[row["exponent"][2] if row["status"] == "completed" else np.nan for row in line]
         for line in rows]
    )  # fmt: skip
    panel.set_facecolor(SHADE)
    return panel.imshow(
        exponents, origin="lower", aspect="auto", cmap="RdBu_r", norm=TwoSlopeNorm(0.0, -most, most)
    )


def _axis(panel: Axes, which: str, name: str, values: Array) -> None:
    """Write a key's values along an axis; the cells are even, whatever lies between them."""
    numbers, unit = in_unit(name, values)
    every = -(-len(numbers) // MOST_TICKS)
    ticks = np.arange(0, len(numbers), every)
    label = plain(label_with_unit(name, unit))
    panel.set(**{f"{which}ticks": ticks, f"{which}label": label})
    panel.set(**{f"{which}ticklabels": [f"{numbers[k]:.4g}" for k in ticks]})
