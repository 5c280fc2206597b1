"""Amplitudes over frequency of a curve with uneven steps, with the error of the resampling."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import ShortTimeFFT, get_window, periodogram

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import integral

__all__ = ["WINDOWS", "Spectrogram", "Spectrum", "amplitude_spectrum", "cell_means", "spectrogram"]

WINDOWS = ("flattop", "hann", "boxcar")

FEWEST = 16
"""Least number of cells of a spectrum."""


@dataclass(frozen=True)
class Spectrum:
    """Amplitudes of a curve over frequency, without its mean.

    Attributes:
        frequency: (m,), in 1 over the unit of x: Hz, or orders where x is in revolutions.
        amplitude: of a sine of that frequency, (m,), in the unit of the values.
        error: largest change of an amplitude with cells of half the width, or with every other
            value of the curve left out: the error of resampling and steps.
        window: its name.
        resolution: width of the window's main lobe at half its power, as frequency is.
        cells: number of even cells, over each of which the curve is averaged.
    """

    frequency: Array
    amplitude: Array
    error: float
    window: str
    resolution: float
    cells: int

    def rescale(self, rate: float) -> "Spectrum":
        """Return the spectrum over another x, of which one is `rate` of this one's unit."""
        return replace(self, frequency=rate * self.frequency, resolution=rate * self.resolution)


def amplitude_spectrum(
    x: Array, values: Array, *, window: str = "flattop", cells: int | None = None
) -> Spectrum:
    """Return the amplitude spectrum of a curve.

    The curve is averaged over even cells (`cell_means`), which damps a frequency f by
    sin(pi f w) / (pi f w), w the cell's width; amplitudes are divided by that. The window is scaled
    so that a sine has its amplitude: with the flat-top window within 0.1 % wherever it lies between
    two bins, with Hann's up to 15 % less there, with none (boxcar) exact where a whole number of
    its periods is in the curve (G. Heinzel et al., Spectrum and spectral density estimation by the
    DFT, MPI Hannover 2002, table 2 and C.2).

    Args:
        x: (n,), increasing: s, or revolutions.
        values: (n,).
        window: one of WINDOWS.
        cells: their number; None takes as many as the curve has values.

    Raises:
        InputError: the window is unknown, or the curve has too few values.
    """
    if window not in WINDOWS:
        raise InputError(f"window = {window!r}: allowed are {', '.join(WINDOWS)}")
    number = len(x) if cells is None else cells
    if number < FEWEST or len(x) < FEWEST:
        few = min(number, len(x))
        raise InputError(f"a spectrum of {few} values: allowed are {FEWEST} or more")
    span = float(x[-1] - x[0])
    frequency, amplitude = _amplitudes(x, values, window, number)
    finer = _amplitudes(x, values, window, 2 * number)[1][: len(amplitude)]
    every = np.unique([*range(0, len(x), 2), len(x) - 1])
    coarser = _amplitudes(x[every], values[every], window, number)[1]
    error = max(float(np.abs(refined - amplitude).max()) for refined in (finer, coarser))
    return Spectrum(frequency, amplitude, error, window, _lobe(window) / span, number)


def _amplitudes(x: Array, values: Array, window: str, cells: int) -> tuple[Array, Array]:
    """Return frequencies and amplitudes, without those of frequency 0 and of the last bin."""
    edges = np.linspace(x[0], x[-1], cells + 1)
    rate = cells / (x[-1] - x[0])
    means = cell_means(x, values, edges)
    frequency, power = periodogram(means, rate, window, detrend="constant", scaling="spectrum")
    inner = slice(1, (cells + 1) // 2)
    amplitude = np.sqrt(2.0 * power[inner]) / np.sinc(frequency[inner] / rate)
    return np.asarray(frequency[inner]), np.asarray(amplitude)


def _lobe(window: str) -> float:
    """Return the width of a window's main lobe at half its power, in bins."""
    shape, fine = get_window(window, 256), 256
    power = np.abs(np.fft.rfft(shape, 256 * fine)) ** 2
    return 2.0 * float(np.argmax(power < 0.5 * power[0])) / fine


@dataclass(frozen=True)
class Spectrogram:
    """Amplitudes over frequency as they change.

    Attributes:
        x: centres of the windows, (k,).
        frequency: (m,).
        amplitude: (m, k).
        width: of a window, as x is.
    """

    x: Array
    frequency: Array
    amplitude: Array
    width: float


def spectrogram(x: Array, values: Array, width: float, *, cells: int | None = None) -> Spectrogram:
    """Return the amplitudes in Hann windows of a width, each a quarter of it further on.

    Args:
        x: (n,), increasing.
        values: (n,).
        width: of a window, as x is.
        cells: as in `amplitude_spectrum`.

    Raises:
        InputError: a window has too few cells, or is wider than the curve.
    """
    number = len(x) if cells is None else cells
    span = float(x[-1] - x[0])
    length = round(width / span * number)
    if not FEWEST <= length <= number:
        raise InputError(
            f"a spectrogram with windows of {length} of {number} values: allowed are {FEWEST} to "
            f"{number}"
        )
    rate, edges = number / span, np.linspace(x[0], x[-1], number + 1)
    means = cell_means(x, values, edges)
    transform = ShortTimeFFT(
        get_window("hann", length), max(1, length // 4), rate, scale_to="magnitude"
    )
    first, last = transform.lower_border_end[1], transform.upper_border_begin(number)[1]
    transformed = np.abs(transform.stft_detrend(means, "constant", p0=first, p1=last))
    frequency = transform.f[1:-1]
    # one-sided: half of a sine's amplitude is at the negative frequency
    amplitude = 2.0 * transformed[1:-1] / np.sinc(frequency / rate)[:, None]
    centres = x[0] + transform.t(number, p0=first, p1=last)
    return Spectrogram(np.asarray(centres), np.asarray(frequency), amplitude, length / rate)


def cell_means(x: Array, values: Array, edges: Array) -> Array:
    """Return the mean of a curve in each cell, (m,): its integral over the cell, over its width.

    The curve is straight between its values, and the integral of that is exact, so that the sum
    over all cells keeps the area (the momentum of an impact) however narrow a peak is.

    Args:
        x: (n,), increasing.
        values: (n,).
        edges: of the cells, (m + 1,), increasing, within x.

    >>> x = np.array([0.0, 0.49, 0.5, 0.51, 1.0])
    >>> impact = np.array([0.0, 0.0, 100.0, 0.0, 0.0])
    >>> cell_means(x, impact, np.array([0.0, 0.25, 0.75, 1.0])).round(12)
    array([0., 2., 0.])

    Raises:
        InputError: the cells reach beyond the curve.
    """
    slack = 1e-9 * (x[-1] - x[0])
    if edges[0] < x[0] - slack or edges[-1] > x[-1] + slack:
        raise InputError(
            f"cells from {edges[0]:g} to {edges[-1]:g}: allowed are {x[0]:g} to {x[-1]:g}"
        )
    at = np.clip(edges, x[0], x[-1])
    interval = np.clip(np.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    beyond = at - x[interval]
    slope = (values[interval + 1] - values[interval]) / (x[interval + 1] - x[interval])
    area = integral(x, values)[interval] + beyond * (values[interval] + 0.5 * beyond * slope)
    return np.asarray(np.diff(area) / np.diff(edges))
