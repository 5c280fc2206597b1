"""What the study's pictures share: a heading without a scene, logarithmic axes in plain numbers."""

from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.text import Annotation
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

__all__ = ["headed_figure", "plain_logarithm"]


def plain_logarithm(axis: Axis, decades: float) -> None:
    """Label a logarithmic axis by plain numbers: 1-2-5 over few decades, powers of ten over many.

    Its scale must be set before.
    """
    steps: tuple[float, ...] = (1.0, 2.0, 5.0) if decades < 2.5 else (1.0,)
    if decades < 0.8:
        steps = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0)
    axis.set_major_locator(LogLocator(subs=steps, numticks=12))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def headed_figure(heading: str, words: str, size: tuple[float, float]) -> Figure:
    """Return a figure without pyplot.

    Args:
        heading: what is shown.
        words: under it.
        size: width and height, inch.
    """
    figure = Figure(figsize=size, layout="constrained")
    below = figure.suptitle(f"\n{words}", x=0.012, ha="left", fontsize=9.5, linespacing=1.5)
    figure.add_artist(
        Annotation(heading, (0, 1), xycoords=below, va="top", fontsize=13, fontweight="bold")
    ).set_in_layout(False)
    return figure
