"""The common parts of all pictures: title, curves over crank angle, legends beside the data."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.numerics.arrays import Array
from exu_press.plots.decimate import decimate
from exu_press.plots.panels import Rows, figure_with_panels, lowest_panels
from exu_press.plots.scales import crank_angle_axis
from exu_press.plots.style import points
from exu_press.plots.words import describe, early_stops
from exu_press.result import Result
from exu_press.scene import mechanism_of

__all__ = [
    "angle_axis",
    "angle_range",
    "angle_words",
    "crank_degrees",
    "curve",
    "dead_centres",
    "run_figure",
]

LETTERS = 162
"""Of the scene in words, in a line of the heading."""


def run_figure(
    heading: str, results: Mapping[str, Result], rows: Rows, *sizes: Any, **layout: Any
) -> tuple[Figure, list[Axes]]:
    """Return a figure of runs by label, 13 inch wide on a screen, and its panels.

    Below the heading are the scene in words, and why a run stopped early. All other arguments are
    those of `figure_with_panels`.
    """
    scenes = [result.scene for result in results.values()]
    lines = [describe(scenes, LETTERS), early_stops(results, LETTERS)]
    return figure_with_panels(heading, "\n".join(filter(None, lines)), rows, *sizes, **layout)


def crank_degrees(result: Result) -> Array:
    """Return the crank angle from top dead centre, going on over revolutions, (n,), deg."""
    return np.asarray(np.degrees(result["crank_angle"]))


def angle_range(results: Mapping[str, Result]) -> tuple[float, float]:
    """Return the crank angles (deg) between which there is something to see."""
    angles = [crank_degrees(result) for result in results.values()]
    return min(angle.min() for angle in angles), max(angle.max() for angle in angles)


def angle_axis(panels: Sequence[Axes], results: Mapping[str, Result]) -> None:
    """Give panels a common crank angle axis with the dead centres that all runs have.

    It is named below the lowest ones, with its numbers.
    """
    crank_angle_axis(panels, *angle_range(results), dead_centres(results))
    _lighten_start(panels, results)
    for axes in lowest_panels(panels):
        axes.set_xlabel(angle_words(results))
        axes.tick_params(labelbottom=True)


def _lighten_start(panels: Iterable[Axes], results: Mapping[str, Result]) -> None:
    """Cover the revolutions before those from which quantities are read."""
    settled = {result.scene.settle_revolutions for result in results.values()}
    begin, end = angle_range(results)
    if len(settled) == 1 and 0.0 < (turns := settled.pop()) < (end - begin) / 360.0:
        for axes in panels:
            axes.axvspan(begin, begin + 360.0 * turns, color="white", alpha=0.6, zorder=3, lw=0)


def angle_words(results: Mapping[str, Result]) -> str:
    """Return the zero of the crank angle in words, for an axis."""
    top = dead_centres(results).get("TDC")
    return f"crank angle{' from top dead centre' if top == 0.0 else ''}, deg"


def dead_centres(results: Mapping[str, Result]) -> dict[str, float]:
    """Return the ideal slider's dead centres, deg, where the mechanisms have the same."""
    angles = {mechanism_of(result.scene).dead_centres for result in results.values()}
    both = angles.pop() if len(angles) == 1 else None
    if both is None:
        return {}
    top, bottom = (round(float(np.degrees(angle)), 3) % 360.0 for angle in both)
    return {"TDC": top, "BDC": bottom}


def curve(axes: Axes, result: Result, values: Array, **line: Any) -> None:
    """Draw values (n,) over the crank angle; a cross ends the curve of a run that stopped early.

    Widths of lines are those on a screen.
    """
    if "linewidth" in line:
        line["linewidth"] = points(line["linewidth"])
    angle = crank_degrees(result)
    indices = decimate(angle, values)
    (drawn,) = axes.plot(angle[indices], values[indices], **{"solid_joinstyle": "round", **line})
    if not result.completed:
        axes.plot(
            angle[-1:],
            values[-1:],
            marker="X",
            markersize=points(8),
            color=drawn.get_color(),
            markeredgecolor="white",
            clip_on=False,
            zorder=5,
        )
