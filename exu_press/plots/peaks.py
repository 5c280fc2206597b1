"""Peaks with their errors: at curves, and in a table of joints that are not drawn."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from exu_press.numerics.arrays import Array
from exu_press.plots.canvas import crank_degrees
from exu_press.plots.format import picture_format
from exu_press.plots.palette import colour_of
from exu_press.plots.scales import draw_bar
from exu_press.quantities.catalogue import ECCENTRICITY_RATIO, JOINT_FORCE
from exu_press.quantities.reading import Reading
from exu_press.quantities.uncertain import uncertain
from exu_press.quantities.value import Value, value_of
from exu_press.result import Result
from exu_press.result.info import Error
from exu_press.result.windows import settled_part
from exu_press.terminal.columns import columns

__all__ = ["draw_rest", "error_of", "mark_peak", "mark_peaks", "rest_lines", "with_error"]

LETTER = 0.61
"""Width of a monospaced letter over its size."""

SMALLEST = 6.0
"""Points; a longer table goes beyond its panel."""


def error_of(result: Result, name: str) -> Error | None:
    """Return a figure's error by its dotted name, or None."""
    errors: Mapping[str, Error] = result.info.get("errors", {})
    return errors.get(name)


def with_error(value: Value, scale: float = 1.0, digits: int = 4) -> str:
    """Return a figure in words, with its error where that is known.

    Args:
        value: of the figure.
        scale: to the unit that is shown.
        digits: of a figure without error.
    """
    return uncertain(value.value, value.to_dict(), scale, digits).replace("+-", "±")


def mark_peak(
    axes: Axes, result: Result, name: str, values: Array, scale: float, colour: str
) -> str:
    """Draw an error bar at a curve's largest magnitude; return it in words, "" without an error.

    Args:
        axes: of the curve.
        result: of the run.
        name: dotted, of the figure.
        values: (n,), SI.
        scale: to the axis' unit.
        colour: of the curve.
    """
    error = error_of(result, name)
    if error is None:
        return ""
    read = settled_part(result).time
    inside = (result.time >= read[0]) & (result.time <= read[-1])
    highest = int(np.argmax(np.where(inside, np.abs(values), 0.0)))
    size, sign = abs(scale * values[highest]), np.copysign(1.0, values[highest])
    low, high = scale * error["low"], scale * error["high"]  # of the magnitude
    ends = sign * np.array([min(low, size), max(size, high)])
    draw_bar(axes, crank_degrees(result)[highest], ends, colour)
    # the figure itself: of means over 1 ms, a curve drawn at the run's instants meets it nearly
    figure = Value(name, error["high"] - error["error"], "", **error)
    return f"peak {with_error(figure, scale)}"


def mark_peaks(axes: Axes, curves: Mapping[str, tuple[Result, Array]], name: str) -> str:
    """Draw error bars at the peaks of runs by label; return that of a single run in words.

    Args:
        axes: of the curves.
        curves: label -> run and values (n,), SI, in the order of their colours.
        name: dotted, of the figure.
    """
    texts = [
        mark_peak(axes, result, name, values, 1.0, colour_of(index))
        for index, (result, values) in enumerate(curves.values())
    ]
    return texts[0] if len(texts) == 1 else ""


def rest_lines(result: Result, rest: Mapping[str, str]) -> list[str]:
    """Return a table of joints, a line each: clearance, eccentricity ratio and force."""
    cells, run = [("also", "c, µm", "e/c, max", "F, max, kN")], Reading(result)
    for name, title in rest.items():
        ratio, force = (
            value_of(result, quantity.full_name(name), run)
            for quantity in (ECCENTRICITY_RATIO, JOINT_FORCE)
        )
        clearance = result.joints[name].clearance * 1e6
        cells.append(
            (title, f"{clearance:.4g}", with_error(ratio, 1.0, 3), with_error(force, 1e-3))
        )
    return columns(cells)


def draw_rest(axes: Axes, result: Result, rest: Mapping[str, str], size: float) -> None:
    """Write the table of the joints that are not drawn into a panel of its own.

    Args:
        axes: the panel.
        result: of the run.
        rest: the joints, each with its title.
        size: of the letters, points; smaller where the panel is too narrow for them.
    """
    axes.set_axis_off()
    lines = rest_lines(result, rest)
    figure = axes.get_figure(root=True)
    assert figure is not None
    room = 72.0 * axes.get_position().width * figure.get_figwidth()
    size = min(size, max(SMALLEST, room / (LETTER * max(map(len, lines)))))
    narrow = picture_format().stacks  # then it goes on to the left, below the names of the axes
    text = axes.text(
        1.0 if narrow else 0.0,
        1.0,
        "\n".join(lines),
        transform=axes.transAxes,
        ha="right" if narrow else "left",
        multialignment="left",
        va="top",
        fontsize=size,
        family="monospace",
    )
    text.set_in_layout(picture_format().width is not None)  # on a screen it is long, and has room
