"""The slider's motion over crank angle, against the ideal mechanism."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from exu_press.mechanism import Mechanism
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import evaluate, hermite
from exu_press.plots.canvas import (
    angle_axis,
    crank_degrees,
    curve,
    run_figure,
)
from exu_press.plots.decimate import decimate
from exu_press.plots.legends import legend_outside
from exu_press.plots.palette import IDEAL, line_of
from exu_press.plots.panels import grid_rows
from exu_press.plots.peaks import mark_peaks
from exu_press.plots.scales import contain_bars, impact_scale, note, widen
from exu_press.plots.style import points, with_style
from exu_press.plots.typesetting import plain
from exu_press.quantities.catalogue import MEAN_ACCELERATION, PEAK_ACCELERATION
from exu_press.quantities.slider import of_output
from exu_press.result import Result
from exu_press.scene import mechanism_of

__all__ = ["slider_figure", "sliding_mean"]

Panels = NDArray[np.object_]
Motion = tuple[Array, Array, Array]

WINDOW = 1e-3
"""Over which the acceleration is averaged, s: about the resolution of a measurement."""

MOST_OF_IDEAL = 8.0
"""The averaged acceleration's panel ends at this multiple of the ideal peak, and says so."""

LEAST_DEVIATIONS = 1.0, 0.1
"""Of position (um) and velocity (mm/s), which are always shown: rounding errors look like none."""

KNOTS = 720
"""Crank angles of a revolution at which the ideal motion of a longer record is solved; cubics are
between them."""

KNOT_ANGLES = np.linspace(0.0, 2.0 * np.pi, KNOTS + 1)
"""rad"""

IDEAL_NAME = "ideal mechanism"

TITLES = (
    ("Position", "position, m{unit}"),
    ("Position, deviation from ideal", "deviation, µ{unit}"),
    ("Velocity", "velocity, {unit}/s"),
    ("Velocity, deviation from ideal", "deviation, m{unit}/s"),
    ("Acceleration, mean over 1 ms", "acceleration, {unit}/s²"),
    ("Acceleration, resolved", "acceleration, {unit}/s²"),
)


@with_style
def slider_figure(results: Mapping[str, Result]) -> Figure:
    """Return position, velocity and acceleration of one slider or several, by label.

    On the left the motion (mm, m/s, m/s^2) with the ideal mechanism's; on the right
    its deviation from the ideal (um, mm/s) and the acceleration as resolved, impacts and all.
    """
    heading = "Slider motion against the ideal mechanism"
    figure, grid = run_figure(heading, results, grid_rows(6, 2), 6.5, 2.5, sharex=True)
    panels: Any = np.array(grid).reshape(3, 2)
    output = mechanism_of(next(iter(results.values())).scene).output
    ideals = {label: _ideal(result) for label, result in results.items()}
    for index, (label, result) in enumerate(results.items()):
        _draw_run(panels, result, ideals[label], label, line_of(index))
    _draw_ideals(panels, results, ideals)
    for axes, (title, unit) in zip(panels.flat, TITLES, strict=True):
        axes.set(title=title, ylabel=unit.format(unit=output.unit))
    for axes, least in zip(panels[:2, 1], LEAST_DEVIATIONS, strict=True):
        widen(axes, least)
    _scale_averaged(panels[2, 0], results, ideals)
    resolved = [(crank_degrees(r), r["slider_acceleration"]) for r in results.values()]
    scale = impact_scale(panels[2, 1], resolved, signed=True)
    peaks = {label: (r, r["slider_acceleration"]) for label, r in results.items()}
    words = mark_peaks(panels[2, 1], peaks, of_output(PEAK_ACCELERATION, output))
    contain_bars(panels[2, 1])
    note(panels[2, 1], words, scale)
    angle_axis(grid, results)
    legend_outside(figure, panels[0, 0].get_legend_handles_labels()[0])
    return figure


def _draw_run(
    panels: Panels, result: Result, ideal: Motion, label: str, line: dict[str, Any]
) -> None:
    """Draw one run in all six panels."""
    position, velocity = result["slider_position"], result["slider_velocity"]
    thick, thin = {**line, "linewidth": 2.0}, {**line, "linewidth": 0.9}
    curve(panels[0, 0], result, 1e3 * position, **thick, label=plain(label))
    curve(panels[0, 1], result, 1e6 * (position - ideal[0]), **thin)
    curve(panels[1, 0], result, velocity, **thick)
    curve(panels[1, 1], result, 1e3 * (velocity - ideal[1]), **thin)
    curve(panels[2, 0], result, sliding_mean(result.time, velocity), **(thin | {"linewidth": 1.2}))
    curve(panels[2, 1], result, result["slider_acceleration"], **thin)


def _draw_ideals(
    panels: Panels, results: Mapping[str, Result], ideals: Mapping[str, Motion]
) -> None:
    """Draw the ideal motion of every mechanism and speed, as far as its longest run goes."""
    longest: dict[object, str] = {}
    for label in sorted(results, key=lambda label: float(np.ptp(results[label]["crank_angle"]))):
        scene = results[label].scene
        longest[scene.mechanism, scene.press, scene.slider_crank, scene.speed_rpm] = label
    line: dict[str, Any] = {
        "color": IDEAL,
        "linewidth": points(1.1),
        "linestyle": (0, (4, 2)),
        "zorder": 3,
    }
    for number, label in enumerate(longest.values()):
        angle = crank_degrees(results[label])
        drawn = decimate(angle, *ideals[label])
        for axes, values, scale in (
            (panels[0, 0], ideals[label][0], 1e3),
            (panels[1, 0], ideals[label][1], 1.0),
            (panels[2, 0], ideals[label][2], 1.0),
            (panels[2, 1], ideals[label][2], 1.0),
        ):
            axes.plot(
                angle[drawn], scale * values[drawn], **line, label="" if number else IDEAL_NAME
            )


def _ideal(result: Result) -> Motion:
    """Return position (m), velocity and acceleration of the ideal slider, (n,) each."""
    scene, angle = result.scene, result["crank_angle"]
    mechanism, speed = mechanism_of(scene), scene.angular_speed
    if len(angle) <= KNOTS:
        return mechanism.ideal_slider(angle, speed)
    position, velocity, acceleration = _ideal_knots(mechanism, speed)
    at, time = np.mod(angle, 2.0 * np.pi) / speed, KNOT_ANGLES / speed
    return (
        evaluate(time, hermite(time, position, velocity), at),
        evaluate(time, hermite(time, velocity, acceleration), at),
        np.interp(at, time, acceleration),
    )


@lru_cache(maxsize=8)
def _ideal_knots(mechanism: Mechanism, speed: float) -> Motion:
    """Return the motion of `_ideal` at KNOT_ANGLES; runs over each other mostly share it."""
    return mechanism.ideal_slider(KNOT_ANGLES, speed)


def sliding_mean(time: Array, velocity: Array) -> Array:
    """Return the mean acceleration over WINDOW about each instant, (n,), m/s^2.

    Or of anything from its integral. At the record's ends the window is cut off.
    """
    early = np.maximum(time - WINDOW / 2, time[0])
    late = np.minimum(time + WINDOW / 2, time[-1])
    change = np.interp(late, time, velocity) - np.interp(early, time, velocity)
    return np.asarray(change / np.maximum(late - early, 1e-300))


def _scale_averaged(
    axes: Axes, results: Mapping[str, Result], ideals: Mapping[str, Motion]
) -> None:
    """Keep the ideal readable: cut peaks off at a multiple of its own, and say so."""
    means = {
        label: (result, sliding_mean(result.time, result["slider_velocity"]))
        for label, result in results.items()
    }
    output = mechanism_of(next(iter(results.values())).scene).output
    peak_words = mark_peaks(axes, means, of_output(MEAN_ACCELERATION, output))
    ordinary = max(float(np.abs(ideal[2]).max()) for ideal in ideals.values())
    peak = max(float(np.abs(values).max()) for _, values in means.values())
    limit = MOST_OF_IDEAL * ordinary
    if peak > limit:
        axes.set_ylim(-limit, limit)
        note(axes, peak_words or f"peaks reach {peak:.0f} {output.unit}/s²", "clipped")
    else:
        contain_bars(axes)
        note(axes, peak_words)
