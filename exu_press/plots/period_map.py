"""A map of periods over two keys, and of the exponent: a cell a run."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Patch

from exu_press.numerics.arrays import Array
from exu_press.plots.headed import headed_figure
from exu_press.plots.style import COLOURS, PATH_COLOURS, SHADE, styled
from exu_press.plots.sweep_words import in_unit, words
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe
from exu_press.studies.base import Row
from exu_press.studies.bifurcation import Report

__all__ = ["period_map_figure"]

MOST_TICKS = 9


@styled
def period_map_figure(report: Report) -> Figure:
    """Return a row of two maps for each way: the period, and the upper end of the exponent."""
    study = report.study
    assert study.second is not None
    points = [study.at(x, y) for y in study.seconds for x in study.values]
    text = f"{describe([study.scene_at(point) for point in points], 110)}\n"
    own = study.bifurcation
    text += f"{own.revolutions} revolutions after {own.skip} at each of {len(points)}"
    text += " points; the exponent is the upper end of its interval"
    figure = headed_figure("Map of periods", text, (11.5, 1.8 + 4.2 * len(report.ways)))
    ends = [row["exponent"][2] for branch in report.branches for row in branch.rows
            if row["status"] == "completed"]  # fmt: skip
    most = max(map(abs, ends), default=0.0) or 1.0
    panels = figure.subplots(len(report.ways), 2, squeeze=False)
    for row, way in enumerate(report.ways):
        rows = [branch for branch in report.branches if branch.name == way]
        ordered = [[one for _, one in sorted(branch, key=lambda at: at[0])] for branch in rows]
        periods, exponents = panels[row]
        _periods(periods, ordered, study.bifurcation.longest)
        exponents_shown = _exponents(exponents, ordered, most)
        figure.colorbar(exponents_shown, ax=exponents, label="exponent per revolution")
        for panel, title in ((periods, "period"), (exponents, "largest exponent")):
            panel.set_title(f"{title}, {way}")
            panel.grid(visible=False)
            _axis(panel, "x", study.name, np.array(study.values))
            _axis(panel, "y", study.second, np.array(study.seconds, dtype=float))
    return figure


def _periods(panel: Axes, rows: list[list[Row]], longest: int) -> None:
    """Draw each period in its colour, with its number; "-" is none, "?" not told, "x" failed."""
    colours = [*PATH_COLOURS(np.linspace(0.25, 1.0, longest)), COLOURS["vermilion"], "w", SHADE]
    signs = [*map(str, range(1, longest + 1)), "-", "?", "x"]
    numbers = np.array([[_place(row, longest) for row in line] for line in rows])
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
    told = [*(f"{n + 1}" for n in range(longest)), f"none up to {longest}", "not told", "failed"]
    there = sorted(set(numbers.ravel().tolist()))
    handles = [
        Patch(facecolor=colours[n], edgecolor="k", label=f"{signs[n]}: {told[n]}" if n >= longest
              else told[n], linewidth=0.4)
        for n in there
    ]  # fmt: skip
    panel.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.08), ncols=4, borderaxespad=0.0
    )


def _place(row: Row, longest: int) -> int:
    """Return which colour a run has."""
    if row["status"] != "completed":
        return longest + 2
    if not row["told"]:
        return longest + 1
    return int(row["period"] or longest + 1) - 1


def _exponents(panel: Axes, rows: list[list[Row]], most: float) -> AxesImage:
    """Draw the upper end of each exponent: red is chaos."""
    found: Array = np.array(
        [[row["exponent"][2] if row["status"] == "completed" else np.nan for row in line]
         for line in rows]
    )  # fmt: skip
    panel.set_facecolor(SHADE)
    return panel.imshow(
        found, origin="lower", aspect="auto", cmap="RdBu_r", norm=TwoSlopeNorm(0.0, -most, most)
    )


def _axis(panel: Axes, which: str, name: str, values: Array) -> None:
    """Write a key's values along an axis; the cells are even, whatever lies between them."""
    numbers, unit = in_unit(name, values)
    every = -(-len(numbers) // MOST_TICKS)
    ticks = np.arange(0, len(numbers), every)
    label = plain(f"{words(name)}, {unit}" if unit else words(name))
    panel.set(**{f"{which}ticks": ticks, f"{which}label": label})
    panel.set(**{f"{which}ticklabels": [f"{numbers[k]:.4g}" for k in ticks]})
