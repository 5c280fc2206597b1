"""Every published number in one picture: ours over the paper's."""

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from exu_press.plots.style import COLOURS, GREY, RUN, styled
from paper.comparison import DATUM
from paper.plots.drawing import headed_figure, plain_logarithm
from paper.rows import AGREES_WITHIN, Row

__all__ = ["numbers_figure"]

MODELS: dict[str, tuple[str, dict[str, Any]]] = {
    "mean_1ms": ("mean over 1 ms (judged)", {"color": RUN, "marker": "o", "markersize": 8}),
    "differentiated_1khz": ("1 kHz, differentiated", {"color": COLOURS["sky blue"], "marker": "s"}),
    "resolved": ("as resolved", {"color": GREY, "marker": "^"}),
}


@styled
def numbers_figure(rows: Sequence[Row]) -> Figure:
    """Return the ratio of every number, under each model of observation, on one axis."""
    numbers = [row for row in rows if row.kind != "trend" and row.ratio is not None]
    words = (
        f"green: within {100 * AGREES_WITHIN:.0f} %; bottom dead centres by how far they lie below "
        "the ideal one"
    )
    title = "Ours over the paper's"
    figure = headed_figure(title, words, (10.5, 0.27 * len(numbers) + 1.8))
    axes = figure.subplots()
    for place, row in enumerate(numbers):
        for model, (label, look) in reversed(MODELS.items()):
            ratio = _ratio(row, model)
            if ratio is not None:
                axes.plot([ratio], [place], linestyle="none", **look, label=label)
    axes.set_xscale("log")
    low, high = 1.0 - AGREES_WITHIN, 1.0 + AGREES_WITHIN
    axes.axvspan(low, high, color=COLOURS["green"], alpha=0.16, linewidth=0, zorder=0)
    axes.axvline(1.0, color=COLOURS["green"], linewidth=1.6, zorder=0.7)
    left, right = axes.get_xlim()
    axes.set_xlim(left / 1.5, right * 1.5)
    plain_logarithm(axes.xaxis, math.log10(2.25 * right / left))
    labels = [f"{row.quantity} ({row.figure})" for row in numbers]
    axes.set_yticks(range(len(numbers)), labels, fontsize=8.5)
    axes.set_ylim(len(numbers) - 0.4, -0.6)
    axes.set_xlabel("ratio, ours to the paper's")
    handles = dict(zip(*axes.get_legend_handles_labels()[::-1], strict=True))
    figure.legend(
        [handles[label] for label, _ in MODELS.values() if label in handles],
        [label for label, _ in MODELS.values() if label in handles],
        loc="outside lower center",
        ncols=3,
    )
    return figure


def _ratio(row: Row, model: str) -> float | None:
    """Return a row's ratio under a model; the row's own for what has no model."""
    value = getattr(row, model)
    if row.kind in ("frequency", "choice") or row.name == "bottom_dead_centre_ideal":
        return row.ratio if model == "mean_1ms" else None
    if value is None or isinstance(value, tuple) or isinstance(row.published, str):
        return None
    if row.name.startswith("bottom_dead_centre"):
        return float((DATUM - value) / (DATUM - row.published))
    return float(value / row.published)
