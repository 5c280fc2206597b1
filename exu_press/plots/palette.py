"""Colours and dashes of every picture and page, readable by the colour-blind and in grey."""

import itertools
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

__all__ = ["COLOURS", "GREY", "IDEAL", "SHADE", "colour_of", "line_of", "lines_of"]

COLOURS = {
    "blue": "#005A9E",
    "green": "#2BA84A",
    "orange": "#F9C74F",
    "vermilion": "#C84E00",
    "sky blue": "#6FB7EE",
    "purple": "#430B55",
}
"""Hues of Okabe and Ito's colour-blind-safe palette, less black (the ideal's) and yellow (too
pale), with lightnesses apart from each other, for grey prints: most for the first ones."""

DASHES = ("-", "-", "-", (0, (5, 1.5)), (0, (4, 1.2, 1, 1.2)), (0, (1, 0.8)))
"""Line styles of runs over each other: as in grey, those after the third are near earlier ones."""

IDEAL = "#000000"
GREY = "#767676"
SHADE = "#F1F4F7"


OURS: tuple[dict[str, Any], ...] = tuple(
    {"color": colour, "linestyle": dashes}
    for colour, dashes in zip(COLOURS.values(), DASHES, strict=True)
)

_LINES: ContextVar[tuple[dict[str, Any], ...]] = ContextVar("lines")


def colour_of(index: int) -> Any:
    """Return the colour of the n-th run in a picture; after the palette's end it starts again."""
    return line_of(index)["color"]


def line_of(index: int) -> dict[str, Any]:
    """Return colour and style of the line of the n-th run in a picture of several."""
    lines = _LINES.get(OURS)
    return {**lines[index % len(lines)]}


@contextmanager
def lines_of(cycle: Iterable[Mapping[str, Any]]) -> Iterator[None]:
    """Draw the curves of a block with the colours and line styles of a cycle, if it has any.

    Its other properties are left out, as markers: curves have thousands of points.
    """
    styles = [{key: line[key] for key in ("color", "linestyle") if key in line} for line in cycle]
    colours = itertools.cycle(COLOURS.values())
    lines = [{"color": next(colours), "linestyle": "-", **line} for line in styles if line]
    token = _LINES.set(tuple(lines) or OURS)
    try:
        yield
    finally:
        _LINES.reset(token)
