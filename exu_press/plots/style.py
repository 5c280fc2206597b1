"""The look of every picture: light, printable, readable by the colour-blind; no global state."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any, ParamSpec

import matplotlib
import matplotlib.style
from matplotlib.colors import Colormap, ListedColormap
from matplotlib.figure import Figure

__all__ = [
    "COLOURS",
    "DPI",
    "GREY",
    "IDEAL",
    "PATH_COLOURS",
    "RUN",
    "SHADE",
    "colour_of",
    "look",
    "with_style",
]

Parameters = ParamSpec("Parameters")

DPI = 150

COLOURS = {
    "blue": "#0072B2",
    "vermilion": "#D55E00",
    "green": "#009E73",
    "purple": "#CC79A7",
    "orange": "#E69F00",
    "sky blue": "#56B4E9",
}
"""Okabe and Ito's colour-blind-safe palette, less black (the ideal's) and yellow (too pale)."""

RUN = COLOURS["blue"]
IDEAL = "#000000"
GREY = "#767676"
SHADE = "#F1F4F7"

PATH_COLOURS: Colormap = ListedColormap(
    matplotlib.colormaps["viridis"].resampled(256)(range(232)), "viridis without its yellow end"
)
"""For the crank angle along a path."""

LOOK: dict[str, Any] = {
    "axes.axisbelow": True,
    "axes.edgecolor": "#4D4D4D",
    "axes.formatter.useoffset": False,  # it would stand in the title's place
    "axes.grid": True,
    "axes.labelsize": 9.5,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titley": 1.0,  # to find a place for it takes a tenth of a picture's time
    "axes.xmargin": 0.0,
    "figure.constrained_layout.h_pad": 0.08,
    "figure.constrained_layout.hspace": 0.04,
    "figure.constrained_layout.w_pad": 0.08,
    "figure.constrained_layout.wspace": 0.03,
    "figure.dpi": DPI,
    "figure.facecolor": "white",
    "font.family": "DejaVu Sans",  # comes with matplotlib: the same picture everywhere
    "font.size": 9.5,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.6,
    "legend.borderaxespad": 0.2,
    "legend.fontsize": 9.0,
    "legend.frameon": False,
    "legend.handlelength": 1.8,
    "lines.linewidth": 1.2,
    "savefig.dpi": DPI,
    "xtick.color": "#4D4D4D",
    "xtick.labelcolor": "black",
    "xtick.labelsize": 9.0,
    "ytick.color": "#4D4D4D",
    "ytick.labelcolor": "black",
    "ytick.labelsize": 9.0,
}


@contextmanager
def look() -> Iterator[None]:
    """Draw with our look inside the block, on matplotlib's defaults; leave the user's alone."""
    with matplotlib.style.context(["default", LOOK]):
        yield


def with_style(draw: Callable[Parameters, Figure]) -> Callable[Parameters, Figure]:
    """Decorate a function that returns a figure: drawn and laid out with our look.

    The layout is done here, so that the user may save the figure with any settings.
    """

    @wraps(draw)
    def inner(*args: Parameters.args, **kwargs: Parameters.kwargs) -> Figure:
        with look():
            figure = draw(*args, **kwargs)
            if (engine := figure.get_layout_engine()) is not None:
                engine.execute(figure)
            return figure

    return inner


def colour_of(index: int) -> str:
    """Return the colour of the n-th run in a picture; after the palette's end it starts again."""
    return tuple(COLOURS.values())[index % len(COLOURS)]
