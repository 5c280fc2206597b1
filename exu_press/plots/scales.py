"""Axes that stay readable: crank angle with its dead centres, and values that impacts dwarf."""

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from exu_press.numerics.arrays import Array
from exu_press.plots.decimate import distance_travelled
from exu_press.plots.palette import GREY, SHADE
from exu_press.plots.style import points

__all__ = [
    "BAR",
    "angle_ticks",
    "contain_bars",
    "crank_angle_axis",
    "draw_bar",
    "impact_scale",
    "log_axis",
    "note",
    "spread",
    "widen",
]

TICK_STEPS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360)  # deg
MOST_CENTRES = 100
"""More dead centres than this would hide the curves; they are not marked."""

TOO_CLOSE = 0.6
"""Distance over that of the ticks: so near a dead centre none stands."""

SLACK = 1e-4
"""Distance over an axis' length by which a tick may lie beyond its ends."""

BAR = "_error bar"
"""Label of an error bar, which no legend shows."""

BEYOND = 1.05
"""Share of an error bar's end to which an axis goes."""

DWARFED = 6.0
"""An axis is logarithmic where its peak is more than this times the 90th percentile of values."""


def crank_angle_axis(
    panels: Iterable[Axes], low: float, high: float, centres: Mapping[str, float]
) -> None:
    """Give panels a common crank angle axis (deg) with the dead centres marked, unless many.

    A dead centre between two ticks takes the place of those that are close.

    Args:
        panels: with a label or without.
        low: where the curves begin.
        high: where they end.
        centres: name -> crank angle of a dead centre, in every revolution; none where the mechanism
            has none.

    The labels stand where matplotlib shows them: under the lowest of panels that share an axis.
    The axis goes on to a tick that is just beyond its end: a flexible crank's angle, bent as it is,
    lags by some thousandths of a degree at the end of a revolution.
    """
    high = max(high, low + 1e-3)
    slack = SLACK * (high - low)
    ticks = angle_ticks(low - slack, high + slack)
    low, high = min([low, *ticks]), max([high, *ticks])
    named: dict[float, str] = {}
    if high - low < 180.0 * MOST_CENTRES:
        for name, angle in centres.items():
            named |= {angle + turn: name for turn in _multiples(360.0, low - angle, high - angle)}
    step = float(np.diff(ticks).min()) if len(ticks) > 1 else high - low
    tick_at = [*ticks]
    if step <= 90.0:
        near = TOO_CLOSE * step
        tick_at = [tick for tick in ticks if all(abs(tick - at) > near for at in named)] + [*named]
    texts = {at: f"{_number_text(round(at, 1), None)}\n{name}" for at, name in named.items()}

    def text(angle: float, _: int | None) -> str:
        return texts.get(angle) or _number_text(angle, None)

    for axes in panels:
        axes.set_xlim(low, high)
        axes.xaxis.set_major_locator(FixedLocator(sorted(tick_at)))
        axes.xaxis.set_major_formatter(FuncFormatter(text))
        lines = LineCollection(
            [[(centre, 0.0), (centre, 1.0)] for centre in named],
            transform=axes.get_xaxis_transform(),
            colors=GREY,
            linewidths=0.9,
            linestyles=(0, (1, 2)),
            zorder=0.9,
        )
        axes.add_collection(lines, autolim=False)


def angle_ticks(low: float, high: float, most: int = 9) -> Array:
    """Return at most so many round crank angles between two, deg."""
    spare = (step for step in TICK_STEPS if (high - low) / step < most)
    return _multiples(next(spare, 360.0 * math.ceil((high - low) / 360 / most)), low, high)


def impact_scale(axes: Axes, curves: Iterable[tuple[Array, Array]], *, signed: bool) -> str:
    """Scale the values' axis so that both impacts and ordinary values can be read.

    Linear as long as that does it, else linear up to the 90th percentile and logarithmic
    beyond (symlog).

    Args:
        axes: of the curves.
        curves: crank angle (n,) and values (n,), in the axis' unit, of every run.
        signed: whether values are of either sign.

    Returns:
        The scale in words; empty where it is linear.
    """
    peak, ordinary = 0.0, 0.0
    for angle, values in curves:
        path_length = distance_travelled(angle)
        uniform = np.interp(np.linspace(0.0, path_length[-1], 2000), path_length, values)
        ordinary = max(ordinary, float(np.percentile(np.abs(uniform), 90)))
        peak = max(peak, float(np.abs(values).max()))
    if peak <= DWARFED * ordinary or ordinary == 0.0:
        if not signed:
            axes.set_ylim(0.0, 1.08 * peak or 1.0)
        return ""
    linear, top = _round_up(ordinary), 1.6 * peak
    axes.set_yscale("symlog", linthresh=linear, linscale=1.2)
    axes.set_ylim(-top if signed else 0.0, top)
    ticks = np.array([linear / 2, linear, *_log_ticks(linear, top, signed=signed)])
    axes.yaxis.set_major_locator(FixedLocator([*(-ticks[::-1] if signed else ()), 0.0, *ticks]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(_number_text))
    axes.axhspan(-linear if signed else 0.0, linear, color=SHADE, linewidth=0, zorder=0.5)
    return f"logarithmic beyond {linear:g}"


def widen(axes: Axes, least: float) -> None:
    """Let a panel of deviations show at least +-least, so that rounding errors look like none."""
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, -least), max(high, least))


def note(axes: Axes, *texts: str) -> None:
    """Write notes on the scale over a panel's right end; empty texts are left out."""
    words = "; ".join(filter(None, texts))
    axes.set_title(words, loc="right", fontsize=points(8.5), fontweight="normal", color=GREY)


def draw_bar(axes: Axes, x: float, ends: Array, colour: str) -> None:
    """Draw an error bar between two values (2,), as one line, which takes a fifth of the time."""
    axes.plot(
        [x, x],
        ends,
        color=colour,
        marker="_",
        markersize=points(6.0),
        linewidth=points(1.4),
        label=BAR,
        zorder=4,
    )


def contain_bars(axes: Axes) -> None:
    """Let the values' axis reach as far as error bars do."""
    bars = [line.get_ydata() for line in axes.lines if line.get_label() == BAR]
    ends = [float(end) for bar in bars for end in np.asarray(bar)]
    if ends:
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, BEYOND * min(ends)), max(high, BEYOND * max(ends)))


def _log_ticks(above: float, top: float, *, signed: bool) -> Array:
    """Return ticks between two values: decades, or 1-2-5 where those are too few; none too close.

    A signed axis has half the room: of 1-2-5 it shows every other one.
    """
    nearest, most = (2.5, 2) if signed else (1.9, 4)
    decades = 10.0 ** np.arange(math.floor(math.log10(above)), math.ceil(math.log10(top)))
    for steps in ((1.0,), (1.0, 2.0, 5.0)):
        ticks = np.outer(decades, steps).ravel()
        ticks = ticks[(ticks > nearest * above) & (ticks < top)]
        if len(ticks) > 1:
            break
    stride = 2 if signed and len(steps) > 1 else max(1, math.ceil(len(ticks) / most))
    return np.asarray(ticks[::-1][::stride][::-1])


def _multiples(step: float, low: float, high: float) -> Array:
    """Return the multiples of a step from low to high, both included."""
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return np.asarray(step * np.arange(first, last + 1), dtype=float)


def _round_up(value: float) -> float:
    """Return the next of 1, 2, 5, 10, ..."""
    decade = 10.0 ** math.floor(math.log10(value))
    return next(float(m * decade) for m in (1, 2, 5, 10) if m * decade >= 0.999 * value)


def _number_text(value: float, _: int | None) -> str:
    """Return a tick's text with a typographic minus."""
    return f"{value:g}".replace("-", "\N{MINUS SIGN}")


def log_axis(panel: Axes, which: str, values: Array) -> None:
    """Make one axis logarithmic, with few ticks, written out.

    Args:
        panel: of the picture.
        which: "x" or "y".
        values: positive, that it is to show.
    """
    finite = values[np.isfinite(values)]
    low, high = float(finite.min()), float(finite.max())
    decades = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)
    steps = (1, 2, 5) if high > 10.0 * low else (1, 1.5, 2, 3, 4, 5, 7)
    ticks = [step * 10.0**n for n in decades for step in steps]
    axis = panel.xaxis if which == "x" else panel.yaxis
    (panel.set_xscale if which == "x" else panel.set_yscale)("log")
    axis.set_major_locator(FixedLocator([t for t in ticks if 0.9 * low <= t <= 1.1 * high]))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    (panel.set_xlim if which == "x" else panel.set_ylim)(low / 1.08, high * 1.08)


def spread(heights: Iterable[float], sizes: Sequence[float]) -> list[float]:
    """Return heights of things of some sizes moved apart so that none overlap, in their order."""
    desired = np.array(list(heights))
    order = np.argsort(desired)
    placed, size = desired[order], np.asarray(sizes)[order]
    distance = 0.5 * (size[1:] + size[:-1])
    for _ in range(200):
        short = np.flatnonzero(np.diff(placed) < distance * (1 - 1e-6))
        if not len(short):
            break
        for index in short:
            push = 0.5 * (distance[index] - (placed[index + 1] - placed[index]))
            placed[index] -= push
            placed[index + 1] += push
    spaced = np.empty_like(placed)
    spaced[order] = placed
    return [float(value) for value in spaced]
