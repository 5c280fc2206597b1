"""A figure with a heading and a text below it."""

from matplotlib.figure import Figure
from matplotlib.text import Annotation

from exu_press.plots.typesetting import plain

__all__ = ["headed_figure"]


def headed_figure(heading: str, text: str, size: tuple[float, float]) -> Figure:
    """Return a figure without pyplot.

    Args:
        heading: of the picture.
        text: below it, in lines.
        size: width and height, inch.
    """
    figure = Figure(figsize=size, layout="constrained")
    text = plain(f"\n{text}")  # an empty line, where the heading goes
    below = figure.suptitle(text, x=0.012, ha="left", fontsize=9.5, linespacing=1.45)
    figure.add_artist(
        Annotation(heading, (0, 1), xycoords=below, va="top", fontsize=13, fontweight="bold")
    ).set_in_layout(False)
    return figure
