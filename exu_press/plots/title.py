"""A figure with a heading and a text below it."""

import textwrap

from matplotlib.figure import Figure
from matplotlib.text import Annotation

from exu_press.plots.format import picture_format
from exu_press.plots.style import points
from exu_press.plots.typesetting import plain

__all__ = ["figure_with_title"]

LETTERS = 13.5
"""Of the text, in an inch."""

NARROWEST = 7.5
"""inch, in which a heading has room beside a legend."""


def figure_with_title(
    heading: str, text: str, size: tuple[float, float], *, stacked: bool = False
) -> Figure:
    """Return a figure without pyplot.

    Args:
        heading: of the picture.
        text: below it, in lines.
        size: width and height on a screen, inch; a figure of one narrow panel is as wide as its
            heading.
        stacked: whether its columns stand below each other in a narrow figure on paper.

    A figure on paper has neither: its caption does.
    """
    form = picture_format()
    width, height = size
    if form.width is not None:
        paper = form.size(width, height, stacked=stacked and form.stacks)
        return Figure(figsize=paper, layout="constrained")
    figure = Figure(figsize=(max(width, NARROWEST), height), layout="constrained")
    most = int(LETTERS * figure.get_figwidth())
    lines = [piece for line in text.splitlines() for piece in textwrap.wrap(line, most)]
    text = plain("\n".join(["", *lines]))  # an empty line, where the heading goes
    below = figure.suptitle(text, x=0.012, ha="left", fontsize=points(9.5), linespacing=1.45)
    figure.add_artist(
        Annotation(
            heading, (0, 1), xycoords=below, va="top", fontsize=points(13), fontweight="bold"
        )
    ).set_in_layout(False)
    return figure
