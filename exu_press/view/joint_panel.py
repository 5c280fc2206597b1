"""A joint with clearance, magnified: the journal in its bearing, its path, and the force on it."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch

from exu_press.numerics.arrays import Array, lengths
from exu_press.plots.palette import COLOURS, GREY, colour_of
from exu_press.plots.style import points
from exu_press.plots.typesetting import shorten
from exu_press.quantities.uncertain import significant
from exu_press.result import Result
from exu_press.scene import mechanism_of
from exu_press.view.instants import Instants
from exu_press.view.mechanism_panel import MARKED
from exu_press.view.panel import mark_animated

__all__ = ["JointPanel"]

BORE = 1.0
CLEARANCE = 0.45
"""The drawn clearance; the journal touches the bore where the eccentricity ratio is 1."""

RIM = 1.18
"""The bearing's outside, up to which the journal may sink into the bore."""

TITLE = 50
"""Letters of a title that fit beside the next panel."""

SMALL_PATH = 0.2
"""Paths within this eccentricity ratio are shown once more, magnified."""

ARROW = 0.9
"""Length of the largest force's arrow."""

OIL, STEEL, METAL, EDGE = "#D9ECF8", "#D5D9DD", "#EFD9A7", "#333333"
FORCE = COLOURS["purple"]


class JointPanel:
    """The clearance is drawn as large as the bearing, so that contact looks like contact."""

    def __init__(
        self, axes: Axes, result: Result, name: str, title: str, instants: Instants
    ) -> None:
        joint = result.joints[name]
        ball, radial = joint.spherical, joint.clearance
        self._clearance, self._ball, self._instants = radial, ball, instants
        self._ratio = joint.eccentricity[:, :2] / radial
        self._distance = joint.distance / radial
        self._force = joint.force[:, :2]
        self._size = lengths(joint.force)
        self._turn = _journal_angle(result, name)
        steps_in_view = slice(int(instants.step[0]), int(instants.step[-1]) + 1)
        self._first = steps_in_view.start
        self._largest = float(self._size[steps_in_view].max()) or 1.0
        self._revolution = 60.0 / result.scene.speed_rpm
        self._time = result.time

        reach = float(self._distance[steps_in_view].max())
        self._drawn = drawn = drawn_clearance(reach)
        self._radius = radius = BORE - drawn
        axes.set_aspect("equal", adjustable="box")
        axes.set_axis_off()
        axes.set(xlim=(-1.25, 2.15), ylim=(-1.6, 1.5))
        properties = f", {joint.kind}, clearance {radial * 1e6:.4g} µm"
        axes.set_title(shorten(title, TITLE - len(properties)) + properties, fontsize=points(8.6))
        axes.add_patch(Circle((0, 0), RIM, facecolor=STEEL, edgecolor=EDGE, linewidth=0.8))
        inside = OIL if joint.kind == "lubricated" else "white"
        axes.add_patch(Circle((0, 0), BORE, facecolor=inside, edgecolor=EDGE, linewidth=0.8))
        axes.text(
            -1.22,
            -1.26,
            _legend("ball" if ball else "journal", self._largest, instants.still),
            fontsize=points(7.0),
            color=GREY,
            va="top",
        )
        self._journal = Circle((0, 0), radius, facecolor=METAL, edgecolor=EDGE, linewidth=0.9)
        axes.add_patch(self._journal)
        (self._spoke,) = axes.plot([], [], color="#8C6D1F", linewidth=1.6)
        circle = axes.add_patch(
            Circle((0, 0), drawn, fill=False, edgecolor=MARKED, linewidth=1.1, linestyle="--")
        )
        (self._path,) = axes.plot([], [], color=colour_of(0), linewidth=0.8)
        (self._centre,) = axes.plot(
            [], [], "o", markersize=4.5, color=colour_of(0), markeredgecolor="white"
        )
        self._arrow = FancyArrowPatch(
            (0, 0), (0, 0), mutation_scale=11, linewidth=2.0, color=FORCE, shrinkA=0, shrinkB=0
        )
        axes.add_patch(self._arrow)
        self._words = axes.text(-1.22, 1.44, "", fontsize=points(8.5), va="center", ha="left")
        extra: list[Any] = []
        self._zoom: tuple[Line2D, Line2D] | None = None
        if reach < SMALL_PATH:
            extra = self._draw_zoom(axes, 1.25 * max(reach, 1e-6))
        self.artists = mark_animated(
            self._journal,
            self._spoke,
            circle,
            self._path,
            self._centre,
            self._arrow,
            self._words,
            *extra,
        )

    def _draw_zoom(self, axes: Axes, half: float) -> list[Any]:
        """Add the path's surroundings, magnified, in a corner; the half width is in clearances."""
        zoom = axes.inset_axes((1.3, -1.18, 0.8, 0.8), transform=axes.transData)
        zoom.set(xlim=(-half, half), ylim=(-half, half), xticks=[], yticks=[])
        zoom.set_aspect("equal")
        zoom.grid(False)
        zoom.spines[:].set_visible(True)
        zoom.axhline(0.0, color="#D0D0D0", linewidth=0.6)
        zoom.axvline(0.0, color="#D0D0D0", linewidth=0.6)
        width = 2e6 * half * self._clearance
        title = f"path,\n{significant(width, 2)} µm wide"
        zoom.set_title(title, fontsize=points(7), fontweight="normal", pad=2.5)
        (path,) = zoom.plot([], [], color=colour_of(0), linewidth=0.8)
        (centre,) = zoom.plot([], [], "o", markersize=3.5, color=colour_of(0))
        self._zoom = path, centre
        return [path, centre]

    def show(self, frame: int) -> None:
        """Bring the journal to its place; the path shows the last revolution."""
        step = int(self._instants.step[frame])
        since = self._instants.steps_since_last(frame)
        begin = np.searchsorted(self._time, self._time[step] - self._revolution)
        path = self._ratio[max(int(begin), self._first) : step + 1]
        x, y = self._ratio[step]
        centre = self._drawn * np.array([x, y])
        self._path.set_data(*(self._drawn * path.T))
        self._centre.set_data([centre[0]], [centre[1]])
        self._journal.set_center((float(centre[0]), float(centre[1])))
        if not self._ball:
            turn = self._turn[step]
            tip = self._radius * np.array([-np.sin(turn), np.cos(turn)])
            self._spoke.set_data(
                [centre[0] + 0.72 * tip[0], centre[0] + tip[0]],
                [centre[1] + 0.72 * tip[1], centre[1] + tip[1]],
            )
        largest = since.start + int(np.argmax(self._size[since]))
        size = float(self._size[largest])
        self._arrow.set_visible(size > 1e-4 * self._largest)
        if self._arrow.get_visible():
            along = self._force[largest] / max(float(np.linalg.norm(self._force[largest])), 1e-300)
            tip = centre + ARROW * np.sqrt(size / self._largest) * along
            self._arrow.set_positions(tuple(centre), tuple(tip))
        self._words.set_text(self._in_words(step, size))
        if self._zoom is not None:
            line, dot = self._zoom
            line.set_data(*path.T)
            dot.set_data([x], [y])

    def _in_words(self, step: int, force: float) -> str:
        distance = float(self._distance[step])
        gap = (1.0 - distance) * self._clearance * 1e6
        named = f"gap {gap:.1f} µm" if gap >= 0.0 else f"penetration {-gap:.2f} µm"
        return f"e/c = {distance:.3f},  {named},  F = {_in_newtons(force)}"


def drawn_clearance(reach: float) -> float:
    """Return the clearance in the drawing, where the bore's radius is 1.

    A journal that sinks deep into its bearing is drawn with less of it, so that it stays inside the
    bearing's rim.

    >>> drawn_clearance(1.1), round(drawn_clearance(1.9), 6)
    (0.45, 0.2)
    """
    return min(CLEARANCE, (RIM - BORE) / max(reach - 1.0, 1e-9))


def _journal_angle(result: Result, name: str) -> Array:
    """Return how far the journal's body is turned, (n,), rad."""
    joints = mechanism_of(result.scene).joints
    body = next(joint.journal for joint in joints if joint.name == name)
    return np.asarray(result["body_position"][:, result.bodies.index(body), 2])


def _legend(body: str, largest: float, still: bool) -> str:
    what = (
        f"force on the {body}" if still else f"largest force on the {body} since the frame before"
    )
    return f"F, arrow: {what},\nlength as its square root, full at {_in_newtons(largest)}"


def _in_newtons(force: float) -> str:
    if abs(force) < 100.0:
        return f"{significant(force, 3)} N"
    return f"{significant(force / 1e3, 3)} kN" if abs(force) < 9.995e5 else f"{force / 1e3:.0f} kN"
