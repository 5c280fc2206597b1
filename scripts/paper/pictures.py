"""All pictures of the study as files; error bars are the errors, or the bounds of what is open."""

from collections.abc import Callable, Sequence
from itertools import product
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from exu_press.plots import orbit_figure, slider_figure
from exu_press.plots.file import save_figures
from exu_press.plots.palette import COLOURS
from exu_press.plots.style import with_style
from exu_press.result import Result
from exu_press.scene import Scene
from paper.choice import cost, radii
from paper.published import published
from paper.readings import OBSERVED
from paper.runs import DAMPINGS, DEFAULT, JOINTS, LOADS, SWEEPS
from paper.study import Study
from paper.value import Value
from paper.verdicts import AGREES_WITHIN

__all__ = ["save_paper"]

PEAK = f"peak_acceleration.{OBSERVED}"
LOOKS: dict[str, dict[str, Any]] = {
    "2.5545e8": {"color": COLOURS["vermilion"], "marker": "o"},
    "0.01": {"color": COLOURS["blue"], "marker": "D"},
}
PAPER: dict[str, Any] = {"color": COLOURS["green"], "marker": "*", "markersize": 11, "zorder": 5}
SWEPT = {
    "below_ideal": ("dead centre below ideal, mm", 1e3),
    "peak_velocity": ("peak velocity, m/s", 1.0),
    PEAK: ("peak acceleration, m/s²", 1.0),
}
FIGURES = (("19", "22", "25"), ("20", "23", "26"), ("21", "24", "27"))


def save_paper(study: Study, directory: str | Path) -> list[Path]:
    """Draw what came out; return the files, PNG.

    Raises:
        InputError: a file cannot be written, or a run's result cannot be read.
    """
    figures = {
        "numbers": numbers_figure(study),
        "sweeps": sweeps_figure(study),
        "clearance": clearance_figure(study),
    }
    for damping, load in list(product(DAMPINGS, LOADS))[: 1 if study.quick else None]:
        scenes = {joints: study.scenes[damping][f"{load}, {joints}"] for joints in JOINTS}
        runs = {joints: Result.load(study.files[scene]) for joints, scene in scenes.items()}
        stem = f"c_max_{damping}_{load}".replace(" ", "_")
        figures[f"{stem}_slider"] = slider_figure(runs)
        for joints, run in runs.items():
            if run.clearance_joints:
                figures[f"{stem}_orbit_{joints}"] = orbit_figure(run)
    return save_figures(figures, directory)


@with_style
def numbers_figure(study: Study) -> Figure:
    """Return every number of section 5, ours over the paper's, with both readings."""
    numbers = published().numbers
    figure = Figure(figsize=(10.5, 0.33 * len(numbers) + 1.4), layout="constrained")
    axes = figure.subplots()
    for shift, damping in zip((-0.13, 0.13), DAMPINGS, strict=True):
        values = [study.value(damping, number.run, number.measure) for number in numbers]
        ratios = [v and v.over(n.published) for v, n in zip(values, numbers, strict=True)]
        places = [place + shift for place in range(len(numbers))]
        _points(axes, places, ratios, across=True, label=_name(damping), **LOOKS[damping])
    axes.set_xscale("log")
    axes.margins(x=0.05)
    _plain_numbers(axes.xaxis)
    axes.axvspan(1 - AGREES_WITHIN, 1 + AGREES_WITHIN, color=COLOURS["green"], alpha=0.16)
    axes.axvline(1.0, color=COLOURS["green"], linewidth=1.6, zorder=0.7)
    axes.set_yticks(range(len(numbers)), [f"{n.quantity} ({n.figure})" for n in numbers])
    axes.set_ylim(len(numbers) - 0.4, -0.6)
    axes.set_xlabel(f"ours over the paper's; green: within {100 * AGREES_WITHIN:.0f} %")
    axes.set_title("Section 5, flexible bodies, mean over 1 ms in the second revolution")
    axes.legend(loc="lower left")
    return figure


@with_style
def sweeps_figure(study: Study) -> Figure:
    """Return what Figs. 19-27 come to: positions, velocities and accelerations of each sweep."""
    figure = Figure(figsize=(12.5, 9.0), layout="constrained")
    panels = figure.subplots(len(SWEPT), len(SWEEPS), sharex="col")
    for row, (measure, (words, scale)) in enumerate(SWEPT.items()):
        for column, (swept, names) in enumerate(SWEEPS.items()):
            axes = panels[row, column]
            at = [float(word) for name in names for word in name.split() if word[0].isdigit()]
            for damping in DAMPINGS:
                values = [study.value(damping, name, measure) for name in names]
                look = LOOKS[damping] | {"label": _name(damping), "linestyle": "-"}
                _points(axes, at, [v and v.over(1.0 / scale) for v in values], **look)
            stated = {n.run: n.published for n in published().numbers if n.measure == measure}
            theirs = [
                (x, stated[name]) for x, name in zip(at, names, strict=True) if name in stated
            ]
            if theirs:
                axes.plot(*zip(*theirs, strict=True), linestyle="none", label="paper", **PAPER)
            axes.set_xticks(at)
            axes.margins(x=0.08)
            axes.set_ylim(0.0, 1.1 * axes.get_ylim()[1])
            said = {t.figure: t.stated for t in published().trends if t.measure == measure}
            name = f"Fig. {FIGURES[row][column]}"
            axes.set_title(f"{name}: {said[name]}, says the paper", fontsize=10)
            if column == 0:
                axes.set_ylabel(words)
            if row == len(SWEPT) - 1:
                axes.set_xlabel(swept)
    figure.legend(*panels[2, 1].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


@with_style
def clearance_figure(study: Study) -> Figure:
    """Return peaks, losses and their product over one clearance for pin and balls."""
    figure = Figure(figsize=(12.5, 4.2), layout="constrained")
    panels = figure.subplots(1, 3)
    drawn: dict[str, Callable[[Scene], Value | None]] = {
        "peak acceleration, m/s²": lambda scene: study.of(scene, PEAK),
        "power lost, W": lambda scene: study.of(scene, "power"),
        "power times peak acceleration, W m/s²": lambda scene: cost(study.of, scene),
    }
    for axes, (words, of) in zip(panels, drawn.items(), strict=True):
        for damping, line in study.line.items():
            look = LOOKS[damping] | {"label": _name(damping), "linestyle": "-"}
            at = [1e3 * radii(scene)[1] for scene in line]
            _points(axes, at, [of(scene) for scene in line], **look)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.margins(0.06)
        for axis in (axes.xaxis, axes.yaxis):
            _plain_numbers(axis)
        axes.set_xlabel("radial clearance, mm")
        axes.set_title(words, fontsize=10)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


def _name(damping: str) -> str:
    return f"c_max {damping} N s/m{', the default' if damping == DEFAULT else ''}"


def _plain_numbers(axis: Axis) -> None:
    """Label a logarithmic axis 1, 2, 5, 10 and so on."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _points(
    axes: Axes,
    places: Sequence[float],
    values: Sequence[Value | None],
    *,
    across: bool = False,
    linestyle: str = "none",
    **look: Any,
) -> None:
    """Draw values with their bounds over places, or across them; what has no run is left out."""
    known = [(place, v) for place, v in zip(places, values, strict=True) if v is not None]
    if not known:
        return
    at, middle = [place for place, _ in known], [v.value for _, v in known]
    off = [[v.value - v.low for _, v in known], [v.high - v.value for _, v in known]]
    line = {"linestyle": linestyle, "linewidth": 1.1, "capsize": 3, **look}
    if across:
        axes.errorbar(middle, at, xerr=off, **line)
    else:
        axes.errorbar(at, middle, yerr=off, **line)
