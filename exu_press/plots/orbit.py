"""Motion of journals and balls in their clearance: path in the circle, eccentricity over angle."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.errors import InputError
from exu_press.plots.busiest import busiest
from exu_press.plots.canvas import angle_axis, angle_range, curve, run_figure
from exu_press.plots.clearance_circle import TOUCH_COLOUR, Path, draw_path
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import SHADE, colour_of
from exu_press.plots.panels import grid_rows
from exu_press.plots.peaks import draw_rest
from exu_press.plots.scales import angle_ticks, note
from exu_press.plots.style import points, with_style
from exu_press.result import Result

__all__ = ["MOST_JOINTS", "orbit_figure"]

ROW = 3.75  # inch
LINE = 0.19  # inch

MOST_JOINTS = 4
"""Joints whose paths are drawn, the busiest ones; the rest stand in a table below them."""


@with_style
def orbit_figure(result: Result) -> Figure:
    """Return the paths of journal and ball centres in their clearance circles, joint by joint.

    On the left the path (um, x-y plane), coloured by crank angle; on the right over the crank angle
    the eccentricity of a journal, or the height of a ball in its socket, which ideal guides let
    move only vertically, over the clearance. Outside the circle the surfaces penetrate each other.
    Of two balls that do the same one is shown.

    Raises:
        InputError: the scene has no clearance joint.
    """
    names = sorted(result.clearance_joints, key=lambda n: (result.joints[n].spherical, n))
    drawn, rest = busiest([result], names, "eccentricity", MOST_JOINTS)
    paths = [Path(title, result, name) for name, title in drawn.items()]
    if not paths:
        raise InputError("orbit_figure: this scene has no joint with clearance; draw its forces")
    rows, count = [*grid_rows(2 * len(paths), 2)], 2 * len(paths)
    heights = [ROW] * len(paths)
    if rest:
        rows, heights = [*rows, [count, count]], [*heights, LINE * (len(rest) + 2)]
    heading = "Journal and ball centres in their clearance"
    figure, panels = run_figure(heading, {"": result}, rows, (4.5, 8.5), heights)
    for axes in panels[count:]:
        draw_rest(axes, result, rest, points(9.5))
    for circle, over_angle, path in zip(panels[:count:2], panels[1:count:2], paths, strict=True):
        if lines := draw_path(circle, path):
            bar = figure.colorbar(lines, ax=circle, location="left", label="crank angle, deg")
            bar.set_ticks(list(angle_ticks(*angle_range({"": result}))))
        _over_angle(over_angle, result, path)
    angle_axis(panels[1:count:2], {"": result})
    return figure


def _over_angle(axes: Axes, result: Result, path: Path) -> None:
    """Draw the eccentricity ratio of a journal or of a ball's height over the crank angle."""
    values, reach = (path.points[:, 1] if path.ball else path.distance), path.reach
    values, reach = values / path.clearance, reach / path.clearance
    names = (
        ("height in its socket", "vertical eccentricity") if path.ball else ("eccentricity",) * 2
    )
    axes.set(title=f"{path.title}: {names[0]}", ylabel=f"{names[1]} ratio")
    curve(axes, result, values, color=colour_of(0), linewidth=0.9, label="centre")
    reach = 1.3 * max(reach, 1e-3) if path.small else 1.12 * max(reach, 1.0)
    axes.set_ylim(-reach if path.ball else 0.0, reach)
    if path.small:
        note(axes, f"the surfaces would touch at 1, which is {path.clearance:g} µm")
        return
    for sign in (1, -1) if path.ball else (1,):
        line = axes.axhline(sign, color=TOUCH_COLOUR, linewidth=1.2, zorder=1.8)
        band = axes.axhspan(sign, sign * reach, color=SHADE, linewidth=0, zorder=0.5)
        if sign == 1:
            line.set_label("surfaces touch")
            band.set(label="penetration")
    legend_above(axes)
