"""Axes that stay readable: crank angle with its dead centres, and values that impacts dwarf."""

import math
from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import NDArray

from exu_press.plots.style import GREY

__all__ = ["crank_angle_axis", "impact_scale", "widen"]

Array = NDArray[np.float64]

TICK_STEPS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360)  # deg
MOST_TICKS = 9
DWARFED = 6.0
"""An axis is logarithmic where its peak is more than this times what most of the run shows."""


def crank_angle_axis(panels: Iterable[Axes], low: float, high: float) -> None:
    """Give panels a common crank angle axis (deg) with the dead centres marked.

    The labels stand where matplotlib shows them: under the lowest of panels that share an axis.
    """
    high = max(high, low + 1e-3)
    spare = (step for step in TICK_STEPS if (high - low) / step < MOST_TICKS)
    step = next(spare, 360 * math.ceil((high - low) / 360 / MOST_TICKS))
    ticks = np.arange(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1) * step
    centres = np.arange(math.ceil(low / 180 - 1e-9), math.floor(high / 180 + 1e-9) + 1) * 180.0
    for axes in panels:
        axes.set_xlim(low, high)
        axes.xaxis.set_major_locator(FixedLocator(list(ticks)))
        axes.xaxis.set_major_formatter(FuncFormatter(_angle_text))
        for centre in centres:
            axes.axvline(centre, color=GREY, linewidth=0.9, linestyle=(0, (1, 2)), zorder=0.9)


def impact_scale(axes: Axes, curves: Iterable[tuple[Array, Array]], *, signed: bool) -> str:
    """Scale the values' axis so that both impacts and ordinary values can be read.

    Args:
        axes: what holds the curves.
        curves: crank angle (n,) and values (n,), in the axis' unit, of every run.
        signed: whether values are of either sign.

    Returns:
        What the scale is, in words; empty where it is linear.
    """
    peak, ordinary = 0.0, 0.0
    for angle, values in curves:
        uniform = np.abs(np.interp(np.linspace(angle[0], angle[-1], 2000), angle, values))
        peak = max(peak, float(np.abs(values).max()))
        if (moving := uniform[uniform > 1e-9 * peak]).size:
            ordinary = max(ordinary, float(np.median(moving)))
    if peak <= DWARFED * ordinary or ordinary == 0.0:
        if not signed:
            axes.set_ylim(0.0, 1.08 * peak or 1.0)
        return ""
    linear = 10.0 ** math.floor(math.log10(ordinary))
    top = 1.6 * peak
    decades = linear * 10.0 ** np.arange(math.floor(math.log10(top / linear)) + 1)
    axes.set_yscale("symlog", linthresh=linear, linscale=0.8)
    axes.set_ylim(-top if signed else 0.0, top)
    shown = decades[:: max(1, math.ceil(len(decades) / 4))] if signed else decades
    axes.yaxis.set_major_locator(
        FixedLocator([*(-shown[::-1] if signed else ()), 0.0, *shown])
    )
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}".replace("-", "−")))
    return f"linear to {linear:g}, logarithmic beyond"


def widen(axes: Axes, least: float) -> None:
    """Let a panel of deviations show at least +-least, so that rounding errors look like none."""
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, -least), max(high, least))


def _angle_text(degrees: float, _: int | None) -> str:
    """Return a tick's text, with the dead centre's name under it."""
    name = {0: "TDC", 180: "BDC"}.get(round(degrees, 6) % 360, "")
    return f"{degrees:g}\n{name}".rstrip()
