"""Which assumption moves which number: a small tornado for each."""

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.plots.style import COLOURS, GREY, RUN, styled
from paper.plots.drawing import headed_figure, plain_logarithm
from paper.rows import AGREES_WITHIN
from paper.sensitivity import Effect, Tornado

__all__ = ["tornado_figure"]

MOST_FACTORS = 9
"""Factors shown of each number, the largest swings."""

UNNAMED = 0.01
"""Smallest relative change whose setting is named."""

DECADES = 4.0
"""An axis is logarithmic where values differ by more than this factor."""

WIDTH = 5.3  # inch, of a panel


@styled
def tornado_figure(title: str, tornados: Sequence[Tornado]) -> Figure:
    """Return a panel for each number: bars from our value to what each assumption makes of it.

    The green band is what would agree with the paper.
    """
    columns = min(3, len(tornados))
    rows = -(-len(tornados) // columns)
    words = (
        "bars: our value with one assumption changed, what it is changed to at the bar's end  ·  "
        "black: as they are by default  ·  green: within 25 % of the paper"
    )
    figure = headed_figure(title, words, (WIDTH * columns + 0.4, 3.7 * rows + 0.9))
    panels = figure.subplots(rows, columns, squeeze=False)
    for axes, tornado in zip(panels.flat, tornados, strict=False):
        _draw(axes, tornado)
    for axes in list(panels.flat)[len(tornados) :]:
        axes.remove()
    return figure


def _draw(axes: Axes, tornado: Tornado) -> None:
    factors = list(tornado.factors().items())[:MOST_FACTORS]
    scale, unit = _unit(tornado)
    start = scale * tornado.baseline
    ends = [start, scale * tornado.published]
    for place, (_, effects) in enumerate(factors):
        known = [(scale * effect.value, effect) for effect in effects if effect.value is not None]
        outermost = min(known, key=_value, default=None), max(known, key=_value, default=None)
        for end, effect in known:
            ends.append(end)
            outer = (end, effect) == outermost[1 if end > start else 0]
            named = outer and abs(end / start - 1.0) > UNNAMED
            _bar(axes, place, start, end, effect.label if named else "")
    _limits(axes, ends)
    aim = scale * tornado.published
    low, high = aim * (1.0 - AGREES_WITHIN), aim * (1.0 + AGREES_WITHIN)
    axes.axvspan(low, high, color=COLOURS["green"], linewidth=0, alpha=0.16, zorder=0)
    axes.axvline(aim, color=COLOURS["green"], linewidth=1.6, zorder=0.7)
    axes.axvline(start, color="black", linewidth=1.2, zorder=3)
    axes.set_yticks(range(len(factors)), [factor for factor, _ in factors], fontsize=8)
    axes.set_ylim(len(factors) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_title(tornado.number.quantity, fontsize=9.5, loc="right")
    axes.set_xlabel(f"{unit}; ours {start:.4g}, paper {aim:.4g}", fontsize=8.5)


def _value(known: tuple[float, Effect]) -> float:
    return known[0]


def _bar(axes: Axes, place: int, start: float, end: float, label: str) -> None:
    up = end >= start
    colour = COLOURS["vermilion"] if up else RUN
    axes.barh(place, end - start, left=start, height=0.62, color=colour, alpha=0.45, linewidth=0)
    axes.plot([end], [place], marker="|", markersize=9, markeredgewidth=1.4, color=colour)
    axes.annotate(
        label,
        (end, place),
        xytext=(4 if up else -4, 0),
        textcoords="offset points",
        ha="left" if up else "right",
        va="center",
        fontsize=7.5,
        color=GREY,
        annotation_clip=True,
    )


def _limits(axes: Axes, ends: Sequence[float]) -> None:
    """Leave room for the labels at the bars' ends."""
    low, high = min(ends), max(ends)
    if low > 0.0 and high > DECADES * low:
        room = (high / low) ** 0.42
        axes.set_xscale("log")
        axes.set_xlim(low / room, high * room)
        plain_logarithm(axes.xaxis, math.log10(room * room * high / low))
    else:
        room = 0.42 * (high - low) or 1.0
        axes.set_xlim(low - room, high + room)


def _unit(tornado: Tornado) -> tuple[float, str]:
    """Return the factor from SI to what is shown, and its unit."""
    if tornado.number.measure == "bottom_dead_centre":
        return 1e6, "µm below the ideal"
    return 1.0, "m/s²" if tornado.number.measure == "peak_acceleration" else "m/s"
