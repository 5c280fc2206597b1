"""Colours and dashes of every picture and page, readable by the colour-blind and in grey."""

from typing import Any

__all__ = ["COLOURS", "GREY", "IDEAL", "RUN", "SHADE", "colour_of", "line_of"]

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

RUN = COLOURS["blue"]
IDEAL = "#000000"
GREY = "#767676"
SHADE = "#F1F4F7"


def colour_of(index: int) -> str:
    """Return the colour of the n-th run in a picture; after the palette's end it starts again."""
    return tuple(COLOURS.values())[index % len(COLOURS)]


def line_of(index: int) -> dict[str, Any]:
    """Return colour and style of the line of the n-th run in a picture of several."""
    return {"color": colour_of(index), "linestyle": DASHES[index % len(DASHES)]}
