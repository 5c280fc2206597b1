"""The look of every picture: light, printable, readable by the colour-blind; no global state."""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, wraps
from io import BytesIO
from pathlib import Path
from typing import Any, ParamSpec

import matplotlib
import matplotlib.style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import Colormap, ListedColormap
from matplotlib.figure import Figure

from exu_press.errors import InputError
from exu_press.files.digests import note_content
from exu_press.plots.format import PictureFormat, drawn_as, picture_format
from exu_press.plots.headings import separate_headings, wrap_labels
from exu_press.plots.palette import lines_of

__all__ = ["DPI", "PATH_COLOURS", "check_drawable", "look", "points", "read_style", "with_style"]

Parameters = ParamSpec("Parameters")

DPI = 150

PRINTED_DPI = 600
"""Of a PNG with a width on paper."""

SCREEN_SIZE, PRINTED_SIZE = 9.5, 7.0
"""Letters, points."""

LARGEST_FONT = 1000
"""Points; of larger letters not every version of matplotlib says that it cannot draw them."""

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
    "font.size": SCREEN_SIZE,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.6,
    "legend.borderaxespad": 0.2,
    "legend.fontsize": 9.0,
    "legend.frameon": False,
    "legend.handlelength": 2.4,
    "lines.linewidth": 1.2,
    "pdf.fonttype": 42,
    "savefig.dpi": DPI,
    "svg.fonttype": "none",  # text stays text
    "text.hinting": "no_hinting",  # to fit letters to pixels takes a tenth of a picture's time
    "xtick.color": "#4D4D4D",
    "xtick.labelcolor": "black",
    "xtick.labelsize": 9.0,
    "ytick.color": "#4D4D4D",
    "ytick.labelcolor": "black",
    "ytick.labelsize": 9.0,
}


ON_PAPER: dict[str, Any] = {
    **{name: LOOK[name] * PRINTED_SIZE / SCREEN_SIZE for name in LOOK if "linewidth" in name},
    "figure.constrained_layout.h_pad": 0.03,
    "figure.constrained_layout.w_pad": 0.03,
    "legend.handlelength": 1.4,
    "savefig.dpi": PRINTED_DPI,
}
"""What differs in a figure with a width on paper, beside the size of its letters."""


@contextmanager
def look() -> Iterator[None]:
    """Draw with our look inside the block, on matplotlib's defaults; leave the user's alone.

    The settings of a style file that the format names go before ours; sizes that it does not have
    follow its `font.size`, and curves have the colours and line styles of its `axes.prop_cycle`.

    Raises:
        InputError: the style file is none.
    """
    form = picture_format()
    style = {} if form.style is None else read_style(form.style)
    letters, paper = (SCREEN_SIZE, {}) if form.width is None else (PRINTED_SIZE, ON_PAPER)
    scale = style.get("font.size", letters) / SCREEN_SIZE
    sizes = {name: scale * LOOK[name] for name in LOOK if name.endswith("size")}
    settings: Any = {**LOOK, **sizes, **paper, **style}
    with (
        matplotlib.style.context(["default", settings]),
        lines_of(style.get("axes.prop_cycle", ())),
    ):
        yield


@cache
def read_style(path: Path) -> dict[str, Any]:
    """Return the settings of a style file."""
    note_content(path, path.read_bytes())
    complaints: list[str] = []

    def collect(record: logging.LogRecord) -> bool:
        complaints.append(record.getMessage())
        return False

    logger = logging.getLogger("matplotlib")  # where it reports keys and values that are none
    logger.addFilter(collect)
    try:
        settings: Any = matplotlib.rc_params_from_file(path, use_default_template=False)
    except (OSError, ValueError) as error:
        complaints.append(str(error))
    finally:
        logger.removeFilter(collect)
    if complaints:
        text = " ".join(complaints[0].split())
        raise InputError(f"--style {path}: is no matplotlib style ({text:.200})")
    return dict(settings)


def check_drawable(path: Path) -> None:
    """Raise InputError where matplotlib cannot draw with a style file, as without LaTeX."""
    with drawn_as(PictureFormat(style=path)), look():
        figure = Figure()
        figure.add_subplot(title="Force, N")
        figure.text(0.0, 0.0, "N")
        try:
            if (size := matplotlib.rcParams["font.size"]) > LARGEST_FONT:
                raise ValueError(f"font.size = {size:g}: allowed are {LARGEST_FONT} points at most")
            figure.savefig(BytesIO(), format="png")
        except (OSError, RuntimeError, ValueError) as error:
            text = " ".join(str(error).split())
            raise InputError(
                f"--style {path}: matplotlib cannot draw with it ({text:.200})"
            ) from None


def points(size: float) -> float:
    """Return a size of letters or marks, points, as the style scales it from that on a screen."""
    return size * float(matplotlib.rcParams["font.size"]) / SCREEN_SIZE


def with_style(draw: Callable[Parameters, Figure]) -> Callable[Parameters, Figure]:
    """Decorate a function that returns a figure: drawn and laid out with our look.

    The layout is done here, so that the user may save the figure with any settings.
    """

    @wraps(draw)
    def inner(*args: Parameters.args, **kwargs: Parameters.kwargs) -> Figure:
        with look():
            figure = draw(*args, **kwargs)
            _lay_out(figure)
            return figure

    return inner


def _lay_out(figure: Figure) -> None:
    """Lay a figure out; on paper, where letters are large, in turns with what panels have room for.

    A title that is raised and a label that is wrapped make panels smaller.
    """
    if not isinstance(figure.canvas, FigureCanvasAgg):
        FigureCanvasAgg(figure)  # else each text is measured on a canvas of its own
    engine = figure.get_layout_engine()
    if engine is None or picture_format().width is None:
        separate_headings(figure)
    else:
        engine.execute(figure)
        separate_headings(figure)
        engine.execute(figure)
        wrap_labels(figure)
        separate_headings(figure)
    if engine is not None:
        engine.execute(figure)
