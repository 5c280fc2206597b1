"""The motion in the long run: section, phase portrait, transient, orders, figures by revolution."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from exu_press.plots.headed import headed_figure
from exu_press.plots.style import COLOURS, GREY, RUN, styled
from exu_press.plots.words import describe
from exu_press.studies.attractor import Attractor
from exu_press.studies.spectrum import spectra

__all__ = ["attractor_figure"]

ORDERS = 30


@styled
def attractor_figure(found: Attractor) -> Figure:
    """Return six panels: of the first joint with clearance, and of what scatters most."""
    low, high = found.per_second[1:]
    exponent = f"in [{low:.3g}, {high:.3g}]" if np.isfinite(low) else f"below {high:.3g}"
    words = f"{describe([found.scene], 160)}\nperiod: {found.period}; largest Lyapunov exponent "
    words += f"{exponent} 1/s"
    figure = headed_figure("In the long run", words, (14.0, 8.6))
    panels = figure.subplots(2, 3)
    loose = next(iter(found.scene.joints.with_clearance), None)
    _section(panels[0, 0], found, loose)
    _portrait(panels[0, 1], found)
    _transient(panels[0, 2], found)
    _orders(panels[1, 0], found)
    name, values = max(found.figures.items(), key=lambda one: _scatter(one[1]))
    unit = found.units[name]
    _histogram(panels[1, 1], name, unit, values)
    _by_revolution(panels[1, 2], name, unit, values, found.skip)
    return figure


def _scatter(values: np.ndarray) -> float:
    """Return by how much a figure changes from revolution to revolution, over itself."""
    known = values[np.isfinite(values)]
    return float(known.std() / max(abs(known.mean()), 1e-300)) if len(known) else 0.0


def _section(panel: Axes, found: Attractor, joint: str | None) -> None:
    where = "guideway" if joint is None else joint.replace("_", " ")
    x, y = found.points[:, 0], found.points[:, 1]
    colours = np.arange(len(x))
    panel.scatter(x, y, c=colours, cmap="viridis", s=14)
    for axis, values in ((panel.set_xlim, x), (panel.set_ylim, y)):
        half = max(0.6 * float(np.ptp(values)), 3.0 * found.error)
        middle = 0.5 * float(values.max() + values.min())
        axis(middle - half, middle + half)
    panel.set_title(f"section at {found.scene.start_angle_deg:g} deg: {where}")
    panel.set(xlabel="x / clearance", ylabel="y / clearance")
    panel.locator_params(nbins=4)
    panel.errorbar(x[-1], y[-1], found.error, found.error, color=GREY, lw=1.0, label="error")
    panel.legend(loc="best")


def _portrait(panel: Axes, found: Attractor) -> None:
    for run in found.last:
        panel.plot(run["slider_acceleration"], run["slider_velocity"], color=RUN, lw=0.5)
    ends = [(run["slider_acceleration"][-1], run["slider_velocity"][-1]) for run in found.last]
    panel.plot(*zip(*ends, strict=True), "o", color=COLOURS["vermilion"], ms=5, label="section")
    panel.set_title(f"phase portrait of the slider, last {len(found.last)} revolutions")
    panel.set(xlabel="acceleration, m/s^2", ylabel="velocity, m/s")
    panel.legend(loc="best")


def _transient(panel: Axes, found: Attractor) -> None:
    panel.semilogy(np.arange(1, len(found.transient) + 1), found.transient, "o-", color=RUN, ms=3)
    panel.axhline(found.error, color=GREY, ls="--", lw=1.0, label="error")
    panel.set_title("transient: distance from the last point")
    panel.set(xlabel="revolution", ylabel="clearances")
    panel.legend(loc="best")


def _orders(panel: Axes, found: Attractor) -> None:
    (each,) = spectra(found.last[-1])
    one = each.over_angle
    if one is not None:
        shown = (one.frequency > 0.5) & (one.frequency <= ORDERS)
        panel.vlines(one.frequency[shown], 0.0, one.amplitude[shown], color=COLOURS["green"])
    panel.set_ylim(bottom=0.0)
    panel.set_title("orders of the slider's acceleration, m/s^2")
    panel.set_xlabel("order")


def _histogram(panel: Axes, name: str, unit: str, values: np.ndarray) -> None:
    panel.hist(values[np.isfinite(values)], bins=24, color=RUN)
    panel.set_title("values of a revolution")
    panel.set(xlabel=f"{name}, {unit}", ylabel="revolutions")
    panel.locator_params(axis="x", nbins=4)


def _by_revolution(panel: Axes, name: str, unit: str, values: np.ndarray, skip: int) -> None:
    panel.plot(np.arange(skip + 1, skip + len(values) + 1), values, "o-", color=RUN, ms=3, lw=0.6)
    panel.set_title(f"{name}, {unit}")
    panel.set_xlabel("revolution")
