"""The computed peaks over the paper's, with both readings of the damping."""

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.plots.style import COLOURS, RUN, styled
from paper.plots.drawing import headed_figure, plain_logarithm
from paper.readings import MODELS
from paper.report import Findings
from paper.rows import AGREES_WITHIN

__all__ = ["side_by_side_figure"]

LOOKS: tuple[dict[str, Any], ...] = (
    {"color": COLOURS["vermilion"], "marker": "o"},
    {"color": RUN, "marker": "D"},
)
TITLES = {
    "resolved": "as resolved",
    "mean_1ms": "mean over 1 ms",
    "differentiated_1khz": "1 kHz, differentiated",
}
SHIFT = 0.13
"""Of the two readings from their line's middle."""


@styled
def side_by_side_figure(findings: Sequence[Findings]) -> Figure:
    """Return ours over the paper's: a row of panels a kind of bodies, a column a reading."""
    kinds = [peaks.bodies for peaks in findings[0].peaks]
    words = (
        f"ours over the paper's, last revolution  ·  green: within {100 * AGREES_WITHIN:.0f} %  ·  "
        "in the titles: root mean square of the logarithms, by reading"
    )
    size = (13.0, 3.3 * len(kinds) + 1.2)
    figure = headed_figure("Peak accelerations, Table 2's damping read twice", words, size)
    panels = figure.subplots(len(kinds), len(MODELS), squeeze=False, sharex=True, sharey=True)
    ends = [1.0]
    for row, bodies in enumerate(kinds):
        for column, model in enumerate(MODELS):
            axes = panels[row, column]
            distances = []
            for index, found in enumerate(findings):
                peaks = found.peaks[row]
                pairs = zip(peaks.values[model], peaks.numbers, strict=True)
                ratios = [math.nan if v is None else v / n.published for v, n in pairs]
                places = [i + (2 * index - 1) * SHIFT for i in range(len(ratios))]
                label = f"c_max = {found.damping} N s/m"
                axes.plot(ratios, places, linestyle="none", label=label, **LOOKS[index])
                distance = peaks.distances(peaks.values)[model]
                distances.append("-" if distance is None else f"{distance:.2f}")
                ends += [ratio for ratio in ratios if not math.isnan(ratio)]
            axes.axvspan(1 - AGREES_WITHIN, 1 + AGREES_WITHIN, color=COLOURS["green"], alpha=0.16)
            axes.axvline(1.0, color=COLOURS["green"], linewidth=1.6, zorder=0.7)
            axes.set_title(f"{bodies}, {TITLES[model]}: {' and '.join(distances)}", fontsize=10)
    _scales(panels, findings[0], min(ends) / 1.3, max(ends) * 1.3)
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
    return figure


def _scales(panels: NDArray[Any], found: Findings, left: float, right: float) -> None:
    """Name the peaks, and set the ratio's axis."""
    numbers = found.peaks[0].numbers
    names = [n.quantity.removeprefix("peak acceleration, ") for n in numbers]
    labels = [f"{name} ({n.figure})" for name, n in zip(names, numbers, strict=True)]
    for axes in panels[:, 0]:
        axes.set_yticks(range(len(labels)), labels, fontsize=8.5)
        axes.set_ylim(len(labels) - 0.4, -0.6)
    for axes in panels.flat:
        axes.set_xscale("log")
        axes.set_xlim(left, right)
        plain_logarithm(axes.xaxis, math.log10(right / left))
    for axes in panels[-1]:
        axes.set_xlabel("ratio, ours to the paper's")
