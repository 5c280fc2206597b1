"""A sweep in one picture: quantities of its runs over one or two of the keys that vary."""

from collections import Counter
from collections.abc import Sequence

from matplotlib.figure import Figure

from exu_press.errors import InputError
from exu_press.plots.headed import headed_figure
from exu_press.plots.style import styled
from exu_press.plots.sweep_panels import draw_curves, draw_map
from exu_press.plots.sweep_words import setting, words
from exu_press.plots.typesetting import plain
from exu_press.plots.words import describe
from exu_press.studies.sweep import Table
from exu_press.studies.sweep.lines import shown

__all__ = ["axes_of", "sweep_figure", "sweep_figures"]

MOST_CURVES = 6


def axes_of(table: Table, wanted: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the one or two keys to draw over: those wanted, or the first numbers that vary.

    Raises:
        InputError: a wanted key does not vary, or is no number.
    """
    study = table.study
    possible = [name for name in study.keys if table.is_numeric(name) and len(set(table[name])) > 1]
    for name in wanted:
        if name not in possible:
            raise InputError(
                f"--over {name}: allowed are the numbers that vary, "
                f"{', '.join(possible) or 'none here'}"
            )
    if len(wanted) > 2:
        raise InputError(f"--over {' --over '.join(wanted)}: allowed are one or two keys")
    return tuple(wanted or possible[:2])


@styled
def sweep_figure(table: Table, axes: Sequence[str], quantities: Sequence[str]) -> Figure:
    """Return one panel a quantity.

    A curve for every combination of the other keys, where a grid has few of them; else a map over
    two keys, or points. Runs without a number are crosses.

    Args:
        table: of the sweep.
        axes: one or two numeric columns.
        quantities: numeric columns.
    """
    columns = min(2, len(quantities))
    rows = -(-len(quantities) // columns)
    heading = f"{len(table)} runs over {' and '.join(map(words, axes))}"
    size = (6.4 * columns, 1.0 + 3.7 * rows)
    figure = headed_figure(heading, _words(table, int(80 * columns)), size)
    panels = figure.subplots(rows, columns, squeeze=False)
    curves = _curves(table, axes)
    for panel, quantity in zip(panels.flat, quantities, strict=False):
        if curves is None:
            draw_map(figure, panel, table, axes, quantity)
        else:
            draw_curves(panel, table, axes[0], quantity, curves)
    if curves is not None and len(curves) > 1:
        panels.flat[0].legend(loc="best")
    for panel in panels.flat[len(quantities) :]:
        panel.axis("off")
    return figure


def sweep_figures(
    table: Table, over: Sequence[str] = (), show: Sequence[str] = ()
) -> dict[str, Figure]:
    """Return the picture of a sweep, or none where no number varies or none came out.

    Raises:
        InputError: an axis or a quantity is not there.
    """
    axes, drawn = axes_of(table, over), shown(table, show)
    return {"sweep": sweep_figure(table, axes, drawn)} if axes and drawn else {}


def _curves(table: Table, axes: Sequence[str]) -> dict[str, list[int]] | None:
    """Return the runs of every curve by label, or None for a map.

    A grid has a curve for every combination of its other keys, if they are few; else a map shows
    two keys, and of more than two every run is a point.
    """
    everything = list(range(len(table)))
    if table.study.way != "grid":
        return {"": everything} if len(axes) == 1 else None
    others = [name for name in table.study.keys if name != axes[0] and len(set(table[name])) > 1]
    found: dict[str, list[int]] = {}
    for run in everything:
        label = plain(", ".join(setting(name, table[name][run]) for name in others))
        found.setdefault(label, []).append(run)
    if len(found) <= MOST_CURVES:
        return found
    return None if len(axes) == 2 and len(others) == 1 else {"": everything}


def _words(table: Table, width: int) -> str:
    ends = Counter(table["status"])
    told = ", ".join(f"{number} {status}" for status, number in ends.items())
    return f"{describe(table.study.scenes, width)}\n{told}"
