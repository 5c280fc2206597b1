"""The energy balance over crank angle."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.plots.busiest import joint_titles
from exu_press.plots.canvas import angle_axis, curve, run_figure
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import GREY, colour_of
from exu_press.plots.scales import note
from exu_press.plots.style import with_style
from exu_press.plots.typesetting import shorten
from exu_press.quantities.energy import energy_residual
from exu_press.result import Result

__all__ = ["energy_figure"]

MINUS = " \N{MINUS SIGN} "

MOST_LOSSES = 6
"""Joints whose losses are drawn, the largest ones."""

LEGEND_ROW = 0.11
"""Share of the panel's height that a row of its legend takes."""

LEGEND_LETTERS = 26
"""Of a name, of which two stand in a row."""

BALANCE_LINES: dict[str, dict[str, Any]] = {
    "energy_input": {"label": "put in"},
    "energy_stored": {"label": "stored", "linestyle": (0, (5, 1.5))},
    "energy_dissipated": {"label": "dissipated"},
}
COLOUR_NUMBERS = 0, 2, 3
"""Of these lines in the palette."""


@with_style
def energy_figure(result: Result) -> Figure:
    """Return the energy balance of a run since its start, J.

    Work of drive and loads, change of the stored energy and dissipated energy; the losses of each
    joint (not where none can dissipate); and the residual, the error of the integration.
    """
    dissipates = any(name.endswith("_loss") for name in result)
    rows = [[0, 1], [0, 2]] if dissipates else [[0, 1]]
    figure, panels = run_figure(
        "Energy balance since the start",
        {"": result},
        rows,
        (7.2, 5.8),
        5.2 / len(rows),
        sharex=True,
    )
    balance, *losses, residual = panels
    for (name, line), number in zip(BALANCE_LINES.items(), COLOUR_NUMBERS, strict=True):
        if dissipates or name != "energy_dissipated":
            curve(balance, result, result[name], color=colour_of(number), linewidth=1.6, **line)
    balance.set(title="Balance", ylabel="energy, J")
    legend_above(balance)
    _residual(residual, result)
    for axes in losses:
        _losses(axes, result)
    angle_axis(panels, {"": result})
    return figure


def _losses(axes: Axes, result: Result) -> None:
    """Draw each joint's dissipated energy; two balls that do the same, guides, modes as one."""
    names = [name.removesuffix("_loss") for name in result if name.endswith("_loss")]
    not_joints = [name for name in names if name not in result.joints]
    modes = [name for name in not_joints if name.endswith("_modes")]
    together = {
        "guides": [name for name in not_joints if name not in modes],
        "damping of modes": modes,
    }
    order = sorted(result.clearance_joints, key=lambda n: (result.joints[n].spherical, n))
    titles = joint_titles([result], order, "loss")
    most = sorted(titles, key=lambda name: -float(result[f"{name}_loss"][-1]))[:MOST_LOSSES]
    drawn = {name: title for name, title in titles.items() if name in most}
    sides = sum(title.endswith("each side") for title in drawn.values())
    rest = len(order) - len(drawn) - sides
    for index, (name, title) in enumerate(drawn.items()):
        lost = result[f"{name}_loss"]
        words = shorten(title[0].lower() + title[1:], LEGEND_LETTERS)
        curve(axes, result, lost, color=colour_of(index), linewidth=1.4, label=words)
    for style, (label, several) in zip(("-", (0, (5, 1.5))), together.items(), strict=True):
        if several:
            lost = np.sum([result[f"{name}_loss"] for name in several], axis=0)
            curve(axes, result, lost, color=GREY, linewidth=1.4, linestyle=style, label=label)
    axes.set(title="Dissipated in", ylabel="energy, J")
    if rest:
        note(axes, f"not drawn, as they dissipate less: {rest}")
    legend = axes.legend(loc="upper left", ncols=2, columnspacing=1.3)
    taken = LEGEND_ROW * math.ceil(len(legend.get_texts()) / 2)
    low, high = axes.get_ylim()
    axes.set_ylim(low, low + (high - low) / (1.0 - taken))


def _residual(axes: Axes, result: Result) -> None:
    put_in, stored, dissipated = (result[name] for name in BALANCE_LINES)
    residual, relative = put_in - stored - dissipated, energy_residual(result)
    worst = float(np.abs(residual).max())
    unit, scale = ("J", 1.0) if worst > 0.1 else ("mJ", 1e3)
    curve(axes, result, scale * residual, color=GREY, linewidth=1.0)
    axes.set(title="Residual", ylabel=f"put in{MINUS}stored{MINUS}dissipated, {unit}")
    if relative is not None:
        note(axes, f"at most {relative:.1e} of the largest energy")
