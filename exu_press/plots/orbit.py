"""Motion of journals and balls in their clearance: path in the circle, eccentricity over angle."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from exu_press.errors import InputError
from exu_press.plots.busiest import busiest, draw_rest
from exu_press.plots.canvas import angle_axis, angle_range, curve, legend_above, new_figure
from exu_press.plots.clearance_circle import TOUCH_COLOUR, Path, draw_path
from exu_press.plots.format import picture_format
from exu_press.plots.scales import angle_ticks, note
from exu_press.plots.style import GREY, RUN, SHADE, with_style
from exu_press.result import Result

__all__ = ["orbit_figure"]

ROW = 3.75  # inch
LINE = 0.19  # inch

MOST_JOINTS = 4
"""Joints whose paths are drawn, the busiest ones; the rest stand in a table below them."""


@with_style
def orbit_figure(result: Result) -> Figure:
    """Return the paths of journal and ball centres in their clearance circles, joint by joint.

    On the left the path (um, x-y plane), coloured by crank angle; on the right over the crank angle
    the eccentricity of a journal, or the height of a ball in its socket, which ideal guides let
    move only vertically. Outside the circle the surfaces penetrate each other. Of two balls that
    do the same one is shown.

    Raises:
        InputError: the scene has no clearance joint.
    """
    names = sorted(result.clearance_joints, key=lambda n: (result.joints[n].spherical, n))
    drawn, rest = busiest([result], names, "eccentricity", MOST_JOINTS)
    paths = [Path(title, result, name) for name, title in drawn.items()]
    if not paths:
        raise InputError("orbit_figure: this scene has no joint with clearance; draw its forces")
    lines_of_rest = LINE * (len(rest) + 2) if rest else 0.0
    height = 1.3 + ROW * len(paths) + lines_of_rest
    figure = new_figure("Journal and ball centres in their clearance", {"": result}, (13.0, height))
    circles, colours, over_angle, table = _panels(figure, len(paths), lines_of_rest)
    if rest:
        draw_rest(table[0], result, rest, 9.5)
    for row, path in enumerate(paths):
        lines = draw_path(circles[row], path)
        _angle_colours(figure, colours[row], lines, result)
        _over_angle(over_angle[row], result, path)
    angle_axis(over_angle, {"": result}, over_angle[-1:])
    return figure


def _panels(
    figure: Figure, paths: int, lines_of_rest: float
) -> tuple[list[Axes], list[Axes], list[Axes], list[Axes]]:
    """Return panels of circles, their colours, curves over the angle, and the table of the rest.

    A row has them beside each other; in a narrow figure curves stand below their circle.
    """
    rest = bool(lines_of_rest)
    if picture_format().stacks:
        heights = [1.6 * ROW, ROW] * paths + [lines_of_rest] * rest
        grid = figure.add_gridspec(len(heights), 2, width_ratios=(0.03, 1.0), height_ratios=heights)
        cells = [(grid[2 * row, 0], grid[2 * row, 1], grid[2 * row + 1, :]) for row in range(paths)]
    else:
        heights = [ROW] * paths + [lines_of_rest] * rest
        grid = figure.add_gridspec(
            len(heights), 3, width_ratios=(0.03, 1.0, 1.8), height_ratios=heights
        )
        cells = [(grid[row, 0], grid[row, 1], grid[row, 2]) for row in range(paths)]
    rows = [[figure.add_subplot(cell) for cell in row] for row in cells]
    colours, circles, curves = (list(column) for column in zip(*rows, strict=True))
    table = [figure.add_subplot(grid[-1, -1 if picture_format().stacks else 1 :])]
    if not lines_of_rest:
        table.pop().remove()
    return circles, colours, curves, table


def _angle_colours(
    figure: Figure, axes: Axes, lines: LineCollection | None, result: Result
) -> None:
    """Say which colour is which crank angle, if there are any."""
    if lines is None:
        axes.set_axis_off()
        return
    bar = figure.colorbar(lines, cax=axes, label="crank angle, deg")
    bar.set_ticks(list(angle_ticks(*angle_range({"": result}))))
    bar.ax.yaxis.set_ticks_position("left")
    bar.ax.yaxis.set_label_position("left")


def _over_angle(axes: Axes, result: Result, path: Path) -> None:
    """Draw the eccentricity of a journal or the height of a ball over the crank angle."""
    limit, ball = path.clearance, path.ball
    values = path.points[:, 1] if ball else path.distance
    names = ("height in its socket", "vertical eccentricity") if ball else ("eccentricity",) * 2
    axes.set(title=f"{path.title}: {names[0]}", ylabel=f"{names[1]}, µm")
    curve(axes, result, values, color=RUN, linewidth=0.9, label="centre")
    reach = 1.3 * max(path.reach, 1e-3 * limit) if path.small else 1.12 * max(path.reach, limit)
    axes.set_ylim(-reach if ball else 0.0, reach)
    if path.small:
        note(axes, f"the surfaces would touch at {limit:g} µm")
    else:
        for sign in (1, -1) if ball else (1,):
            line = axes.axhline(sign * limit, color=TOUCH_COLOUR, linewidth=1.2, zorder=1.8)
            band = axes.axhspan(sign * limit, sign * reach, color=SHADE, linewidth=0, zorder=0.5)
            if sign == 1:
                line.set_label("surfaces touch")
                band.set(label="penetration")
        legend_above(axes)
    ratio = axes.secondary_yaxis(
        "right", functions=(lambda e: np.divide(e, limit), lambda r: np.multiply(r, limit))
    )
    ratio.set_ylabel("eccentricity ratio", color=GREY)
