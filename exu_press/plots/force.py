"""What the joints and the drive carry, over crank angle."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.plots.canvas import angle_range, crank_degrees, curve, new_figure
from exu_press.plots.scales import crank_angle_axis, impact_scale, note
from exu_press.plots.sides import joint_titles
from exu_press.plots.style import colour_of, styled
from exu_press.plots.words import plain
from exu_press.result import Result

__all__ = ["force_figure"]

Array = NDArray[np.float64]

JOINTS = {
    "press": ("crank_pin", "ball_left", "ball_right", "pivot_left", "pivot_right"),
    "slider_crank": ("crank_pin", "wrist_pin", "guide"),
}
"""Which joints are shown: those with clearance, and where the frame or the slider takes the load.

Of two sides that do the same, one is shown.
"""


@styled
def force_figure(results: Mapping[str, Result]) -> Figure:
    """Return the magnitude of joint forces (kN) and the drive torque (N m), by label of the run.

    An axis is linear, or where impacts dwarf the rest linear for the rest and logarithmic beyond;
    it says so.
    """
    figure = new_figure("Joint forces and drive torque", results, (13.0, 7.6))
    shown = {
        title: (channel, "force, kN", 1e-3) for title, channel in _force_channels(results).items()
    }
    shown["Drive torque"] = "drive_torque", "torque, N m", 1.0
    rows = -(-len(shown) // 2)
    grid = figure.subplots(rows, 2, sharex=True, squeeze=False)
    panels = list(grid.flat)[: len(shown)]
    for axes, (title, (channel, unit, scale)) in zip(panels, shown.items(), strict=True):
        curves = []
        for index, (label, result) in enumerate(results.items()):
            if channel in result:
                values = scale * _magnitude(result[channel])
                curve(
                    axes, result, values, color=colour_of(index), linewidth=0.9, label=plain(label)
                )
                curves.append((crank_degrees(result), values))
        signed = any(values.min() < -1e-3 * values.max() for _, values in curves)
        note(axes, impact_scale(axes, curves, signed=signed))
        axes.set_title(title)
        axes.set_ylabel(unit)
    for axes in list(grid.flat)[len(shown) :]:
        axes.remove()
    for axes in panels[-2:]:
        axes.set_xlabel("crank angle from top dead centre, deg")
        axes.tick_params(labelbottom=True)
    crank_angle_axis(panels, *angle_range(results))
    if len(results) > 1:
        handles, labels = panels[-1].get_legend_handles_labels()
        for handle in handles:
            handle.set_linewidth(1.0)
        figure.legend(handles, labels, loc="outside lower center", ncols=min(len(labels), 6))
    return figure


def _force_channels(results: Mapping[str, Result]) -> dict[str, str]:
    """Return the force channels to show, by title; one of two sides that are alike."""
    everyone = list(results.values())
    loose = dict.fromkeys(name for result in everyone for name in result.clearance_joints)
    usual = [name for result in everyone for name in JOINTS.get(result.scene.shipped, ())]
    names = dict.fromkeys((*usual, *sorted(loose)))
    there = [name for name in names if any(f"{name}_force" in result for result in everyone)]
    return {title: f"{name}_force" for name, title in joint_titles(everyone, there).items()}


def _magnitude(values: Array) -> Array:
    """Return the length of vectors (n, k); a scalar channel (n,) as it is."""
    return values if values.ndim == 1 else np.asarray(np.linalg.norm(values, axis=1))
