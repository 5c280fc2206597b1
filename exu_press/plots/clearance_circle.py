"""The path of a journal or ball centre inside its clearance circle."""

import textwrap
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Circle
from matplotlib.ticker import MaxNLocator

from exu_press.numerics.arrays import Array
from exu_press.plots.canvas import crank_degrees
from exu_press.plots.decimate import visible_segments
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import COLOURS, GREY, SHADE, colour_of
from exu_press.plots.style import PATH_COLOURS, points
from exu_press.result import JointRecord, Result

__all__ = ["TOUCH_COLOUR", "Path", "draw_path"]

MICRO = 1e6

SMALL_PATH = 0.4
"""A path within this part of the clearance circle is magnified, the whole circle inset."""

MARGIN = 1.15

LETTERS = 18
"""Letters of a joint's name that fit in a line beside the legend."""

PIXELS = 200
"""From the middle of a circle's panel to its edge, at least."""

TOUCH_COLOUR = COLOURS["vermilion"]

SMALL_TEXT: dict[str, Any] = {"fontsize": "small", "fontweight": "normal", "pad": 2}


@dataclass(frozen=True)
class Path:
    """One joint's eccentricity.

    Attributes:
        title: of the joint.
        result: of the run.
        joint: its name.
    """

    title: str
    result: Result
    joint: str

    @property
    def record(self) -> JointRecord:
        """The joint's record."""
        return self.result.joints[self.joint]

    @property
    def ball(self) -> bool:
        """Return whether this is a spherical joint."""
        return self.record.spherical

    @property
    def points(self) -> Array:
        """Eccentricity in the x-y plane, (n, 2), um."""
        return MICRO * self.record.eccentricity[:, :2]

    @property
    def distance(self) -> Array:
        """Its magnitude, (n,), um."""
        return MICRO * self.record.distance

    @property
    def reach(self) -> float:
        """Largest eccentricity, um."""
        return float(self.distance.max())

    @property
    def small(self) -> bool:
        """Return whether the path would be hard to see at the circle's scale."""
        return self.reach < SMALL_PATH * self.clearance

    @property
    def vertical(self) -> bool:
        """Return whether the path looks like a vertical line, as of a ball with ideal guides."""
        return float(np.abs(self.points[:, 0]).max()) < 1e-3 * max(self.reach, 1e-9)

    @property
    def clearance(self) -> float:
        """Radial clearance, um."""
        return MICRO * self.record.clearance


def draw_path(axes: Axes, path: Path) -> LineCollection | None:
    """Draw a path in its circle (um), magnified if it is small.

    Returns:
        The lines that crank angles colour; None for a vertical path, which runs over itself.
    """
    axes.set(title=textwrap.fill(path.title, LETTERS), xlabel="x, µm", ylabel="y, µm")
    limit = path.clearance
    half = MARGIN * max(path.reach, limit)
    if path.small:
        half = 1.35 * max(path.reach, 1e-3 * limit)
        inset = axes.inset_axes(corner := _free_corner(path.points, half))
        side: Any = "left" if corner[0] < 0.5 else "right"  # the text may be longer than the inset
        inset.set_title("whole clearance", loc=side, color=GREY, **SMALL_TEXT)
        _draw(inset, path, MARGIN * limit, linewidth=0.6)
        inset.set(xticks=[], yticks=[])
    lines = _draw(axes, path, half, linewidth=1.0)
    for point, marker, label in ((path.points[0], "o", "start"), (path.points[-1], "s", "end")):
        axes.plot(
            *point,
            marker,
            markersize=points(6),
            markerfacecolor="white",
            markeredgecolor="black",
            zorder=4,
            clip_on=False,
            label=label,
        )
    legend_above(axes)
    if path.ball and path.vertical and not path.small:
        for sign, words in ((1, "lifts\nslider"), (-1, "pushes\ndown")):
            axes.text(
                0.08 * limit, 0.4 * sign * limit, words, va="center", fontsize=points(9), color=GREY
            )
    return None if path.vertical else lines


def _draw(axes: Axes, path: Path, half: float, linewidth: float) -> LineCollection:
    """Draw circle and path in a square of +-half; beyond the circle the surfaces penetrate."""
    axes.set_aspect("equal", adjustable="box")
    axes.set(xlim=(-half, half), ylim=(-half, half), facecolor=SHADE)
    axes.grid(False)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    axes.spines[:].set_visible(True)
    circle = {"radius": path.clearance, "linewidth": points(1.2)}
    axes.add_patch(Circle((0, 0), **circle, facecolor="white", edgecolor="none", zorder=0.4))
    axes.add_patch(Circle((0, 0), **circle, fill=False, edgecolor=TOUCH_COLOUR, zorder=1.8))
    for line in (axes.axhline, axes.axvline):
        line(0.0, color="#D0D0D0", linewidth=0.6, zorder=0.6)
    angle, places = crank_degrees(path.result), path.points
    segments = visible_segments(places, half / PIXELS)
    lines = LineCollection(
        list(places[segments]),
        norm=Normalize(angle[0], max(angle[-1], angle[0] + 1e-3)),
        linewidths=points(linewidth),
        capstyle="round",
        zorder=2,
    )
    if path.vertical:
        lines.set(color=colour_of(0), linewidths=points(2.0))
    else:
        lines.set(cmap=PATH_COLOURS, array=angle[segments].mean(axis=1))
    axes.add_collection(lines, autolim=False)
    return lines


def _free_corner(points: Array, half: float) -> tuple[float, float, float, float]:
    """Return the bounds, in parts of the panel, of the corner with the fewest points in it."""
    size, gap, title = 0.27, 0.025, 0.08
    corners = [(x, y) for y in (1 - gap - size - title, gap) for x in (1 - gap - size, gap)]
    positions = (points / half + 1.0) / 2.0

    def crowd(corner: tuple[float, float]) -> int:
        inside = (positions > np.array(corner) - gap) & (positions < np.array(corner) + size + gap)
        return int(np.count_nonzero(inside.all(axis=1)))

    return (*min(corners, key=crowd), size, size)
