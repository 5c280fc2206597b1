"""Forces of joints and torque of the drive over crank angle."""

from collections.abc import Mapping, Sequence
from itertools import chain

from matplotlib.figure import Figure

from exu_press.mechanism import GROUND
from exu_press.numerics.arrays import Array, lengths
from exu_press.plots.busiest import busiest, joint_titles, mirror
from exu_press.plots.canvas import (
    angle_axis,
    crank_degrees,
    curve,
    run_figure,
)
from exu_press.plots.legends import legend_outside
from exu_press.plots.palette import line_of
from exu_press.plots.panels import grid_rows
from exu_press.plots.peaks import mark_peak
from exu_press.plots.scales import contain_bars, impact_scale, note
from exu_press.plots.style import points, with_style
from exu_press.plots.typesetting import list_first, plain
from exu_press.quantities.catalogue import GUIDE_FORCE, JOINT_FORCE, PEAK_TORQUE
from exu_press.result import Result
from exu_press.scene import mechanism_of

__all__ = ["force_figure"]

MOST_JOINTS = 5
"""Joints whose forces are drawn: those with the largest ones, of the joints with clearance, of the
crank's pin, and of those in the frame and on the slider; of two sides that do the same, one."""

LETTERS = 102
"""Of the heading with joints that are not drawn, in letters as on a screen."""


@with_style
def force_figure(results: Mapping[str, Result]) -> Figure:
    """Return the magnitude of joint forces (kN) and the drive torque (N m), by label of the run.

    An axis is linear, or where impacts dwarf the rest linear for the rest and logarithmic beyond;
    it says so.
    """
    everyone = list(results.values())
    drawn, _ = busiest(everyone, _joints(everyone), "force", MOST_JOINTS)
    heading = "Joint forces and drive torque"
    loaded = {f"{name}_force" for run in everyone for name in run.joints} & {*chain(*everyone)}
    drawn_channels = {f"{name}_force" for name in drawn}
    left_out = {c for c in loaded if not {c, mirror(c)} & drawn_channels}
    if left_out:
        names = joint_titles(everyone, sorted(c.removesuffix("_force") for c in left_out))
        heading += " (not drawn: "
        letters = int(LETTERS / points(1.0)) - len(heading)
        heading += f"{list_first([*names.values()], letters).lower()})"
    panel_of = {title: (f"{name}_force", "force, kN", 1e-3) for name, title in drawn.items()}
    panel_of["Drive torque"] = "drive_torque", "torque, N m", 1.0
    rows = [*grid_rows(len(panel_of), 2)]
    rows[-1] = [len(panel_of) - 1 if number is None else number for number in rows[-1]]
    figure, panels = run_figure(heading, results, rows, 6.5, 6.4 / len(rows), sharex=True)
    for axes, (title, (channel, unit, scale)) in zip(panels, panel_of.items(), strict=True):
        curves, peaks = [], []
        for index, (label, result) in enumerate(results.items()):
            if channel in result:
                magnitude, line = _magnitude(result[channel]), line_of(index)
                values = scale * magnitude
                curve(axes, result, values, **line, linewidth=0.9, label=plain(label))
                curves.append((crank_degrees(result), values))
                figure_name = _figure_of(result, channel)
                peaks.append(mark_peak(axes, result, figure_name, magnitude, scale, line["color"]))
        signed = any(values.min() < -1e-3 * values.max() for _, values in curves)
        words = impact_scale(axes, curves, signed=signed)
        contain_bars(axes)
        note(axes, *(peaks if len(results) == 1 else ()), words)
        axes.set(title=title, ylabel=unit)
    angle_axis(panels, results)
    if len(results) > 1:
        legend_outside(figure, panels[-1].get_legend_handles_labels()[0])
    return figure


def _joints(results: Sequence[Result]) -> list[str]:
    """Return the joints and guides that may be shown: pins, balls, then those in the frame."""
    order: dict[str, int] = {}
    for result in results:
        mechanism = mechanism_of(result.scene)
        on_crank = [*mechanism.crank_pins][:1]
        order |= dict.fromkeys((*result.clearance_joints, *on_crank), 0)
        for joint in mechanism.joints:
            bodies = {joint.journal, joint.bearing}
            if bodies & {GROUND, mechanism.slider} and mechanism.crank not in bodies:
                order.setdefault(joint.name, 2)
        order |= {name: 1 for name in result.scene.joints.spherical if name in order}
        if len(mechanism.guides) == 1:
            order["guide"] = 3
    there = [name for name in order if any(f"{name}_force" in result for result in results)]
    return sorted(there, key=lambda name: (order[name], name))


def _figure_of(result: Result, channel: str) -> str:
    if channel == "drive_torque":
        return PEAK_TORQUE.name
    if channel == "guide_force":
        return GUIDE_FORCE.full_name(mechanism_of(result.scene).slider)
    return JOINT_FORCE.full_name(channel.removesuffix("_force"))


def _magnitude(values: Array) -> Array:
    """Return the length of vectors (n, k); a scalar channel (n,) as it is."""
    return values if values.ndim == 1 else lengths(values)
