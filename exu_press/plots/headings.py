"""Titles, notes and legends over a panel that keep clear of each other; names of axes that fit."""

import textwrap

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.text import Text

from exu_press.plots.format import picture_format
from exu_press.plots.legends import fit_above

__all__ = ["separate_headings", "wrap_labels"]

BESIDE, ABOVE = 14.0, 6.0
"""Least distance of a title from what is beside it, and from what is below it, points."""

GROWS = 1.18
"""Width of a panel on a screen when it is laid out, over that before."""


def separate_headings(figure: Figure) -> None:
    """Raise the titles of panels that are too narrow for a title and a note or a legend beside it.

    A note then stands below the title; a legend that is wider than its panel has fewer columns.
    """
    for axes in figure.axes:
        title = _title_at(axes, "left")
        beside = [text for text in (_title_at(axes, "right"),) if text.get_text()]
        legend = axes.get_legend()
        headings: list[Text | Legend] = [*beside]
        if legend is not None and legend.get_bbox_to_anchor().y0 >= axes.bbox.y1 - 1.0:
            headings.append(legend)
        if not headings:
            continue
        widths = [item.get_window_extent().width for item in (title, *headings)]
        room = _width_of(axes)
        if isinstance(headings[-1], Legend) and widths[-1] > room:
            headings[-1] = fit_above(axes, headings[-1], room)
        if not title.get_text() or sum(widths) + BESIDE * figure.dpi / 72.0 <= room:
            continue
        height = max(item.get_window_extent().height for item in headings) * 72.0 / figure.dpi
        for note in beside:
            text = note.get_text()
            letters = max(10, int(len(text) * room / max(widths[1], 1.0)))
            lines = textwrap.wrap(text, letters)
            height *= len(lines)
            _write_below_title(axes, note, "\n".join(lines))
        axes.set_title(title.get_text(), loc="left", pad=height + ABOVE)


def wrap_labels(figure: Figure) -> None:
    """Break names of panels' axes that are longer than these."""
    for axes in figure.axes:
        if axes.get_subplotspec() is None:
            continue  # a colour bar, which its name may overhang
        lengths = ((axes.xaxis.label, axes.bbox.width), (axes.yaxis.label, axes.bbox.height))
        for side, (label, room) in enumerate(lengths):
            box = label.get_window_extent()
            taken = (box.width, box.height)[side]
            if label.get_text() and taken > max(room, 1.0):
                lines = label.get_text().splitlines()
                letters = max(10, int(max(map(len, lines)) * room / taken))
                label.set_text("\n".join(textwrap.fill(line, letters) for line in lines))


def _write_below_title(axes: Axes, note: Text, text: str) -> None:
    """Write a note between a panel and its title, in place of that beside it."""
    written = axes.annotate(
        text,
        (1.0, 1.0),
        (0.0, 2.0),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="right",
        fontsize=note.get_fontsize(),
        color=note.get_color(),
    )
    written.set_in_layout(False)  # it is as wide as the panel
    note.set_text("")


def _width_of(axes: Axes) -> float:
    """Return the width that a panel will have, pixels; with equal scales its shorter side.

    On a screen; on paper that which it has, as panels are laid out twice there.
    """
    box, grows = axes.bbox, 1.0 if picture_format().width is not None else GROWS
    return float(grows * box.width if axes.get_aspect() == "auto" else min(box.width, box.height))


def _title_at(axes: Axes, side: str) -> Text:
    """Return the title at one side of a panel, which may be empty."""
    title: Text = getattr(axes, f"_{side}_title")  # no public name gives the text itself
    return title
