"""The motion in the long run: section, phase portrait, transient, orders, figures by revolution."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from exu_press.numerics.arrays import Array
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import COLOURS, GREY, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.style import PATH_COLOURS, with_style
from exu_press.plots.sweep_words import words as in_words
from exu_press.plots.typesetting import typeset, wrap_text
from exu_press.plots.words import describe
from exu_press.studies.attractor.motion import Attractor
from exu_press.studies.attractor.report import AttractorReport
from exu_press.studies.spectrum import Spectra, spectra
from exu_press.studies.spectrum_figure import draw_spectrum

__all__ = ["attractor_figure"]

ORDERS = 30

LEAST_SPAN = 0.02
"""Half of an axis of values, over them: scatter far below their errors looks like none."""


@with_style
def attractor_figure(report: AttractorReport) -> Figure:
    """Return eight panels, of the first joint with clearance and the most scattered figure."""
    motion = report.motion
    low, high = motion.per_second[1:]
    exponent = f"in [{low:.3g}, {high:.3g}] 1/s" if np.isfinite(low) else f"below {high:.3g} 1/s"
    exponent = exponent if np.isfinite(high) else "not known"
    text = f"{describe([motion.scene], 160)}\nperiod: {motion.period}; largest Lyapunov exponent "
    text += exponent
    figure, panels = figure_with_panels("In the long run", text, grid_rows(8, 4), 4.5, 3.7)
    loose = next(iter(motion.scene.joints.with_clearance), None)
    if motion.points.shape[1] > 1:
        where = "guideway" if loose is None else loose.replace("_", " ")
        title = f"section at {motion.scene.start_angle_deg:g} deg: {where}"
        _section(panels[0], motion, 1, title, "y / clearance")
        title = "section: velocity over position"
        _section(panels[1], motion, 2, title, "its rate / largest speed")
    else:  # a motor turns ideal joints
        label = "crank speed on the section / scene's"
        _by_revolution(panels[0], label, motion.points[:, 0], motion.skip)
        panels[1].set_axis_off()
    _portrait(panels[2], motion)
    _transient(panels[3], motion)
    (slider,) = spectra(motion.last[-1])
    _frequencies(panels[4], slider)
    _orders(panels[5], slider)
    name, values = max(motion.figures.items(), key=lambda item: _scatter(item[1]))
    label = wrap_text(", ".join(filter(None, (in_words(name), motion.units[name]))))
    _histogram(panels[6], label, values)
    _by_revolution(panels[7], label, values, motion.skip)
    return figure


def _scatter(values: Array) -> float:
    """Return by how much a figure changes from revolution to revolution, over itself."""
    known = values[np.isfinite(values)]
    return float(known.std() / max(abs(known.mean()), 1e-300)) if len(known) else 0.0


def _section(panel: Axes, motion: Attractor, up: int, title: str, label: str) -> None:
    """Draw a coordinate of the section over the first one, later revolutions brighter."""
    x, y, error = motion.points[:, 0], motion.points[:, up], motion.error
    panel.scatter(x, y, c=np.arange(len(x)), cmap=PATH_COLOURS, s=14)
    for axis, values in ((panel.set_xlim, x), (panel.set_ylim, y)):
        half = max(0.6 * float(np.ptp(values)), 3.0 * error)
        middle = 0.5 * float(values.max() + values.min())
        axis(middle - half, middle + half)
    panel.locator_params(nbins=4)
    panel.errorbar(x[-1], y[-1], error, error, color=GREY, lw=1.0, label="error")
    panel.legend(loc="best")
    panel.set(title=title, xlabel="x / clearance", ylabel=label)


def _portrait(panel: Axes, motion: Attractor) -> None:
    for run in motion.last:
        panel.plot(run["slider_acceleration"], run["slider_velocity"], color=colour_of(0), lw=0.5)
    ends = [(run["slider_acceleration"][-1], run["slider_velocity"][-1]) for run in motion.last]
    panel.plot(*zip(*ends, strict=True), "o", color=COLOURS["vermilion"], ms=5, label="section")
    panel.margins(x=0.05)
    panel.set_title(f"phase portrait, last {len(motion.last)} revolutions")
    panel.set(xlabel=typeset("acceleration, m/s^2"), ylabel="velocity, m/s")
    panel.legend(loc="best")


def _transient(panel: Axes, motion: Attractor) -> None:
    panel.semilogy(
        np.arange(1, len(motion.transient) + 1), motion.transient, "o-", color=colour_of(0), ms=3
    )
    panel.axhline(motion.error, color=GREY, ls="--", lw=1.0, label="error")
    panel.set_title("transient: distance from the last point")
    panel.set(xlabel="revolution", ylabel="clearances")
    panel.set_xlim(0.5, len(motion.transient) + 0.5)
    panel.xaxis.set_major_locator(MaxNLocator(integer=True))
    panel.legend(loc="best")


def _frequencies(panel: Axes, slider: Spectra) -> None:
    draw_spectrum(panel, slider.over_time, slider.unit)
    panel.set_xscale("log")
    panel.set_xlim(slider.over_time.frequency[0], slider.over_time.frequency[-1])
    legend_above(panel)
    panel.set_title("spectrum of the slider's acceleration")
    panel.set_xlabel("frequency, Hz")


def _orders(panel: Axes, slider: Spectra) -> None:
    orders = slider.over_angle
    if orders is not None:
        drawn = (orders.frequency > 0.5) & (orders.frequency <= ORDERS)
        panel.vlines(orders.frequency[drawn], 0.0, orders.amplitude[drawn], color=COLOURS["green"])
    panel.set_ylim(bottom=0.0)
    panel.set_xlim(0.0, ORDERS + 0.5)
    panel.set_title(typeset("orders of it, m/s^2"))
    panel.set_xlabel("order")


def _histogram(panel: Axes, label: str, values: Array) -> None:
    panel.hist(
        values[np.isfinite(values)], bins=[*np.linspace(*_span_of(values), 31)], color=colour_of(0)
    )
    panel.set_title("values of a revolution")
    panel.set(xlabel=label, ylabel="revolutions")
    panel.set_xlim(_span_of(values))
    panel.locator_params(axis="x", nbins=4)


def _span_of(values: Array) -> tuple[float, float]:
    """Return the ends of an axis of values: some hundredths of them, or more where they differ."""
    known = values[np.isfinite(values)]
    if not len(known):
        return 0.0, 1.0
    middle = 0.5 * float(known.max() + known.min())
    half = max(0.6 * float(np.ptp(known)), LEAST_SPAN * abs(middle)) or 1.0
    return middle - half, middle + half


def _by_revolution(panel: Axes, label: str, values: Array, skip: int) -> None:
    panel.plot(
        np.arange(skip + 1, skip + len(values) + 1), values, "o-", color=colour_of(0), ms=3, lw=0.6
    )
    panel.set_title("value of each revolution")
    panel.set(xlabel="revolution", ylabel=label, ylim=_span_of(values))
    panel.set_xlim(skip + 0.5, skip + len(values) + 0.5)
    panel.xaxis.set_major_locator(MaxNLocator(integer=True))
