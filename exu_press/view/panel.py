"""Parts of the picture: axes with artists that change from frame to frame; a curve."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from exu_press.numerics.arrays import Array
from exu_press.plots.decimate import decimate
from exu_press.plots.palette import colour_of
from exu_press.result import Result
from exu_press.view.instants import Instants

__all__ = ["CurvePanel", "Panel", "mark_animated"]

PALE = "#B5CDE0"


class Panel(Protocol):
    """A part of the picture."""

    @property
    def artists(self) -> Sequence[Artist]:
        """Artists that change, in the order of drawing; everything else is drawn once."""

    def show(self, frame: int) -> None:
        """Bring the artists to a frame."""


def mark_animated(*artists: Artist) -> list[Artist]:
    """Return artists, marked as drawn frame by frame."""
    for artist in artists:
        artist.set_animated(True)
    return list(artists)


class CurvePanel:
    """One channel over the crank angle."""

    def __init__(self, axes: Axes, result: Result, values: Array, instants: Instants) -> None:
        steps_in_view = slice(int(instants.step[0]), int(instants.step[-1]) + 1)
        degrees = np.degrees(result["crank_angle"])
        self._instants, self._degrees, self._values = instants, degrees, values
        decimated = steps_in_view.start + decimate(degrees[steps_in_view], values[steps_in_view])
        self._x, self._y = degrees[decimated], values[decimated]
        axes.plot(self._x, self._y, color=PALE, linewidth=0.9)
        (self._line,) = axes.plot([], [], color=colour_of(0), linewidth=1.2)
        (self._dot,) = axes.plot(
            [], [], "o", markersize=5, color=colour_of(0), markeredgecolor="white"
        )
        self._cursor = axes.axvline(degrees[steps_in_view.start], color="black", linewidth=0.8)
        self.artists = mark_animated(self._cursor, self._line, self._dot)

    def show(self, frame: int) -> None:
        """Draw the curve up to a frame."""
        step = int(self._instants.step[frame])
        now = self._degrees[step]
        past = int(np.searchsorted(self._x, now, side="right"))
        self._line.set_data(self._x[:past], self._y[:past])
        self._dot.set_data([now], [self._values[step]])
        self._cursor.set_xdata([now, now])
