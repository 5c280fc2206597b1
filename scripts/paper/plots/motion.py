"""Figs. 14-16: the slider with ideal, dry and lubricated joints, without load and under 10 kN."""

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.plots.canvas import angle_axis, crank_degrees, curve, new_figure
from exu_press.plots.scales import impact_scale, note
from exu_press.plots.style import COLOURS, IDEAL, styled
from exu_press.result import Result
from paper.plots.revolution import ideal_motion, mean_acceleration
from paper.published import stated

__all__ = ["LOOKS", "motion_figure"]

Array = NDArray[np.float64]
Loads = Mapping[str, Mapping[str, Result]]

LOOKS = {
    "ideal": {"color": IDEAL, "linewidth": 1.1, "linestyle": (0, (4, 2)), "zorder": 3},
    "dry": {"color": COLOURS["vermilion"], "linewidth": 1.2},
    "lubricated": {"color": COLOURS["blue"], "linewidth": 1.2},
}

KINDS: Mapping[str, tuple[str, str, str]] = {
    "displacement": ("Displacement of the slider", "position, mm", "below the ideal, µm"),
    "velocity": ("Velocity of the slider", "velocity, m/s", "deviation from ideal, mm/s"),
    "acceleration": (
        "Acceleration of the slider",
        "mean over 1 ms, m/s²",
        "as resolved, m/s²",
    ),
}


@styled
def motion_figure(figure: str, kind: str, loads: Loads) -> Figure:
    """Return one of Figs. 14-16: a column a load, above the curve, below what it hides.

    Args:
        figure: its name in the paper.
        kind: a key of KINDS.
        loads: runs by load and by joints, as in LOOKS.
    """
    title, above, below = KINDS[kind]
    everyone = {f"{a} {b}": run for a, runs in loads.items() for b, run in runs.items()}
    drawing = new_figure(f"{figure}: {title.lower()}", next(iter(loads.values())), (13.0, 7.4))
    panels = drawing.subplots(2, len(loads), sharex=True, sharey="row", squeeze=False)
    for column, (letter, (load, runs)) in enumerate(zip("ab", loads.items(), strict=False)):
        top, bottom = panels[:, column]
        for joints, run in runs.items():
            upper, lower = _values(kind, run)
            curve(top, run, upper, **LOOKS[joints], label=_label(joints, run))
            if joints != "ideal" or kind == "acceleration":
                curve(bottom, run, lower, **LOOKS[joints])
        top.set_title(f"{letter}  {load}")
    for row, words in ((0, above), (1, below)):
        panels[row, 0].set_ylabel(words)
    _FINISH[kind](panels, loads)
    for axes in panels[1]:
        axes.set_xlabel("crank angle from top dead centre, deg")
    angle_axis(panels.flat, everyone)
    handles, labels = panels[0, 0].get_legend_handles_labels()
    drawing.legend(handles, labels, loc="outside lower center", ncols=len(labels))
    return drawing


def _label(joints: str, run: Result) -> str:
    return f"{joints}, {run.scene.bodies}"


def _values(kind: str, run: Result) -> tuple[Array, Array]:
    """Return what the upper and the lower panel show."""
    position, velocity, _ = ideal_motion(run)
    if kind == "displacement":
        return 1e3 * run["slider_position"], 1e6 * (position - run["slider_position"])
    if kind == "velocity":
        return run["slider_velocity"], 1e3 * (run["slider_velocity"] - velocity)
    return mean_acceleration(run), run["slider_acceleration"]


def _finish_displacement(panels: NDArray[np.object_], loads: Loads) -> None:
    for axes in panels[1]:
        note(axes, "the paper: 1200 to 4000 µm at the bottom dead centre")


def _finish_velocity(panels: NDArray[np.object_], loads: Loads) -> None:
    return


def _finish_acceleration(panels: NDArray[np.object_], loads: Loads) -> None:
    """Show the paper's peaks as lines; scale the resolved curves."""
    for column, (load, runs) in enumerate(loads.items()):
        upper, lower = panels[:, column]
        for joints, run in runs.items():
            peak = stated(f"{load}, {joints}, {run.scene.bodies}", "peak_acceleration")
            if peak is not None:
                colour = LOOKS[joints]["color"]
                upper.axhline(-peak, color=colour, linewidth=1.0, linestyle=":")
                words = f"the paper's peak, {joints}: {peak:g}"
                upper.text(2.0, 0.8 - peak, words, fontsize=8.5, color=colour)
        curves = [(crank_degrees(run), run["slider_acceleration"]) for run in runs.values()]
        note(lower, impact_scale(lower, curves, signed=True))


_FINISH: Mapping[str, Callable[[NDArray[np.object_], Loads], None]] = {
    "displacement": _finish_displacement,
    "velocity": _finish_velocity,
    "acceleration": _finish_acceleration,
}
