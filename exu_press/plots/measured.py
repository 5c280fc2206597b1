"""Measured curves with the computed ones over them."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from exu_press.plots.headed import headed_figure
from exu_press.plots.style import GREY, colour_of, styled
from exu_press.plots.typesetting import plain, typeset
from exu_press.studies.beside_measured import Beside

__all__ = ["measured_figure"]


@styled
def measured_figure(found: Mapping[str, Mapping[str, Beside]]) -> Figure:
    """Return a panel for each curve, by its name, with the runs by label."""
    size = 9.5, 1.2 + 2.9 * len(found)
    figure = headed_figure("Measured and computed", "Runs at the measured places.", size)
    panels = figure.subplots(len(found), 1, squeeze=False).flat
    for panel, (name, runs) in zip(panels, found.items(), strict=True):
        first = next(iter(runs.values()))
        curve = first.curve
        panel.plot(curve.at, first.measured, ".", color=GREY, markersize=4, label="measured")
        for index, (label, one) in enumerate(runs.items()):
            panel.plot(curve.at, one.values, color=colour_of(index), label=plain(label))
        panel.set_title(plain(f"Curve {name}"))
        panel.set_xlabel("time, s" if curve.over == "time" else "crank angle, deg")
        panel.set_ylabel(plain(typeset(f"{curve.name.replace('_', ' ')}, {first.unit}")))
        panel.legend(loc="best")
    return figure
