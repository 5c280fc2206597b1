"""The press builder's picture: shaking force, drive, guides, bottom dead centres, tilt."""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.mechanism import Mechanism
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import evaluate, hermite, integral
from exu_press.plots.canvas import (
    angle_axis,
    crank_degrees,
    curve,
    dead_centres,
    run_figure,
)
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import GREY, IDEAL, colour_of
from exu_press.plots.panels import grid_rows
from exu_press.plots.peaks import mark_peak, with_error
from exu_press.plots.scales import contain_bars, note, widen
from exu_press.plots.slider import sliding_mean
from exu_press.plots.style import with_style
from exu_press.plots.words import joint_in_words
from exu_press.quantities import DeadCentre, bottom_dead_centres, ideal_angles
from exu_press.quantities.catalogue import (
    DEAD_CENTRE_MEAN,
    DEAD_CENTRE_RANGE,
    PEAK_TORQUE,
    SHAKING_MEANS,
)
from exu_press.quantities.slider import of_output
from exu_press.quantities.uncertain import significant
from exu_press.quantities.value import value_of
from exu_press.result import Result
from exu_press.result.channel import guide_channel
from exu_press.result.windows import settled_part
from exu_press.scene import mechanism_of

__all__ = ["press_figure"]

ABOUT = (12.0, 10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0, 0.5)
"""Largest crank angle about bottom dead centre over which strokes are shown, deg."""

RISE = 50e-6
"""m; the ideal slider rises no more where they are shown, so that micrometres are seen."""

BESIDE = {
    "slider_tilt": ("Slider tilt", "counter-clockwise", "µrad"),
    "slider_lateral": ("Slider sideways", "across its guide", "µm"),
}

CROWD = 8
"""More strokes than this are not named one by one."""


@with_style
def press_figure(result: Result) -> Figure:
    """Return the picture for press builders of one run.

    Shaking force (kN) with and without the counterweight, power of the drive (kW) and forces of the
    guides (kN), all as means over 1 ms; the slider about every bottom dead centre (um); where the
    guides are elastic the slider's tilt (urad) and sideways motion (um); the speed of a
    motor's crank (rpm) and the loads (kN).
    """
    mechanism = mechanism_of(result.scene)
    guide = mechanism.frame_guide(mechanism.slider)
    elastic = guide is not None and not guide.holds_across
    loads = list(result.scene.applied_loads)
    motor = result.scene.drive is not None
    centres = bottom_dead_centres(settled_part(result))
    draws: list[Callable[..., None]] = [_shaking, _drive, _guides]
    if has_strokes := bool(centres and dead_centres({"": result})):
        draws.append(partial(_strokes, centres=centres))
    if elastic:
        draws += [partial(_at_dead_centres, name=name, centres=centres) for name in BESIDE]
    if motor:
        draws.append(_speed)
    if loads:
        draws.append(partial(_loads, names=loads))
    heading = "Frame, drive, guides, dead centres"
    figure, panels = run_figure(heading, {"": result}, grid_rows(len(draws), 2), 6.5, 3.1)
    for draw, axes in zip(draws, panels, strict=True):
        draw(axes, result)
    angle_axis(panels[:3] + panels[3 + has_strokes :], {"": result})
    return figure


def _shaking(axes: Axes, result: Result) -> None:
    bare = "shaking_force_without_counterweight"
    _draw(
        axes,
        result,
        {
            "vertical": result["shaking_force"][:, 1],
            "vertical, without counterweight": result[bare][:, 1] if bare in result else None,
            "horizontal": result["shaking_force"][:, 0],
        },
        [quantity.name for quantity in SHAKING_MEANS],
    )
    axes.set(title="Shaking force", ylabel="mean over 1 ms, kN")


def _drive(axes: Axes, result: Result) -> None:
    _draw(axes, result, {"": result["drive_power"]}, ())
    axes.set(title="Power of the drive", ylabel="mean over 1 ms, kW")
    peak = with_error(value_of(result, PEAK_TORQUE.name), 1e-3)
    note(axes, f"torque, as resolved: at most {peak} kN m")


def _speed(axes: Axes, result: Result) -> None:
    drawn = [name for name in ("crank_speed", "flywheel_speed") if name in result]
    for index, name in enumerate(drawn):
        speed, label = result[name] * 30.0 / np.pi, name.removesuffix("_speed")
        curve(axes, result, speed, color=colour_of(index), linewidth=1.1, label=label)
    axes.set(title="Speed" if len(drawn) > 1 else "Crank speed", ylabel="rpm")
    if len(drawn) > 1:
        legend_above(axes, columns=len(drawn))


def _loads(axes: Axes, result: Result, names: list[str]) -> None:
    for index, name in enumerate(names):
        force = 1e-3 * result[f"load_{name}_force"]
        label = name.replace("_", " ")
        curve(axes, result, force, color=colour_of(index), linewidth=1.1, label=label)
    axes.set(title="Loads", ylabel="force, kN")
    legend_above(axes, columns=len(names))


def _guides(axes: Axes, result: Result) -> None:
    mechanism = mechanism_of(result.scene)
    names = {
        joint_in_words(guide.name).lower(): f"{guide_channel(mechanism, guide.name)}_force"
        for guide in mechanism.guides
    }
    curves = {label: result[name] for label, name in names.items() if name in result}
    if not curves:
        axes.text(0.5, 0.5, "no guide", transform=axes.transAxes, ha="center", color=GREY)
    _draw(axes, result, curves, ())
    axes.set(title="Guides", ylabel="force, mean over 1 ms, kN")


def _draw(
    axes: Axes, result: Result, curves: Mapping[str, Array | None], figures: Sequence[str]
) -> None:
    """Draw means over 1 ms in thousands, and the errors of their peaks where those are figures."""
    for index, (label, values) in enumerate(curves.items()):
        if values is not None:
            mean = 1e-3 * sliding_mean(result.time, integral(result.time, values))
            curve(axes, result, mean, color=colour_of(index), linewidth=1.1, label=label)
            if figures:
                mark_peak(axes, result, figures[index], 1e3 * mean, 1e-3, colour_of(index))
    contain_bars(axes)
    if len(curves) > 1:
        rows = 1 if len(curves) < 5 else 2  # beside the panel's title
        columns = math.ceil(len(curves) / rows)
        legend_above(axes, columns=columns)


def _strokes(axes: Axes, result: Result, centres: list[DeadCentre]) -> None:
    """Draw every stroke about its bottom dead centre, and the ideal one."""
    mean = float(np.mean([centre.position for centre in centres]))
    mechanism = mechanism_of(result.scene)
    unit = mechanism.output.unit
    bottom = np.degrees(ideal_angles(mechanism)[0])
    about = _about(mechanism, bottom)
    from_centre = np.linspace(-about, about, 200)
    ideal = mechanism.ideal_slider(np.radians(bottom + from_centre), 1.0)[0]
    axes.plot(
        from_centre,
        1e6 * (ideal - ideal.min()),
        color=IDEAL,
        linewidth=1.1,
        linestyle=(0, (4, 2)),
        zorder=3,
        label="ideal",
    )
    angle = crank_degrees(result)
    path = hermite(result.time, result["slider_position"], result["slider_velocity"])
    for index, centre in enumerate(centres):
        turn = 360.0 * np.round((np.degrees(centre.crank_angle) - bottom) / 360.0) + bottom
        near = turn + from_centre
        near = near[(near >= angle[0]) & (near <= angle[-1])]
        few = len(centres) <= CROWD
        colour = colour_of(index) if few else GREY
        height = 1e6 * (evaluate(result.time, path, np.interp(near, angle, result.time)) - mean)
        label = f"stroke {index + 1}" if few else ""
        axes.plot(near - turn, height, color=colour, linewidth=1.1, label=label)
        lowest_point = np.degrees(centre.crank_angle) - turn, 1e6 * (centre.position - mean)
        axes.plot(*lowest_point, "o", color=colour, markersize=4)
    axes.set(xlim=(-about, about), title="Bottom dead centre")
    axes.set(
        xlabel="crank angle from bottom dead centre, deg",
        ylabel=f"slider above its lowest, µ{unit}",
    )
    axes.margins(y=0.3)
    axes.legend(loc="upper center", ncols=3)
    mean_of_lowest = of_output(DEAD_CENTRE_MEAN, mechanism.output)
    lowest = with_error(value_of(result, mean_of_lowest), 1e3, 6)
    note(axes, f"lowest, m{unit}: {lowest}{_scatter(result, centres)}")


def _about(mechanism: Mechanism, bottom: float) -> float:
    """Return how far about bottom dead centre (deg) the strokes are shown, deg."""
    ends = np.radians([[bottom - about, bottom, bottom + about] for about in ABOUT])
    height = mechanism.ideal_slider(ends.ravel(), 1.0)[0].reshape(ends.shape)
    flat = np.flatnonzero(height[:, [0, 2]].max(axis=1) - height[:, 1] <= RISE)
    return ABOUT[flat[0]] if len(flat) else ABOUT[-1]


def _scatter(result: Result, centres: list[DeadCentre]) -> str:
    """Return in words how far the strokes' lowest positions differ."""
    if len(centres) < 2:
        return ""
    spread = float(np.ptp([centre.position for centre in centres]))
    if spread < 1e-11:
        return ", all strokes alike"
    output = mechanism_of(result.scene).output
    scatter = with_error(value_of(result, of_output(DEAD_CENTRE_RANGE, output)), 1e9, 2)
    return f", strokes differ by {scatter} n{output.unit}"


def _at_dead_centres(axes: Axes, result: Result, name: str, centres: list[DeadCentre]) -> None:
    """Draw a channel (n,) in millionths, with a dot at every bottom dead centre."""
    title, sense, unit = BESIDE[name]
    values = 1e6 * result[name]
    curve(axes, result, values, color=colour_of(0), linewidth=1.0)
    instants = np.array([centre.time for centre in centres])
    at = np.interp(instants, result.time, values)
    angles = np.degrees([centre.crank_angle for centre in centres])
    axes.plot(angles, at, "o", color=colour_of(1), markersize=5, zorder=4)
    axes.set(title=title, ylabel=f"{sense}, {unit}")
    widen(axes, 1e-3)
    if centres and dead_centres({"": result}):
        most = float(np.abs(at).max())
        note(axes, f"dots: bottom dead centres, at most {significant(most, 2)} {unit}")
