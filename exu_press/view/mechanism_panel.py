"""The mechanism from the front, to scale, with its guides, pivots and dead centres."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon

from exu_press.mechanism import Mechanism
from exu_press.mechanism.parts import GROUND, Point
from exu_press.mechanism.pitch_circles import pitch_circles
from exu_press.mechanism.shapes import FrontView, Mark, transform_points
from exu_press.mechanism.spring_motion import spring_ends
from exu_press.numerics.arrays import Array
from exu_press.plots.palette import COLOURS, GREY
from exu_press.plots.scales import spread
from exu_press.plots.style import points
from exu_press.plots.typesetting import shorten
from exu_press.plots.words import joint_in_words
from exu_press.result import Result
from exu_press.scene import mechanism_of
from exu_press.view.instants import Instants
from exu_press.view.panel import mark_animated

__all__ = ["MARKED", "MechanismPanel", "poses"]

MARKED = COLOURS["vermilion"]
"""Joints with clearance, here and magnified."""

NAME = 24
"""Letters of a body's name that fit beside the magnified joints."""

LINE = 0.04
"""Height of a label over that of a panel."""

EDGE = "#333333"

FIXED: dict[str, Any] = {
    "facecolor": "white", "edgecolor": "#8A8A8A", "hatch": "/////", "linewidth": 0.6
}  # fmt: skip
"""Looks of the frame."""


class MechanismPanel:
    """Draws every body at its pose; the ideal mechanism's dead centres stand beside the slider."""

    def __init__(self, axes: Axes, result: Result, instants: Instants) -> None:
        mechanism = mechanism_of(result.scene)
        self._poses = poses(result, mechanism, instants)
        front = FrontView(mechanism)
        ends = front.dead_centres()
        self._shapes, unit, low, high = front.shapes, front.unit, front.low, front.high
        _draw_frame(axes, mechanism, front)
        dead_centres = _draw_dead_centres(axes, ends, unit)
        lowest_x = float(low[0])
        if ends:
            outline = front.swept[mechanism.slider]
            lowest_x = min(lowest_x, float(outline[:, 0].min()) - 0.09 * unit)
        axes.set_aspect("equal", adjustable="box", anchor="W")
        axes.set_axis_off()
        axes.set(
            xlim=(lowest_x - 0.03 * unit, high[0] + 0.33 * unit),
            ylim=(low[1] - 0.03 * unit, high[1] + 0.03 * unit),
        )
        self._middles = {
            name: _middle_of_outline(shape.outline, self._poses[name])
            for name, shape in front.shapes.items()
        }
        self._leaders = _draw_labels(axes, mechanism, self._middles, float(high[0]), unit)
        self._bodies: dict[str, Polygon] = {}
        self._slots: dict[str, list[Polygon]] = {}
        for name in sorted(front.shapes, key=front.layer):
            self._bodies[name] = patch = Polygon(
                front.shapes[name].outline,
                closed=True,
                facecolor=front.shapes[name].colour,
                edgecolor=EDGE,
                linewidth=0.9,
                joinstyle="round",
            )
            axes.add_patch(patch)
            self._slots[name] = [
                Polygon(slot, facecolor="white", edgecolor=EDGE, linewidth=0.7)
                for slot in front.shapes[name].slots
            ]
            for slot in self._slots[name]:
                axes.add_patch(slot)
        names = result.scene.joints.ideal
        ideal = [joint for joint in mechanism.joints if joint.name in names]
        loose = [joint for joint in mechanism.joints if joint.name not in names]
        pins_in_slots = [mechanism.guided_end(g) for g in mechanism.guides if g.is_slot]
        self._joints = [mechanism.ends(joint)[0] for joint in ideal]
        self._joints += [*pins_in_slots, *(mechanism.ends(joint)[0] for joint in loose)]
        size = 4.5
        (pins,) = axes.plot([], [], "o", markersize=size, color="white", markeredgecolor=EDGE)
        (marked,) = axes.plot(
            [], [], "o", markersize=size + 2.5, color="white", markeredgecolor=MARKED
        )
        marked.set_markeredgewidth(2.2)
        self._pins, self._marked, self._split = pins, marked, len(ideal) + len(pins_in_slots)
        self._springs = [
            (
                spring,
                spring_ends(mechanism, spring),
                axes.plot([], [], color=EDGE, linewidth=0.9)[0],
            )
            for spring in mechanism.springs
        ]
        self._unit = front.unit
        patches = [
            patch for name, body in self._bodies.items() for patch in (body, *self._slots[name])
        ]
        lines = [line for line, _ in self._leaders.values()]
        lines += [line for *_, line in self._springs]
        self.artists = mark_animated(*patches, pins, marked, *lines, *dead_centres)

    def show(self, frame: int) -> None:
        """Bring every body to its pose."""
        for name, patch in self._bodies.items():
            pose = self._poses[name][frame]
            patch.set_xy(self._shapes[name].outline_at(pose))
            for corners, slot in zip(self._shapes[name].slots, self._slots[name], strict=True):
                slot.set_xy(transform_points(corners, pose))
        for name, (line, (x, y)) in self._leaders.items():
            line.set_data(*np.array([self._middles[name][frame], (x, y)]).T)
        for spring, spring_points, line in self._springs:
            ends = np.array([self._point(frame, *end) for end in spring_points])
            line.set_data(*spring.outline(ends, self._unit).T)
        places = np.array([self._point(frame, body, point) for body, point in self._joints])
        self._pins.set_data(*places[: self._split].T)
        self._marked.set_data(*places[self._split :].T)

    def _point(self, frame: int, body: str, point: Point) -> Array:
        """Return the position of a point of a body, or of the frame."""
        pose = np.zeros(3) if body == GROUND else self._poses[body][frame]
        return np.asarray(transform_points(np.array([point]), pose)[0])


def poses(result: Result, mechanism: Mechanism, instants: Instants) -> dict[str, Array]:
    """Return the poses (m, 3) of every body's centre of mass at the frames' instants.

    Between the integrator's steps they are interpolated linearly: 3 um off at most, with the
    largest steps of 1.5 degrees. A flexible body's joints are drawn where its mean frame has them.
    """
    stored = result["body_position"]
    pose_of_body = {}
    for index, name in enumerate(result.bodies):
        pose_of_body[name] = np.column_stack(
            [np.interp(instants.time, result.time, stored[:, index, k]) for k in range(3)]
        )
    return pose_of_body


def _middle_of_outline(outline: Array, body_poses: Array) -> Array:
    """Return the positions (m, 2) of a drawn body's middle; its centre of mass may be elsewhere."""
    middle = 0.5 * (outline.min(axis=0) + outline.max(axis=0))
    return np.array([transform_points(middle[None], pose)[0] for pose in body_poses])


def _draw_frame(axes: Axes, mechanism: Mechanism, front: FrontView) -> None:
    """Draw the guides beside their bodies, pitch circles, and the pivots in the frame."""
    for rail in front.rails():
        axes.add_patch(Polygon(rail, **FIXED))
    for outline in pitch_circles(mechanism):
        axes.plot(*outline.T, color=GREY, linewidth=0.9, linestyle=(0, (6, 3)))
    for joint in mechanism.joints:
        if joint.on_frame:
            axes.add_patch(Circle(joint.at, 0.026 * front.unit, **FIXED))


def _draw_dead_centres(axes: Axes, ends: Sequence[Mark], unit: float) -> list[Artist]:
    """Mark the slider's leading edge with ideal joints in both dead centres; return the marks."""
    artists: list[Artist] = []
    for mark in ends:
        line = mark.position + np.outer([0.01 * unit, 0.035 * unit], mark.direction)
        artists += axes.plot(*line.T, color=GREY, linewidth=0.9)
        x, y = line[1] + 0.006 * unit * mark.direction
        side = "bottom" if mark.is_above else "top"
        label = axes.text(x, y, mark.label, fontsize=points(7.5), color=GREY, va=side, ha="right")
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.5})
        artists.append(label)
    return artists


def _draw_labels(
    axes: Axes, mechanism: Mechanism, middles: dict[str, Array], right: float, unit: float
) -> dict[str, tuple[Line2D, Point]]:
    """Name the bodies at the right, each once; return by body the line to it and where it begins.

    The other end follows the body from frame to frame. One that leaves the picture is named at its
    edge.
    """
    panel, edges = axes.get_window_extent(), axes.get_ylim()
    drawn = max(np.ptp(edges), np.ptp(axes.get_xlim()) * panel.height / panel.width)
    named = {
        body.name: shorten(joint_in_words(body.name.removesuffix("_right")).lower(), NAME)
        for body in mechanism.bodies
        if not body.name.endswith("_left")
    }
    means = np.array([middles[name][:, 1].mean() for name in named])
    sizes = [LINE * drawn] * len(named)
    heights = spread(np.clip(means, min(edges), max(edges)), sizes)
    leaders: dict[str, tuple[Line2D, Point]] = {}
    for (name, words), y in zip(named.items(), heights, strict=True):
        axes.text(right + 0.12 * unit, y, words, fontsize=points(8.5), va="center")
        (line,) = axes.plot([], [], color="#9A9A9A", linewidth=0.6)
        leaders[name] = line, (right + 0.11 * unit, y)
    return leaders
