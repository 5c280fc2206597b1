"""The clearance to choose: what it changes, and the trade-off of acceleration against losses."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.plots.style import COLOURS, GREY, RUN, styled
from paper.clearance import Choice, Point
from paper.plots.drawing import headed_figure, plain_logarithm
from paper.readings import MODELS, OBSERVED

__all__ = ["tradeoff_figure"]

MICRO = 1e6
LOOKS: dict[str, dict[str, Any]] = {
    "mean_1ms": {"color": RUN, "marker": "o", "label": "mean over 1 ms"},
    "differentiated_1khz": {"color": COLOURS["sky blue"], "marker": "s", "label": "1 kHz"},
    "resolved": {"color": GREY, "marker": "^", "linestyle": ":", "label": "as resolved"},
}
LOSSES = {
    "pin": ("pin, film", COLOURS["green"]),
    "balls": ("balls, contact", COLOURS["vermilion"]),
}


@styled
def tradeoff_figure(choice: Choice) -> Figure:
    """Return peaks, position and losses over clearance, the trade-off curve, and pin by ball."""
    load = f"blanking {choice.force / 1e3:g} kN" if choice.force else "no load"
    words = (
        f"lubricated pin, dry balls  ·  {choice.speed_rpm:g} rpm  ·  {load}  ·  one clearance for "
        f"pin and balls, {choice.bodies} bodies; in the map two, rigid bodies"
    )
    figure = headed_figure("The clearance to choose", words, (13.0, 8.2))
    panels = figure.subplots(2, 3)
    _accelerations(panels[0, 0], choice)
    _forces(panels[0, 1], choice)
    _positions(panels[0, 2], choice)
    _losses(panels[1, 0], choice)
    _tradeoff(panels[1, 1], choice)
    _map(panels[1, 2], choice)
    for axes in (*panels[0], panels[1, 0]):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("radial clearance, µm")
        axes.margins(x=0.05)
        low, high = axes.get_xlim()
        plain_logarithm(axes.xaxis, math.log10(high / low))
        _plain(axes)
    return figure


def _plain(axes: Axes) -> None:
    low, high = axes.get_ylim()
    plain_logarithm(axes.yaxis, math.log10(high / low))


def _sizes(choice: Choice) -> list[float]:
    return [MICRO * point.balls for point in choice.alike]


def _accelerations(axes: Axes, choice: Choice) -> None:
    for model in MODELS:
        values = [point.acceleration[model] for point in choice.alike]
        axes.plot(_sizes(choice), values, **LOOKS[model])
    axes.set_title("Peak acceleration")
    axes.set_ylabel("m/s²")
    axes.legend()


def _forces(axes: Axes, choice: Choice) -> None:
    forces = [1e-3 * point.force for point in choice.alike]
    axes.plot(_sizes(choice), forces, color=COLOURS["vermilion"], marker="o")
    axes.set_title("Largest force in a ball")
    axes.set_ylabel("kN")


def _positions(axes: Axes, choice: Choice) -> None:
    deviations = [MICRO * max(point.deviation, 1e-12) for point in choice.alike]
    axes.plot(_sizes(choice), deviations, color=RUN, marker="o", label="below the ideal")
    scatter = [
        (MICRO * point.balls, MICRO * point.scatter)
        for point in choice.separate
        if point.pin == point.balls and point.scatter
    ]
    if scatter:
        radial, values = zip(*scatter, strict=True)
        look: dict[str, Any] = {"color": COLOURS["orange"], "marker": "s"}
        axes.plot(radial, values, **look, label="scatter over strokes, rigid")
    axes.set_title("Bottom dead centre")
    axes.set_ylabel("µm")
    axes.legend()


def _losses(axes: Axes, choice: Choice) -> None:
    for key, (label, colour) in LOSSES.items():
        values = [point.losses[key] for point in choice.alike]
        axes.plot(_sizes(choice), values, color=colour, marker="o", label=label)
    total = [point.power for point in choice.alike]
    axes.plot(_sizes(choice), total, color="black", linewidth=1.8, label="all")
    axes.set_title("Power lost")
    axes.set_ylabel("W")
    axes.legend()


def _tradeoff(axes: Axes, choice: Choice) -> None:
    """Draw acceleration against power with the clearances beside; least costs marked."""
    x = [point.power for point in choice.alike]
    y = [point.acceleration[OBSERVED] for point in choice.alike]
    axes.plot(x, y, color=RUN, marker="o")
    for point, place in zip(choice.alike, zip(x, y, strict=True), strict=True):
        label = f"{1e3 * point.balls:g} mm"
        axes.annotate(label, place, xytext=(7, 4), textcoords="offset points", fontsize=8.5)
    sizes = np.log([point.balls for point in choice.alike])
    for (weight, best), marker in zip(choice.best.items(), ("v", "D", "^"), strict=True):
        if best is not None:
            at = [float(np.exp(np.interp(np.log(best), sizes, np.log(v)))) for v in (x, y)]
            axes.plot(
                *at,
                marker=marker,
                markersize=11,
                linestyle="none",
                markerfacecolor="none",
                markeredgewidth=1.8,
                color=COLOURS["vermilion"],
                label=f"weight {weight:g}: {1e3 * best:.2g} mm",
            )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(0.18, 0.12)
    _plain(axes)
    plain_logarithm(axes.xaxis, np.log10(np.divide(*axes.get_xlim()[::-1])))
    axes.set_title("Trade-off")
    axes.set_xlabel("power lost, W")
    axes.set_ylabel("peak acceleration, mean over 1 ms, m/s²")
    axes.legend(title="least power · accelerationʷ", title_fontsize=8.5)


def _map(axes: Axes, choice: Choice) -> None:
    """Draw the cost over pin and ball clearance, relative to the best."""
    points: dict[tuple[float, float], Point] = {(p.pin, p.balls): p for p in choice.separate}
    pins = sorted({pin for pin, _ in points})
    balls = sorted({ball for _, ball in points})
    cost = np.array(
        [[points[p, b].cost() if (p, b) in points else np.nan for p in pins] for b in balls]
    )
    axes.imshow(cost / np.nanmin(cost), origin="lower", cmap="viridis_r", norm="log")
    for (row, column), value in np.ndenumerate(cost / np.nanmin(cost)):
        if np.isnan(value):
            continue
        axes.text(
            column,
            row,
            f"{value:.2g}" if value < 10 else f"{value:.0f}",
            ha="center",
            va="center",
            fontsize=8.5,
            color="white" if value > 4 else "black",
        )
    axes.set_xticks(range(len(pins)), [f"{1e3 * pin:g}" for pin in pins])
    axes.set_yticks(range(len(balls)), [f"{1e3 * ball:g}" for ball in balls])
    axes.grid(False)
    axes.set_title("Power · acceleration, over its least")
    axes.set_xlabel("clearance of the pin, mm")
    axes.set_ylabel("clearance of the balls, mm")
