"""A mechanism before anything runs: its drawing, named, and the kinematics of its output."""

import textwrap
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from exu_press.mechanism import Mechanism
from exu_press.mechanism.examine import Examination
from exu_press.mechanism.parts import GROUND
from exu_press.mechanism.pitch_circles import pitch_circles
from exu_press.mechanism.shapes import shapes_of, slot_outlines, transform_points
from exu_press.mechanism.stroke import units_of_output
from exu_press.mechanism.transmission import group_equal_angles
from exu_press.numerics.arrays import Array
from exu_press.plots.format import picture_format
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import GREY, colour_of
from exu_press.plots.panels import figure_with_panels
from exu_press.plots.scales import spread
from exu_press.plots.style import points, with_style
from exu_press.plots.typesetting import plain, shorten, wrap_name, wrap_text

__all__ = ["drawing_figure"]

WRONG = "#C00000"
EDGE = "#333333"

WITH_CURVES = [[0, 1], [0, 2], [0, 3], [0, 4]]
"""Numbers of the drawing and of the panels beside it."""

LEAST_ANGLE = 40.0
"""deg; transmission angles below it are shaded."""

HIGHEST = 200.0
"""The mechanical advantage is drawn up to this multiple of its smallest value."""

LETTERS, LETTERS_ON_PAPER = 36, 18
"""Of a name, in a line beside the drawing; on paper where panels stand below each other."""

NAME, LINE = 8.5, 1.6
"""Size of names, points, and the distance of lines over it."""

TALL, TALL_ON_PAPER = 0.9, 1.25
"""Height of the drawing over its width, at least; likewise."""

SHORT = 21
"""Letters of a name in a legend beside a title, of which two stand in a row."""

MOST_TRANSMISSIONS = 6
"""More joints than this are not told apart by colours; those with the smallest angles are drawn."""


@with_style
def drawing_figure(examined: Examination, text: str, speed: float | None = None) -> Figure:
    """Return the drawing with names and, where the crank turns, curves over the crank angle.

    Bodies, joints and guides that are wrong are red; where links lock at a crank angle the drawing
    shows them there, too.

    Args:
        examined: the mechanism.
        text: about it, in lines.
        speed: of the crank, rad/s; velocities are per radian of the crank without it.
    """
    rows, widths = ([[0]], 14.0) if examined.stroke is None else (WITH_CURVES, (8.0, 6.0))
    heading = f"Drawing of {plain(examined.mechanism.name)}"
    figure, (drawing, *panels) = figure_with_panels(heading, text, rows, widths, 7.4 / len(rows))
    _draw(drawing, examined)
    if panels:
        _curves(panels, examined, speed)
    return figure


def _draw(axes: Axes, examined: Examination) -> None:
    """Draw bodies, joints and guides with their names; the wrong ones in red."""
    mechanism = examined.mechanism
    drawn = {b.name: np.array([*b.centre_of_mass, b.angle]) for b in mechanism.bodies}
    shapes = shapes_of(mechanism, mechanism.size)
    error = examined.error
    axes.set_aspect("equal", adjustable="box", anchor="C")
    if examined.stroke is not None:
        _draw_paths(axes, examined)
    layers = {"block": 0, "slide": 2}
    for body in sorted(mechanism.bodies, key=lambda body: layers.get(shapes[body.name].role, 1)):
        wrong = body.name in examined.wrong_bodies
        patch = Polygon(
            shapes[body.name].outline_at(drawn[body.name]),
            facecolor=shapes[body.name].colour,
            edgecolor=WRONG if wrong else EDGE,
            linewidth=2.0 if wrong else 0.9,
            alpha=0.85,
        )
        axes.add_patch(patch)
        for slot in shapes[body.name].slots:
            corners = transform_points(slot, drawn[body.name])
            axes.add_patch(Polygon(corners, facecolor="white", edgecolor=EDGE, linewidth=0.7))
    for corners in slot_outlines(mechanism, GROUND, mechanism.size):
        axes.add_patch(Polygon(corners, facecolor="white", edgecolor=GREY, zorder=0.8))
    if error is not None and error.angle and error.poses:
        for name, pose in error.poses.items():
            colour = WRONG if name in examined.wrong_bodies else GREY
            outline = shapes[name].outline_at(pose)
            axes.add_patch(Polygon(outline, fill=False, edgecolor=colour, linestyle="--"))
    axes.set_title(_complaints(examined), color=WRONG, fontsize=points(9.5), fontweight="normal")
    for joint in mechanism.joints:
        colour = WRONG if joint.name in examined.wrong_joints else EDGE
        style = "s" if joint.on_frame else "o"
        axes.plot(*joint.at, style, color="white", markeredgecolor=colour, markersize=7)
    for guide in mechanism.guides:
        if guide.at is not None:
            colour = WRONG if guide.key in examined.mobility.overconstraining else EDGE
            axes.plot(*guide.at, "o", color="white", markeredgecolor=colour, markersize=7)
    for body in mechanism.bodies:
        axes.plot(*body.centre_of_mass, "+", color=GREY, markersize=5, zorder=4)
    for guide in mechanism.guides:
        if guide.is_slot:
            continue
        at = np.array(mechanism.body(guide.body).centre_of_mass)
        ends = [at + sign * 0.16 * mechanism.size * np.array(guide.direction) for sign in (-1, 1)]
        colour = WRONG if guide.name in examined.wrong_guides else GREY
        axes.plot(*np.array(ends).T, color=colour, linewidth=1.2, linestyle="-.", zorder=0.8)
    for spring in mechanism.springs:
        outline = spring.outline(np.array(spring.at), mechanism.size)
        axes.plot(*outline.T, color=EDGE, linewidth=0.9, zorder=2.5)
    for outline in pitch_circles(mechanism):
        axes.plot(*outline.T, color=GREY, linewidth=0.9, linestyle=(0, (6, 3)), zorder=0.8)
    axes.autoscale_view()
    axes.margins(0.05)
    axes.set(xlabel="x, m", ylabel="y, m")
    _draw_names(axes, examined)


def _complaints(examined: Examination) -> str:
    texts = [*examined.faults]
    if examined.error is not None and examined.error.angle and examined.error.poses:
        texts.append(f"dashed: at crank angle {np.degrees(examined.error.angle):.4g} deg")
    return plain("\n".join(line for text in texts for line in textwrap.wrap(text, 150)))


def _draw_paths(axes: Axes, examined: Examination) -> None:
    """Draw the paths of the joints, and the output where it turns back."""
    mechanism, stroke = examined.mechanism, examined.stroke
    assert stroke is not None
    motion = mechanism.motion(np.append(stroke.angle, stroke.angle[:1]), 1.0)
    for joint in mechanism.joints:
        (body, point), _ = sorted(mechanism.ends(joint), key=lambda end: end[0] == GROUND)
        path = motion[body].point_motion(point).position
        axes.plot(*path[:, :2].T, color="#B9C6D2", linewidth=0.9, zorder=0.7)
    shape = shapes_of(mechanism, mechanism.size)[mechanism.slider]
    angles = np.array([centre.angle for centre in stroke.dead_centres])
    if len(angles):
        for pose in mechanism.motion(angles, 1.0)[mechanism.slider].position:
            outline = Polygon(shape.outline_at(pose), fill=False, edgecolor=GREY, linestyle=":")
            axes.add_patch(outline)


def _draw_names(axes: Axes, examined: Examination) -> None:
    """Name joints and springs at the left and bodies at the right, with lines to their places."""
    mechanism = examined.mechanism
    places: dict[tuple[float, float], list[str]] = {}
    for joint in mechanism.joints:
        places.setdefault(joint.at, []).append(joint.name)
    for guide in mechanism.guides:
        if guide.at is not None:
            places.setdefault(guide.at, []).append(guide.name)
    for spring in mechanism.springs:
        places.setdefault(tuple(np.mean(spring.at, axis=0)), []).append(spring.name)
    joints = {", ".join(names): np.array(at) for at, names in places.items()}
    wrong_joints = [n for n in joints if set(n.split(", ")) & set(examined.wrong_joints)]
    labels = {body.name: body.name for body in mechanism.bodies}
    for guide in mechanism.guides:
        if guide.is_slot:
            continue
        where = "guided" if guide.on_frame else f"on {guide.on}"
        labels[guide.body] += f" ({where})"
    bodies = {label: _middle(mechanism, name) for name, label in labels.items()}
    wrong = [labels[name] for name in examined.wrong_bodies]
    (left_edge, right_edge), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    room = 0.45 * max(right_edge - left_edge, top - bottom)
    tall = TALL_ON_PAPER if picture_format().stacks else TALL
    short = max(0.0, 0.5 * (tall * (right_edge - left_edge + 2.0 * room) - (top - bottom)))
    axes.set(xlim=(left_edge - room, right_edge + room), ylim=(bottom - short, top + short))
    _column(axes, joints, wrong_joints, left_edge - 0.02 * room, "right")
    _column(axes, bodies, wrong, right_edge + 0.02 * room, "left")


def _column(
    axes: Axes, named: Mapping[str, Array], wrong: Sequence[str], x: float, side: str
) -> None:
    """Write names in a column, spread over the height of the drawing."""
    letters = LETTERS_ON_PAPER if picture_format().stacks else LETTERS
    lines = {name: wrap_name(name, letters, "_") for name in named}
    figure = axes.get_figure(root=True)
    assert figure is not None
    width = 72.0 * figure.get_figwidth() * axes.get_position().width
    line = LINE * points(NAME) * float(np.ptp(axes.get_xlim())) / width
    sizes = [line * (text.count("\n") + 1) for text in lines.values()]
    heights = spread([float(at[1]) for at in named.values()], sizes)
    for (name, at), y in zip(named.items(), heights, strict=True):
        colour = WRONG if name in wrong else "black"
        axes.annotate(
            lines[name],
            (float(at[0]), float(at[1])),
            (x, y),
            fontsize=points(NAME),
            color=colour,
            ha=side,
            va="center",
            arrowprops={"arrowstyle": "-", "color": "#9A9A9A", "linewidth": 0.5},
        )


def _middle(mechanism: Mechanism, body: str) -> Array:
    """Return the middle of a body's joints in the drawing; its centre of mass without joints."""
    points = [joint.at for joint in mechanism.joints_of(body)]
    return np.asarray(np.mean(points or [mechanism.body(body).centre_of_mass], axis=0))


def _curves(panels: Sequence[Axes], examined: Examination, speed: float | None) -> None:
    """Draw position, velocity, mechanical advantage and transmission angles of the output."""
    stroke = examined.stroke
    assert stroke is not None
    angle = np.degrees(stroke.angle)
    output = plain(examined.mechanism.slider)
    position, velocity, advantage, transmission = panels
    units = units_of_output(examined.mechanism)
    position.plot(angle, units.position_scale * stroke.position, color=colour_of(0))
    position.set(title=f"Position of {output}", ylabel=units.position)
    for centre in stroke.dead_centres:
        at = float(np.degrees(centre.angle))
        position.plot(
            at, units.position_scale * centre.position, "o", color=colour_of(0), markersize=4
        )
    if speed is None:
        velocity.plot(angle, units.velocity_scale * stroke.velocity, color=colour_of(0))
        velocity.set(title="Velocity per radian of the crank", ylabel=units.velocity)
    else:
        velocity.plot(angle, speed * stroke.velocity, color=colour_of(0))
        velocity.set(title=f"Velocity at {speed * 30.0 / np.pi:g} rpm", ylabel=units.speed)
    least = float(stroke.mechanical_advantage.min())
    advantage.plot(angle, stroke.mechanical_advantage, color=colour_of(0))
    kind = units.ratio.partition(" ")[0]
    advantage.set(
        title=wrap_text(f"Mechanical advantage: {kind} per torque of the crank"),
        ylabel=units.advantage,
    )
    if np.isfinite(least):
        advantage.set(yscale="log", ylim=(0.7 * least, HIGHEST * least))
        advantage.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        advantage.yaxis.set_minor_formatter(NullFormatter())
    curves = group_equal_angles(examined.transmission)
    for index, (name, values) in enumerate(curves[:MOST_TRANSMISSIONS]):
        degrees = np.degrees(values)
        transmission.plot(angle, degrees, color=colour_of(index), label=plain(shorten(name, SHORT)))
    transmission.axhspan(0.0, LEAST_ANGLE, color=WRONG, alpha=0.06, linewidth=0)
    transmission.set(title="Transmission angle", ylabel="deg", ylim=(0.0, 92.0))
    transmission.set_yticks([0, 30, 60, 90])
    transmission.set_xlabel("crank angle from the drawing, deg")
    if curves:
        legend_above(transmission, columns=2)
    else:
        transmission.text(
            180.0, 45.0, "no dyads: its bodies close in larger groups", ha="center", color=GREY
        )
    for panel in panels:
        panel.set_xlim(0.0, 360.0)
        panel.set_xticks(range(0, 361, 60))
        for centre in stroke.dead_centres:
            at = float(np.degrees(centre.angle))
            panel.axvline(at, color=GREY, linewidth=0.9, linestyle=(0, (1, 2)), zorder=0.9)
