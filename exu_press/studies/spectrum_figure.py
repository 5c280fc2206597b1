"""Spectra of a channel: over frequency, over orders, and over the crank angle."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from exu_press.plots.file import save_figures
from exu_press.plots.legends import legend_above
from exu_press.plots.palette import COLOURS, GREY, colour_of
from exu_press.plots.panels import figure_with_panels, grid_rows
from exu_press.plots.save import sources_of
from exu_press.plots.style import PATH_COLOURS, with_style
from exu_press.plots.typesetting import plain, typeset
from exu_press.plots.words import describe
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.signals.spectrum import Spectrum
from exu_press.studies.spectrum import Mark, Spectra

__all__ = ["draw_spectrum", "save_spectra", "spectrum_figure"]

DECADES = 1e-4
"""Smallest amplitude that is drawn, over the largest one."""

HIGHEST_ORDER = 60.0


def draw_spectrum(axes: Axes, spectrum: Spectrum, unit: str) -> None:
    """Draw the amplitudes over a logarithmic scale, the error of the resampling, the resolution."""
    axes.plot(spectrum.frequency, spectrum.amplitude, color=colour_of(0), linewidth=0.9)
    lowest, width = spectrum.frequency[0], spectrum.resolution
    if width > lowest:
        label = f"below the resolution, {width:.3g} Hz"
        axes.axvspan(lowest, width, color=GREY, alpha=0.2, linewidth=0.0, label=label)
    axes.set_yscale("log")
    largest = float(spectrum.amplitude.max()) or 1.0
    axes.set_ylim(DECADES * largest, 2.0 * largest)
    label = "error of the resampling"
    if spectrum.error > DECADES * largest:
        axes.axhline(spectrum.error, color=GREY, linewidth=0.9, linestyle="--", label=label)
    else:
        axes.plot([], " ", label=f"{label}: {spectrum.error:.1g}, below the panel")
    axes.set_ylabel(plain(typeset(f"amplitude, {unit}")))


@with_style
def spectrum_figure(spectra: Spectra, scene: Scene, marks: Sequence[Mark] = ()) -> Figure:
    """Return the picture of a channel's spectra, with natural frequencies as marks."""
    over, orders = spectra.over_time, spectra.over_angle
    text = f"{describe([scene], 110)}\n"
    text += f"{over.cells} cells, window {over.window}"
    heading = f"Spectrum of {plain(spectra.name.replace('_', ' '))}"
    rows = grid_rows(3 if orders else 2, 1)
    figure, panels = figure_with_panels(heading, text, rows, 9.5, 2.6)
    draw_spectrum(panels[0], over, spectra.unit)
    lowest = over.frequency[0]
    panels[0].set_xscale("log")
    panels[0].set_xlim(lowest, over.frequency[-1])
    panels[0].set_xlabel("frequency, Hz")
    for number, mark in enumerate(m for m in marks if lowest < m.frequency < over.frequency[-1]):
        colour = list(COLOURS.values())[1 + number % (len(COLOURS) - 1)]
        panels[0].axvline(
            mark.frequency, color=colour, linewidth=1.2,
            label=plain(f"{mark.name}, {mark.frequency:.0f} Hz"),
        )  # fmt: skip
    legend_above(panels[0])
    if orders:
        draw_spectrum(panels[1], orders, spectra.unit)
        panels[1].set_xlim(0.0, min(HIGHEST_ORDER, orders.frequency[-1]))
        panels[1].set_xlabel(f"order, multiples of the crank; revolutions: {spectra.revolutions}")
    changing, last = spectra.changing, panels[-1]
    largest = float(changing.amplitude.max()) or 1.0
    image = last.pcolormesh(
        spectra.angle,
        changing.frequency,
        np.maximum(changing.amplitude, DECADES * largest),
        norm=LogNorm(DECADES * largest, largest),
        cmap=PATH_COLOURS,
        shading="nearest",
        rasterized=True,
    )
    last.grid(visible=False)
    last.set_yscale("log")
    last.set_ylim(changing.frequency[0], changing.frequency[-1])
    last.set_xlabel(f"crank angle, deg (windows of {1e3 * changing.width:.3g} ms)")
    last.set_ylabel("frequency, Hz")
    figure.colorbar(image, ax=last, label=plain(typeset(f"amplitude, {spectra.unit}")))
    return figure


def save_spectra(
    spectra_list: Sequence[Spectra], run: Result, marks: Sequence[Mark], directory: Path
) -> list[Path]:
    """Write a picture of each channel of a run, spectrum_NAME; return the files."""
    figures = {
        f"spectrum_{spectra.name.replace('.', '_')}": spectrum_figure(spectra, run.scene, marks)
        for spectra in spectra_list
    }
    return save_figures(figures, directory, sources_of({"": run}))
