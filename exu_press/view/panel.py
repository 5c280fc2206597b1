"""A part of the picture: axes, and artists that change from frame to frame."""

from collections.abc import Sequence
from typing import Protocol

from matplotlib.artist import Artist

__all__ = ["Panel", "animated"]


class Panel(Protocol):
    """A part of the picture."""

    @property
    def artists(self) -> Sequence[Artist]:
        """Artists that change, in the order of drawing; everything else is drawn once."""

    def show(self, frame: int) -> None:
        """Bring the artists to a frame."""


def animated(*artists: Artist) -> list[Artist]:
    """Return artists, marked as drawn frame by frame."""
    for artist in artists:
        artist.set_animated(True)
    return list(artists)
